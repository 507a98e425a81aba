"""The connected pieces of a triangle soup, each judged: a convex hull, or opaque with the reason."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from hashlib import blake2b

import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.pieces.reader import Part, Reader
from meshforge.geometry.shapes.polytope import Polytope

_SMALL = 10_000  # triangles of a soup whose pieces are remembered: 64 such soups are less than 100 MB


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
    soup = _Soup(vertices, faces, of_face)
    return list(_read_before(soup) if len(faces) <= _SMALL else _read(soup))


class _Soup:
    """Triangles with groups, equal to others of the same numbers."""

    def __init__(self, vertices: Floats, faces: Ints, group: Ints) -> None:
        self.vertices, self.faces, self.group = vertices, faces, group
        arrays = (np.ascontiguousarray(array) for array in (faces, group, vertices))
        self.digest = b"".join(blake2b(array.data, digest_size=16).digest() for array in arrays)

    def __hash__(self) -> int:
        return hash(self.digest)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Soup) and self.digest == other.digest


@lru_cache(maxsize=64)
def _read_before(soup: _Soup) -> tuple[Piece, ...]:
    """The pieces, remembered: an asset's meshes are read when it is opened, when it is written, and to check that."""
    soup.vertices, soup.faces, soup.group = soup.vertices.copy(), soup.faces.copy(), soup.group.copy()
    return _read(soup)


def _read(soup: _Soup) -> tuple[Piece, ...]:
    found = Reader(soup.vertices, soup.faces, soup.group).read()
    ordered = sorted(found, key=lambda part: int(part.faces[0]))
    return tuple(_piece(soup.vertices, soup.faces, part, soup.group) for part in ordered)


def _piece(vertices: Floats, faces: Ints, part: Part, group: Ints) -> Piece:
    used, local = np.unique(faces[part.faces], return_inverse=True)
    first = int(part.faces[0])
    found = part.verdict
    arrays = (vertices[used], local.reshape(-1, 3), part.faces)
    for array in arrays:
        array.setflags(write=False)
    return Piece(found.shape, found.reason, *arrays, int(group[first]))
