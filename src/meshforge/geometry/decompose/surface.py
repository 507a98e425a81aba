"""The triangles given to a decomposition: checked, welded, and what is odd about them said."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats, Ints, frozen_floats, frozen_ints

_FLAT = 1e-7  # an extent below this share of the largest spans no volume


@dataclass(frozen=True, eq=False, slots=True)
class Triangles:
    """Welded triangles of some extent; vertices (n, 3) [m], faces (m, 3); open_edges: those of one triangle only."""

    vertices: Floats
    faces: Ints
    open_edges: int

    @property
    def diagonal(self) -> float:
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))


def sound_triangles(vertices: Any, faces: Any) -> Triangles:
    """The triangles with equal vertices welded and collapsed triangles dropped.

    Raises GeometryError: nothing to decompose, a coordinate that is not finite, an index out of range, a flat mesh.
    """
    points, triangles = frozen_floats(vertices, (-1, 3)), frozen_ints(faces, (-1, 3))
    if len(triangles) == 0:
        raise GeometryError("there are no triangles to decompose")
    if triangles.min() < 0 or triangles.max() >= len(points):
        raise GeometryError(f"a triangle refers to a vertex that is not there (there are {len(points)})")
    if not np.isfinite(points[triangles]).all():
        raise GeometryError("a coordinate is not a finite number", remedy="Mend the file's vertices.")
    welded, index = np.unique(points[triangles].reshape(-1, 3) + 0.0, axis=0, return_inverse=True)
    welded_faces = index.reshape(-1, 3)
    kept = np.diff(np.sort(welded_faces, axis=1), axis=1).min(axis=1) > 0
    _refuse_flat(welded, bool(kept.any()))
    return Triangles(welded, welded_faces[kept].astype(np.int64), _open_edges(welded_faces[kept]))


def _refuse_flat(points: Floats, any_triangle: bool) -> None:
    extents = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if not any_triangle or len(extents) < 3 or extents[2] <= _FLAT * extents[0]:
        raise GeometryError(
            "the mesh is flat: it spans no volume",
            remedy="Give it a thickness; for a single flat piece, a convex hull with a thickness is enough.",
        )


def _open_edges(faces: Ints) -> int:
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, uses = np.unique(edges, axis=0, return_counts=True)
    return int((uses == 1).sum())
