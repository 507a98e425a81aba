"""What is around a hull, however the decomposition cut it: the shape of the whole as seen from inside the hull."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Floats
from meshforge.perception.propagation.axes import along
from meshforge.perception.propagation.points import inside, on_surface
from meshforge.perception.propagation.ties import EQUAL

SEEN_FROM = 8
"""Points of a hull from which its surroundings are looked at."""
_SEEN = 600  # points on the whole that are looked at, a few more where there are many hulls
_LEAST, _MANY = 3, 3000  # of these on each hull, and in all where that makes more
_PAIRS = 2_000_000  # of points that are looked from and looked at, at a time
_THIN = 1e-6  # of the size; what is less tall or wide counts as so much
_RADII = (0.04, 0.1, 0.25)  # of the balls within which the whole is looked at, in sizes of the whole
_BELOW = (-0.35, -0.12, -0.03, 0.03, 0.12, 0.35)  # bounds of heights in the picture of the whole
_ASIDE = (0.05, 0.15, 0.4)  # bounds of distances aside
_CELLS = (len(_BELOW) + 1) * (len(_ASIDE) + 1)
WIDTH = 4 + 8 * len(_RADII) + _CELLS
"""Columns of `surroundings`."""


@dataclass(frozen=True, eq=False, slots=True)
class Whole:
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
    def of(pieces: tuple[Floats, ...], seen: Floats, weights: Floats) -> Whole:
        """The same with foot, height, axis and size found."""
        corners = np.concatenate(pieces)
        foot, top = float(corners[:, 2].min()), float(corners[:, 2].max())
        axis = weights @ seen[:, :2]
        farthest = float(np.linalg.norm(corners[:, :2] - axis, axis=1).max())
        size = float(np.hypot(top - foot, 2 * farthest)) or 1.0
        most = float(np.quantile(np.linalg.norm(seen[:, :2] - axis, axis=1), 0.95))
        return Whole(pieces, seen, weights, foot, max(top - foot, _THIN * size), axis, max(most, _THIN * size), size)

    def rotate(self, turn: Floats) -> Whole:
        """The same after a rotation (3, 3)."""
        return Whole.of(tuple(piece @ turn.T for piece in self.pieces), self.seen @ turn.T, self.weights)


def whole_of(pieces: tuple[Floats, ...], triangles: tuple[Floats, ...]) -> Whole:
    """All hulls together. pieces: vertices (v, 3) of each; triangles: (t, 3, 3) of each."""
    areas = np.array([np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1).sum() for t in triangles])
    areas = np.maximum(areas, 1e-9 * areas.max())
    shares = np.sqrt(areas) / np.sqrt(areas).sum()
    least = min(_LEAST, max(1, _MANY // len(pieces)))
    counts = np.maximum(least, np.floor(shares * _SEEN + 0.5 + EQUAL).astype(int))
    seen = np.concatenate([on_surface(t, int(n)) for t, n in zip(triangles, counts, strict=True)])
    weights = np.repeat(areas / counts, counts) / areas.sum()
    return Whole.of(pieces, seen, weights)


def surroundings(whole: Whole) -> Floats:
    """A row for each hull (n, WIDTH): the means over points within the hull of what is seen from there.

    Where the point is, how the whole is spread within balls about it, a picture of the whole in rings about it.
    """
    at_once = max(1, _PAIRS // (SEEN_FROM * len(whole.seen)))
    starts = range(0, len(whole.pieces), at_once)
    return np.concatenate([_rows(whole, whole.pieces[start : start + at_once]) for start in starts])


def _rows(whole: Whole, pieces: Sequence[Floats]) -> Floats:
    """The rows of some of the hulls."""
    points = np.concatenate([inside(piece, whole.axis, SEEN_FROM) for piece in pieces])
    offsets = (whole.seen[None] - points[:, None]) / whole.size
    squares = (offsets**2).sum(axis=2)
    near = [_spread(np.exp(-squares / (2 * radius**2)) * whole.weights, offsets) for radius in _RADII]
    rows = np.concatenate([_place(whole, points), *near, _rings(whole, offsets)], axis=1)
    means: Floats = rows.reshape(len(pieces), SEEN_FROM, -1).mean(axis=1)
    return means


def _place(whole: Whole, points: Floats) -> Floats:
    """Height in the whole, distance from its axis by two measures, height over its middle: (n, 4)."""
    out = np.linalg.norm(points[:, :2] - whole.axis, axis=1)
    middle = float(whole.weights @ whole.seen[:, 2])
    height = points[:, 2]
    return np.stack(
        [(height - whole.foot) / whole.tall, out / whole.wide, out / whole.size, (height - middle) / whole.size],
        axis=1,
    )


def _spread(weights: Floats, offsets: Floats) -> Floats:
    """How weighted points are spread about each of n points (n, 8).

    As a line, a sheet or a ball, how upright these are, how much there is, and how far off its middle is.
    """
    weights = weights + 1e-12
    mass = weights.sum(axis=1)
    middle = np.einsum("pq,pqk->pk", weights, offsets) / mass[:, None]
    scatter = np.einsum("pq,pqk,pql->pkl", weights, offsets, offsets, optimize=True) / mass[:, None, None]
    values, axes = np.linalg.eigh(scatter - middle[:, :, None] * middle[:, None, :])
    lengths = np.sqrt(np.maximum(values, 1e-12))
    thin, wide, long = lengths.T
    upward = along(np.broadcast_to([0.0, 0.0, 1.0], lengths.shape), lengths, axes)
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


def _rings(whole: Whole, offsets: Floats) -> Floats:
    """The share of the whole in each ring about the upright axis through each of n points (n, cells), as a root."""
    level = np.digitize(offsets[:, :, 2], _BELOW)
    aside = np.digitize(np.hypot(offsets[:, :, 0], offsets[:, :, 1]), _ASIDE)
    cell = level * (len(_ASIDE) + 1) + aside
    count = len(offsets)
    flat = (np.arange(count)[:, None] * _CELLS + cell).ravel()
    shares = np.bincount(flat, np.tile(whole.weights, count), count * _CELLS)
    return np.sqrt(shares).reshape(count, _CELLS)
