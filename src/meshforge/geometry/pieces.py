"""The connected pieces of a triangle soup, each judged: a convex hull, or opaque with the reason."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents
from meshforge.geometry.shapes.polytope import Polytope, volume_and_centroid

FILLED = 0.95
"""A piece is a hull when its volume is at least this share of its convex hull's."""


@dataclass(frozen=True, eq=False, slots=True)
class Piece:
    """A connected piece of a surface.

    shape: its convex hull, None where the piece is no hull, with the `reason`.
    vertices: (n, 3) [m] and faces: (m, 3), the piece as authored; face_indices: (m,) its faces in the input;
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
    points, welded = np.unique(vertices + 0.0, axis=0, return_inverse=True)
    corners = welded.reshape(-1)[faces]
    links = coo_array(
        (np.ones(2 * len(corners)), (corners[:, [0, 1]].ravel(), corners[:, [1, 2]].ravel())), (len(points),) * 2
    )
    _, label = connected_components(links, directed=False)
    of_piece = label[corners[:, 0]]
    _, first = np.unique(of_piece, return_index=True)
    return [
        _judged(vertices, faces, np.flatnonzero(of_piece == of_piece[k]), int(of_face[k]), name) for k in np.sort(first)
    ]


def _judged(vertices: Floats, faces: Ints, indices: Ints, group: int, name: str) -> Piece:
    used, local = np.unique(faces[indices], return_inverse=True)
    points, triangles = vertices[used], local.reshape(-1, 3)
    _, _, extents = principal_extents(points)
    if extents.min() <= FLATNESS * max(extents.max(), 1e-300):
        return Piece(None, "flat", points, triangles, indices, group)
    hull = convex_hull(points, name=name)
    share = abs(volume_and_centroid(points, triangles)[0]) / hull.volume
    if share < FILLED:
        reason = f"not convex: fills {share:.0%} of its convex hull"
        return Piece(None, reason, points, triangles, indices, group)
    return Piece(hull, None, points, triangles, indices, group)
