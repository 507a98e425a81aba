"""Digests of what an output was made from; contents count, never the times of files."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

from meshforge.batch.correction import Correction
from meshforge.files import relative_name
from meshforge.formats import MESH_SUFFIXES
from meshforge.geometry import digest as shape_digest
from meshforge.language import Comments, HeaderComments, Program, Template


def file_digest(path: Path) -> str:
    """Thirty-two hexadecimal digits of the contents of a file."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, _new).hexdigest()


def text_digest(text: str) -> str:
    """Thirty-two hexadecimal digits of a text."""
    return _new(text.encode()).hexdigest()


def program_digest(program: Program) -> str:
    """The digest of what a program does: its canonical form without comments."""
    rules = tuple(replace(rule, comments=Comments()) for rule in program.rules)
    return text_digest(str(replace(program, rules=rules, comments=HeaderComments())))


def template_digests(templates: Mapping[str, Template]) -> dict[str, str]:
    """The digest of the shapes of each template."""
    return {name: text_digest(" ".join(map(shape_digest, templates[name].shapes))) for name in sorted(templates)}


def corrections_digest(corrections: Iterable[Correction]) -> str | None:
    """The digest of edits by hand, None where there are none."""
    lines = [str(correction) for correction in corrections]
    return text_digest("\n".join(lines)) if lines else None


def asset_digests(path: Path, referenced: Iterable[Path], base: Path) -> dict[str, str]:
    """The digest of every file of an asset, by its path relative to `base`; of a folder, of all mesh files in it."""
    files = {*source_files(path), *referenced}
    return {relative_name(file, base): file_digest(file) for file in sorted(files)}


def same_files(recorded: Mapping[str, str], path: Path, base: Path) -> bool:
    """Whether the files of an asset are those that were recorded, without reading it as an asset."""
    if any(relative_name(file, base) not in recorded for file in source_files(path)):
        return False
    return all((base / name).is_file() and file_digest(base / name) == known for name, known in recorded.items())


def source_files(path: Path) -> list[Path]:
    """The main file of an asset, or the mesh files of a folder of pieces."""
    if not path.is_dir():
        return [path]
    files = (file for file in path.iterdir() if not file.name.startswith("."))
    return sorted(file for file in files if file.suffix.lower() in MESH_SUFFIXES)


def software() -> str:
    """The version of this program, since another one may write other files."""
    return version("meshforge")


def _new(data: bytes = b"") -> hashlib.blake2b:
    return hashlib.blake2b(data, digest_size=16)
