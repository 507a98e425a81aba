"""Putting a written asset on disk: the whole tree, each file atomically, the main file last."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.files import write_atomically
from meshforge.formats.base import Output
from meshforge.formats.registry import format_for
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, slots=True)
class Saved:
    """What was written: the main file, all files of its tree, and what the format could not hold."""

    path: Path
    files: tuple[Path, ...]
    notes: tuple[str, ...] = ()


def save(what: SymbolicMesh | Asset, out: str | Path, *, link: bool = False, overwrite: bool = False) -> Saved:
    """Write an asset, in the format it was read from where the suffix of `out` fits it, else made anew.

    link: files that are only copied become hard links; overwrite: existing files may be replaced.
    Raises AssetError: a file of the input, or another file that exists, would be overwritten.
    """
    asset = what.lowered() if isinstance(what, SymbolicMesh) else what
    out = Path(out)
    known = format_for(out, asset.format)
    output = known.write(asset, out.name) if known.name == asset.format else known.create(asset, out.name)
    plan = _plan(output, out)
    inputs = {p.resolve() for p in (asset.path, *asset.files)}
    for target, content in plan:
        _refuse(target, content, inputs, overwrite)
    for target, content in plan:
        _put(target, content, link)
    return Saved(out, tuple(target for target, _ in plan), output.notes)


def _plan(output: Output, out: Path) -> list[tuple[Path, bytes | Path]]:
    beside: dict[str, bytes | Path] = {**output.copies, **output.made}
    return [*((Path(os.path.normpath(out.parent / name)), c) for name, c in beside.items()), (out, output.main)]


def _refuse(target: Path, content: bytes | Path, inputs: set[Path], overwrite: bool) -> None:
    if not target.exists() or _same(target, content):
        return
    if target.resolve() in inputs:
        raise AssetError("this file belongs to the input", where=str(target), remedy="Write to another folder.")
    if not overwrite:
        raise AssetError("this file exists already", where=str(target), remedy="Pass overwrite, or write elsewhere.")


def _same(target: Path, content: bytes | Path) -> bool:
    if isinstance(content, Path):
        return target.samefile(content) or target.read_bytes() == content.read_bytes()
    return target.read_bytes() == content


def _put(target: Path, content: bytes | Path, link: bool) -> None:
    if target.exists() and _same(target, content):
        return
    if isinstance(content, Path):
        content = content.read_bytes()
    write_atomically(target, content)
