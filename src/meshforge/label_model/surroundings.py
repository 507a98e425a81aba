"""The shape of the whole as seen from points inside a hull, however the decomposition cut it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Floats
from meshforge.label_model.ties import EQUAL, first_greatest

_SAME = 0.01  # of their sum: lengths that differ by less count as mostly the same

_PLASTIC = np.array([0.7548776662466927, 0.5698402909980532])
"""Steps of the two-dimensional sequence that fills a square most evenly (Roberts 2018)."""
_FAVOUR = 1e-3  # of the square of a hull's size, by which a vertex may be nearer and still come first
_SIDE_WORTH = 0.5  # what being far from the upright axis is worth beside being high

SEEN_FROM = 8
"""Points of a hull from which its surroundings are looked at."""
_SEEN = 600  # points on the whole that are looked at, a few more where there are many hulls
_LEAST, _MANY = 3, 3000  # of these on each hull, and in all where that makes more
_PAIRS = 2_000_000  # of points that are looked from and looked at, at a time
_THIN = 1e-6  # of the size; what is less tall or wide counts as so much
_RADII = (0.04, 0.1, 0.25)  # of the balls within which the whole is looked at, in sizes of the whole
_LEVEL_BOUNDS = (-0.35, -0.12, -0.03, 0.03, 0.12, 0.35)  # bounds of heights in the picture of the whole
_RING_BOUNDS = (0.05, 0.15, 0.4)  # bounds of distances aside
_CELLS = (len(_LEVEL_BOUNDS) + 1) * (len(_RING_BOUNDS) + 1)
SURROUNDINGS_WIDTH = 4 + 8 * len(_RADII) + _CELLS
"""Columns of `describe_surroundings`."""


def axes_along(direction: Floats, lengths: Floats, axes: Floats) -> Floats:
    """Return how much each axis of n spreads points along a direction (n, 3), or against it: (n, 3), from 0 to 1.

    lengths: (n, 3), positive; axes: (n, 3, 3), of unit length, in columns. Axes of the same length share what they
    have, for any other axes in their plane are as good; those of nearly the same do so partly, so that nothing leaps.
    """
    squares = np.einsum("nij,ni->nj", axes, direction) ** 2
    one, other = lengths[:, :, None], lengths[:, None]
    shares = np.exp(-(((one - other) / (one + other) / _SAME) ** 2))
    found: Floats = np.sqrt(np.einsum("nij,nj->ni", shares / shares.sum(axis=2, keepdims=True), squares))
    return found


def points_inside(vertices: Floats, axis: Floats, count: int) -> Floats:
    """Return points (count, 3) within a hull: its middle, and halfway from there to vertices far from each other.

    Of vertices that are equally far those come first that are high and far from an upright axis, which stands at
    `axis` (2,): a hull has the same points however it is turned about Z, unless it is its own mirror image.
    """
    middle = vertices.mean(axis=0)
    offsets = vertices - middle
    reach = (offsets**2).sum(axis=1)
    size = float(reach.max()) or 1.0
    favour = _FAVOUR * np.sqrt(size) * (offsets[:, 2] + _SIDE_WORTH * np.linalg.norm(vertices[:, :2] - axis, axis=1))
    chosen = [int(first_greatest(reach + favour, EQUAL * size))]
    gap = ((offsets - offsets[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < count - 1:
        chosen.append(int(first_greatest(gap + favour, EQUAL * size)))
        gap = np.minimum(gap, ((offsets - offsets[chosen[-1]]) ** 2).sum(axis=1))
    points: Floats = middle + np.concatenate([np.zeros((1, 3)), offsets[chosen] / 2])[:count]
    return points


def points_on_surface(triangles: Floats, count: int) -> Floats:
    """Return points (count, 3) spread evenly over triangles (n, 3, 3)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    ends = np.cumsum(np.linalg.norm(np.cross(b - a, c - a), axis=1))
    at = np.searchsorted(ends, ((np.arange(count) + 0.5) / count - EQUAL) * ends[-1])
    face = np.minimum(at, len(triangles) - 1)
    share = (0.5 + np.arange(1, count + 1)[:, None] * _PLASTIC) % 1.0
    over = share.sum(axis=1) > 1.0
    share[over] = 1.0 - share[over]
    points: Floats = a[face] + share[:, :1] * (b - a)[face] + share[:, 1:] * (c - a)[face]
    return points


@dataclass(frozen=True, eq=False, slots=True)
class WholeShape:
    """All hulls of a mesh, standing upright if it was turned so.

    pieces: vertices of each hull; seen: points (n, 3) on all of them, weights: (n,), their shares of the surface;
    foot: the lowest height, tall: how much higher the highest is; axis: where the upright axis stands (2,), wide: how
    far from it most is; size: of the whole, whichever way it is turned about the axis.
    """

    pieces: tuple[Floats, ...]
    seen: Floats
    weights: Floats
    foot: float
    tall: float
    axis: Floats
    wide: float
    size: float

    @staticmethod
    def of(pieces: tuple[Floats, ...], seen: Floats, weights: Floats) -> WholeShape:
        """Return the same with foot, height, axis and size found."""
        corners = np.concatenate(pieces)
        foot, top = float(corners[:, 2].min()), float(corners[:, 2].max())
        axis = weights @ seen[:, :2]
        farthest = float(np.linalg.norm(corners[:, :2] - axis, axis=1).max())
        size = float(np.hypot(top - foot, 2 * farthest)) or 1.0
        most = float(np.quantile(np.linalg.norm(seen[:, :2] - axis, axis=1), 0.95))
        return WholeShape(
            pieces, seen, weights, foot, max(top - foot, _THIN * size), axis, max(most, _THIN * size), size
        )

    def rotate(self, turn: Floats) -> WholeShape:
        """Return the same after a rotation (3, 3)."""
        return WholeShape.of(tuple(piece @ turn.T for piece in self.pieces), self.seen @ turn.T, self.weights)


