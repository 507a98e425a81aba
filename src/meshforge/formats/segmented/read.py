"""Reading segmented points and meshes of every kind."""

from __future__ import annotations

from pathlib import Path

from meshforge.errors import AssetError
from meshforge.formats.segmented.places import POINTS_SUFFIXES
from meshforge.formats.segmented.segmented import Segmented


def read_segmented(path: Path) -> Segmented:
    """The points or faces in a `.ply`, `.npz` or `.npy` file, with the class of each.

    Raises AssetError naming the file: unreadable, of another kind, without classes, with wrong lengths, not finite.
    """
    match path.suffix.lower():
        case ".ply":
            from meshforge.formats.segmented.ply import read_ply

            return read_ply(path)
        case ".npz" | ".npy":
            from meshforge.formats.segmented.arrays import read_arrays

            return read_arrays(path)
    remedy = f"It is one of {', '.join(POINTS_SUFFIXES)}."
    raise AssetError(
        f"{path.suffix or 'a file without suffix'} is no kind of segmented points", where=str(path), remedy=remedy
    )
