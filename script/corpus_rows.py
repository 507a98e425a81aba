"""The files of a folder of real assets that MeshForge can be given, and what it makes of each."""

from __future__ import annotations

import contextlib
import io
import warnings
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from meshforge.common import describe_error, pluralize
from meshforge.formats import MESH_SUFFIXES, SUFFIXES, read, read_triangles, split_into_pieces

_PARTS = (".dae",)
"""Mesh files that are read as parts of assets only."""
_LONG = 400  # characters of a message or of notes


@dataclass(frozen=True)
class Row:
    """What was made of a file or folder; message: the error where it is refused."""

    path: str
    format: str = ""
    hulls: int = 0
    bodies: int = 0
    opaque: int = 0
    reasons: str = ""
    notes: str = ""
    message: str = ""


def entries(root: Path) -> list[str]:
    """Paths below a folder, in order: files of known suffixes, and folders of several mesh files, with a slash."""
    files = [path for path in root.rglob("*") if path.is_file() and path.suffix.lower() in (*SUFFIXES, *_PARTS)]
    meshes = Counter(path.parent for path in files if path.suffix.lower() in MESH_SUFFIXES)
    folders = [folder for folder, count in meshes.items() if count > 1 and folder != root]
    return sorted(
        [p.relative_to(root).as_posix() for p in files] + [f"{f.relative_to(root).as_posix()}/" for f in folders]
    )


def row(item: tuple[str, str]) -> Row:
    """The row of a path below a root, `(root, path)`. Warnings of other libraries, which a user would see, count."""
    root, name = item
    path = Path(root, name)
    heard = io.StringIO()
    with warnings.catch_warnings(record=True) as caught, contextlib.redirect_stderr(heard):
        warnings.simplefilter("always")
        try:
            made = _part(path, name) if path.suffix.lower() in _PARTS else _asset(path, name, root)
        except Exception as error:  # the table shows what a user would see
            made = Row(name, message=_short(describe_error(error, name), root).removeprefix(f"{name}: "))
    noise = [f"warning: {w.message}" for w in caught] + [f"stderr: {line}" for line in heard.getvalue().splitlines()]
    return Row(**{**vars(made), "notes": _short("; ".join([made.notes, *noise]).strip("; "), root)}) if noise else made


def _asset(path: Path, name: str, root: str) -> Row:
    asset = read(path)
    bodies = {geom.body for geom in asset.geoms} | {piece.body for piece in asset.non_convex}
    return Row(
        name,
        asset.format,
        len(asset.geoms),
        len(bodies),
        len(asset.non_convex),
        _count(piece.reason for piece in asset.non_convex),
        _short("; ".join(asset.notes), root),
    )


def _part(path: Path, name: str) -> Row:
    found = split_into_pieces(read_triangles(path), name=name)
    opaque = [piece.reason or "no hull" for piece in found if piece.shape is None]
    return Row(name, f"part {path.suffix.lower()}", len(found) - len(opaque), 1, len(opaque), _count(opaque))


def _count(reasons: Iterable[str]) -> str:
    """Reasons, the commonest first, each with its number; shares of convex hulls are told together."""
    found = Counter("not convex" if reason.startswith("not convex") else reason for reason in reasons)
    ordered = sorted(found.items(), key=lambda item: (-item[1], item[0]))
    shown = [f"{count} x {reason}" for reason, count in ordered[:4]]
    return "; ".join([*shown, pluralize(len(ordered) - 4, "reason") + " more"] if len(ordered) > 4 else shown)


def _short(text: str, root: str) -> str:
    """A text on one line without the root of the corpus in it."""
    line = " / ".join(part.strip() for part in text.replace(f"{root}/", "").replace(root, ".").splitlines())
    line = " ".join(line.split())
    return line if len(line) <= _LONG else f"{line[:_LONG]}..."
