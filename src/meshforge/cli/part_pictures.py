"""Numbered pictures of an asset in which a person, or a model, can name its parts."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.symbolic import SymbolicMesh

_SHEET_COLUMNS = 4  # a numbered picture and its plain one, twice


def write_part_pictures(mesh: SymbolicMesh, out: Path, size: int) -> str:
    """Writes what `shots` shows, on one sheet, or one by one where `out` is a folder or has no suffix.

    size: pixels along each picture's sides. Returns what is written, in words. Raises UsageError for a mesh without
    hulls, and where it cannot be written.
    """
    from meshforge.errors import UsageError
    from meshforge.views import sheet, shots, write_png
    from meshforge.words import counted

    taken = shots(mesh, size=size)
    if not taken:
        raise UsageError(
            "there are no hulls to be named", remedy="`meshforge decompose` makes hulls, and `new --decompose` too."
        )
    if out.suffix and not out.is_dir():
        write_png(out, sheet([image for shot in taken for image in (shot.marked, shot.plain)], columns=_SHEET_COLUMNS))
        return f"{out}: {counted(len(taken), 'picture')}, each with its plain one"
    for k, shot in enumerate(taken, 1):
        stem = f"{k:02}-{_file_name(shot.name)}"
        write_png(out / f"{stem}.png", shot.marked)
        write_png(out / f"{stem}-plain.png", shot.plain)
    return f"{counted(len(taken), 'picture')} to {out}, each with its plain one"


def _file_name(name: str) -> str:
    return "-".join(name.replace(",", " ").split())
