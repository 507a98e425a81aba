"""Points spread evenly over triangles, and by them the distances of very many points to a surface."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from meshforge.geometry import Floats, Ints, nearest_on_triangles
from meshforge.symbolic import Surface

MOST_POINTS = 30_000_000
"""Points at most by default, over all chunks; a spacing that would give more is made wider."""
_CHUNK = 1_000_000

_MOST_INDEXED = 3_000_000  # points of a surface: some 300 MB with their tree


@dataclass(frozen=True, eq=False, slots=True)
class SurfacePoints:
    """Points (n, 3) on triangles; triangle: (n,), whose each is; area: (n,), how much of it each stands for [m^2]."""

    points: Floats
    triangle: Ints
    area: Floats


def sample_triangles(corners: Floats, spacing: float, most: int = MOST_POINTS) -> Iterator[SurfacePoints]:
    """Yield points on triangles, corners (m, 3, 3), in chunks: every point of these has one within 1.12 of the spacing
    [m].

    Rows along the longest side of each triangle; the corners are always among the points.
    """
    if not len(corners):
        return
    base, spacing = _turn_to_longest(corners), max(spacing, np.finfo(float).tiny)
    length = np.linalg.norm(base[:, 1] - base[:, 0], axis=1)
    area = 0.5 * np.linalg.norm(np.cross(base[:, 1] - base[:, 0], base[:, 2] - base[:, 0]), axis=1)
    altitude = 2 * area / np.maximum(length, np.finfo(float).tiny)
    while True:
        counts = (altitude / spacing + 2) * (length / spacing + 2)
        if counts.sum() <= most or spacing > length.max():
            break
        spacing *= 1.25
    ends = np.flatnonzero(np.diff(np.floor(np.cumsum(counts) / _CHUNK))) + 1
    for part in np.split(np.arange(len(base)), ends):
        if len(part):
            yield _sample_chunk(base[part], length[part], altitude[part], area[part], part, spacing)


def _sample_chunk(
    base: Floats, length: Floats, altitude: Floats, area: Floats, names: Ints, spacing: float
) -> SurfacePoints:
    rows = np.ceil(altitude / spacing).astype(np.int64) + 1
    owner = np.repeat(np.arange(len(base)), rows)
    up = _count_up(rows) / np.maximum(rows - 1, 1)[owner]
    steps = np.ceil(length[owner] * (1 - up) / spacing).astype(np.int64) + 1
    row = np.repeat(np.arange(len(owner)), steps)
    along = _count_up(steps) / np.maximum(steps - 1, 1)[row]
    owner, up = owner[row], up[row]
    a, b, c = base[owner, 0], base[owner, 1], base[owner, 2]
    start, end = a + (c - a) * up[:, None], b + (c - b) * up[:, None]
    share = (area / np.bincount(owner, minlength=len(base)))[owner]
    return SurfacePoints(start + (end - start) * along[:, None], names[owner], share)


def _count_up(counts: Ints) -> Ints:
    ends = np.cumsum(counts)
    return np.arange(ends[-1]) - np.repeat(ends - counts, counts)


def _turn_to_longest(corners: Floats) -> Floats:
    sides = np.linalg.norm(corners[:, [1, 2, 0]] - corners, axis=2)
    first = sides.argmax(axis=1)
    order = (first[:, None] + np.arange(3)) % 3
    turned: Floats = corners[np.arange(len(corners))[:, None], order]
    return turned


def join_corners(surfaces: Sequence[Surface]) -> Floats:
    """Return the triangles (m, 3, 3) of some surfaces; those that are not finite are left out."""
    corners = np.concatenate([np.zeros((0, 3, 3)), *(s.vertices[s.faces] for s in surfaces if len(s.faces))])
    finite: Floats = corners[np.isfinite(corners).all(axis=(1, 2))]
    return finite


class SurfaceIndex:
    """Triangles, corners (m, 3, 3), with points `spacing` [m] apart on them, by which the nearest triangle is found."""

    def __init__(self, corners: Floats, spacing: float) -> None:
        self.corners = corners
        parts = list(sample_triangles(corners, spacing, _MOST_INDEXED))
        self.points = np.concatenate([p.points for p in parts]) if parts else np.zeros((0, 3))
        self.triangle: Ints = np.concatenate([p.triangle for p in parts]) if parts else np.zeros(0, np.int64)
        self.area = np.concatenate([p.area for p in parts]) if parts else np.zeros(0)

    @cached_property
    def _tree(self) -> Any:
        from scipy.spatial import cKDTree  # lazy: 0.3 s, only checks need it

        return cKDTree(self.points)

    def distances(self, points: Floats) -> tuple[Floats, Ints]:
        """Return how far [m] each point (n, 3) is from the surface, and the triangle (n,) nearest to it.

        Exact to the triangle that is looked at: never too small, too large by 1.12 of the spacing at most; that is
        wider on surfaces which would need more than 3 million points.
        """
        if not len(points):
            return np.zeros(0), np.zeros(0, np.int64)
        triangle = self.triangle[self._tree.query(points)[1]]
        return np.linalg.norm(nearest_on_triangles(points, self.corners[triangle]) - points, axis=1), triangle
