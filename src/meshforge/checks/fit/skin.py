"""Distances to a triangle surface, for very many points."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from meshforge.checks.space import samples_of
from meshforge.geometry import Floats, Ints, nearest_on_triangles

_NEAREST = 2  # samples whose triangles are looked at


class Skins:
    """Triangles, corners (m, 3, 3), with points `spacing` [m] apart on them, by which the nearest triangle is found."""

    def __init__(self, corners: Floats, spacing: float) -> None:
        self.corners = corners
        parts = list(samples_of(corners, spacing))
        self.points = np.concatenate([p.points for p in parts]) if parts else np.zeros((0, 3))
        self.triangle: Ints = np.concatenate([p.triangle for p in parts]) if parts else np.zeros(0, np.int64)
        self.area = np.concatenate([p.area for p in parts]) if parts else np.zeros(0)

    @cached_property
    def _tree(self) -> Any:
        from scipy.spatial import cKDTree

        return cKDTree(self.points)

    def distances(self, points: Floats) -> tuple[Floats, Ints]:
        """How far [m] each point (n, 3) is from the surface, and the triangle (n,) nearest to it.

        Exact to the triangles that are looked at: never too small, too large by 1.12 of the spacing at most.
        """
        if not len(points):
            return np.zeros(0), np.zeros(0, np.int64)
        found = self._tree.query(points, k=min(_NEAREST, len(self.points)))[1].reshape(len(points), -1)
        best, nearest = np.full(len(points), np.inf), np.zeros(len(points), np.int64)
        for column in found.T:
            triangle = self.triangle[column]
            gap = np.linalg.norm(nearest_on_triangles(points, self.corners[triangle]) - points, axis=1)
            nearer = gap < best
            best[nearer], nearest[nearer] = gap[nearer], triangle[nearer]
        return best, nearest