def whole_of(pieces: tuple[Floats, ...], triangles: tuple[Floats, ...]) -> WholeShape:
    """Return all hulls together. pieces: vertices (v, 3) of each; triangles: (t, 3, 3) of each."""
    areas = np.array([np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1).sum() for t in triangles])
    areas = np.maximum(areas, 1e-9 * areas.max())
    shares = np.sqrt(areas) / np.sqrt(areas).sum()
    least = min(_LEAST, max(1, _MANY // len(pieces)))
    counts = np.maximum(least, np.floor(shares * _SEEN + 0.5 + EQUAL).astype(int))
    seen = np.concatenate([points_on_surface(t, int(n)) for t, n in zip(triangles, counts, strict=True)])
    return WholeShape.of(pieces, seen, np.repeat(areas / counts, counts) / areas.sum())


def describe_surroundings(whole: WholeShape) -> Floats:
    """Return a row for each hull (n, WIDTH): the means over points within the hull of what is seen from there.

    Where the point is, how the whole is spread within balls about it, a picture of the whole in rings about it.
    """
    at_once = max(1, _PAIRS // (SEEN_FROM * len(whole.seen)))
    starts = range(0, len(whole.pieces), at_once)
    return np.concatenate([_describe_rows(whole, whole.pieces[start : start + at_once]) for start in starts])


def _describe_rows(whole: WholeShape, pieces: Sequence[Floats]) -> Floats:
    inside = np.concatenate([points_inside(piece, whole.axis, SEEN_FROM) for piece in pieces])
    middle = whole.weights @ whole.seen
    points, seen = (inside - middle) / whole.size, (whole.seen - middle) / whole.size
    x, y, z = (seen[:, k] - points[:, k, None] for k in range(3))
    aside = x * x + y * y
    squares = aside + z * z
    near = [_describe_spread(np.exp(squares * (-0.5 / radius**2)) * whole.weights, points, seen) for radius in _RADII]
    rings = _describe_rings(whole.weights, z, aside)
    rows = np.concatenate([_describe_place(whole, inside), *near, rings], axis=1)
    means: Floats = rows.reshape(len(pieces), SEEN_FROM, -1).mean(axis=1)
    return means


def _describe_place(whole: WholeShape, points: Floats) -> Floats:
    """Height in the whole, distance from its axis by two measures, height over its middle: (n, 4)."""
    out = np.linalg.norm(points[:, :2] - whole.axis, axis=1)
    middle = float(whole.weights @ whole.seen[:, 2])
    height = points[:, 2]
    return np.stack(
        [(height - whole.foot) / whole.tall, out / whole.wide, out / whole.size, (height - middle) / whole.size], axis=1
    )


def _describe_spread(weights: Floats, points: Floats, seen: Floats) -> Floats:
    """How weighted points are spread about each of n points (n, 8). weights: (n, m); points: (n, 3); seen: (m, 3).

    As a line, a sheet or a ball, how upright these are, how much there is, and how far off its middle is.
    """
    weights = weights + 1e-12
    mass = weights.sum(axis=1)
    products = (seen[:, :, None] * seen[:, None]).reshape(-1, 9)
    sums = weights @ np.concatenate([seen, products], axis=1) / mass[:, None]
    means, scatter = sums[:, :3], sums[:, 3:].reshape(-1, 3, 3)
    values, axes = np.linalg.eigh(scatter - means[:, :, None] * means[:, None, :])
    lengths = np.sqrt(np.maximum(values, 1e-12))
    thin, wide, long = lengths.T
    upward = axes_along(np.broadcast_to([0.0, 0.0, 1.0], lengths.shape), lengths, axes)
    middle = means - points
    return np.stack(
        [
            (long - wide) / long,
            (wide - thin) / long,
            thin / long,
            upward[:, 2],
            upward[:, 0],
            mass,
            middle[:, 2] / long,
            np.linalg.norm(middle[:, :2], axis=1) / long,
        ],
        axis=1,
    )


def _describe_rings(weights: Floats, heights: Floats, squares: Floats) -> Floats:
    """The share of the whole in each ring about the upright axis through each of n points (n, cells), as a root.

    heights, squares: (n, m), of the points on the whole over each point, and of their distances aside.
    """
    level = np.searchsorted(_LEVEL_BOUNDS, heights, side="right")
    cell = level * (len(_RING_BOUNDS) + 1) + np.searchsorted(np.square(_RING_BOUNDS), squares, side="right")
    count = len(heights)
    flat = (np.arange(count)[:, None] * _CELLS + cell).ravel()
    return np.sqrt(np.bincount(flat, np.tile(weights, count), count * _CELLS)).reshape(count, _CELLS)
