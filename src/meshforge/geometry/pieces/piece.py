"""The connected pieces of a triangle soup, each judged: a convex hull, or opaque with the reason."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.pieces.reader import Part, Reader
from meshforge.geometry.shapes.polytope import Polytope


@dataclass(frozen=True, eq=False, slots=True)
class Piece:
    """A connected piece of a surface.

    shape: its convex hull, None where the piece is no hull, with the `reason`.
    vertices: (n, 3) [m] and faces: (m, 3), the piece as authored; face_indices: (m,) its faces in the input, ascending;
    group: the group of its first face.
    """

    shape: Polytope | None
    reason: str | None
    vertices: Floats
    faces: Ints
    face_indices: Ints
    group: int = 0


def pieces(vertices: Floats, faces: Ints, *, name: str, groups: Ints | None = None) -> list[Piece]:
    """The connected pieces of vertices (n, 3) [m] and faces (m, 3), in the order of their first face.

    groups: (m,) the group of each face, where the file has groups.
    Raises GeometryError naming `name`: a coordinate that is not finite, an index that is not there.
    """
    vertices = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    faces = np.asarray(faces, dtype=np.int64).reshape(-1, 3)
    if len(faces) == 0:
        return []
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise GeometryError("a face names a vertex that is not there", where=name)
    if not np.isfinite(vertices[faces]).all():
        raise GeometryError("a coordinate is not a finite number", where=name, remedy="Mend the file's vertices.")
    of_face = np.zeros(len(faces), dtype=np.int64) if groups is None else np.asarray(groups, dtype=np.int64)
    found = Reader(vertices, faces, of_face, name).read()
    return [_piece(vertices, faces, part, of_face) for part in sorted(found, key=lambda part: int(part.faces[0]))]


def _piece(vertices: Floats, faces: Ints, part: Part, group: Ints) -> Piece:
    used, local = np.unique(faces[part.faces], return_inverse=True)
    first = int(part.faces[0])
    found = part.verdict
    return Piece(found.shape, found.reason, vertices[used], local.reshape(-1, 3), part.faces, int(group[first]))
