"""Triangles of a mesh file of any kind that a description refers to: named surfaces, and their pieces."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile import RawSurface
from meshforge.geometry import Piece, pieces


def read_triangles(path: Path) -> list[RawSurface]:
    """The surfaces of an STL, OBJ, PLY, DAE, GLB or glTF file, node transforms applied.

    Raises AssetError naming the file, and the line where there is one: unreadable, empty, or not finite.
    """
    if path.suffix.lower() == ".obj":
        from meshforge.formats.meshfile.obj import parse_obj

        return parse_obj(path.read_bytes(), str(path)).surfaces(str(path))
    import trimesh

    try:
        loaded = trimesh.load(path, process=False)
    except Exception as error:
        raise AssetError(f"cannot be read: {error}", where=str(path)) from error
    parts = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
    return [
        RawSurface(
            part.metadata.get("name"),
            np.asarray(part.vertices, dtype=np.float64),
            np.asarray(part.faces, dtype=np.int64),
        )
        for part in parts
        if isinstance(part, trimesh.Trimesh)
    ]


def pieces_of(surfaces: Sequence[RawSurface], *, name: str) -> list[Piece]:
    """The pieces of all surfaces of a file together; a piece's `group` is the index of its surface."""
    if not surfaces:
        return []
    starts = np.cumsum([0, *(len(s.vertices) for s in surfaces)])
    vertices = np.concatenate([s.vertices for s in surfaces])
    faces = np.concatenate([s.faces + start for s, start in zip(surfaces, starts, strict=False)])
    groups = np.repeat(np.arange(len(surfaces)), [len(s.faces) for s in surfaces])
    return pieces(vertices, faces, name=name, groups=groups)
