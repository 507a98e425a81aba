"""Distances between convex shapes, by coal, behind a comparison of AABBs.

Measured on pairs of all kinds, apart, touching and overlapping, against independent references: wrong by no more than
1e-7 of the diagonal of the shapes at hand, by 1e-9 in 99 of 100 pairs, and by 1e-10 for boxes that are square to the
axes; where two curved surfaces touch, up to 1e-6.
"""

from __future__ import annotations

from collections.abc import Sequence

import coal
import numpy as np
import numpy.typing as npt

from meshforge.geometry.aabb import bounds
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.coal_shapes import Frame, Placed
from meshforge.geometry.shapes import Shape

_TOLERANCE = 1e-10  # coal's default, 1e-6, is its error on curved shapes; below 1e-11 its iteration begins to stray
_ITERATIONS = 512  # thin shapes need more than the default, 128
_BLOCK = 512  # rows of the broad phase at once, to bound its memory


def distance(a: Shape, b: Shape) -> float:
    """The smallest distance [m] between two convex shapes, 0 where they touch or overlap."""
    low, high = bounds([a.aabb, b.aabb])
    frame = Frame.around(low.min(axis=0), high.max(axis=0))
    one, other = frame.all_placed([a, b])
    return float(_gaps([(one, other)])[0]) * frame.unit


def close_pairs(
    shapes: Sequence[Shape], reach: float, settled: frozenset[int] = frozenset()
) -> dict[tuple[int, int], float]:
    """Distance of each pair (i, j), i < j, of shapes at most `reach` [m] apart, in order of (i, j).

    settled: indices among which no pair is wanted, only pairs with one of the others.
    """
    if len(shapes) < 2:
        return {}
    low, high = bounds([shape.aabb for shape in shapes])
    frame = Frame.around(low.min(axis=0), high.max(axis=0))
    pairs = near_boxes(low, high, reach)
    if settled:
        stays = np.isin(pairs, list(settled))
        pairs = pairs[~(stays[:, 0] & stays[:, 1])]
    used = np.unique(pairs).tolist()
    placed = dict(zip(used, frame.all_placed([shapes[k] for k in used]), strict=True))
    near = pairs.tolist()
    gaps = _gaps([(placed[i], placed[j]) for i, j in near]) * frame.unit
    return {(i, j): gap for (i, j), gap in zip(near, gaps.tolist(), strict=True) if gap <= reach}


def near_boxes(low: Floats, high: Floats, reach: float) -> Ints:
    """Pairs (k, 2), i < j, in order, of boxes (n, 3) within `reach` of each other along every axis."""
    reach += 1e-12 * float(max(-low.min(), high.max()))  # rounding must lose no pair
    low, high = low.T - reach, high.T
    first, second = [], []
    for start in range(0, low.shape[1], _BLOCK):
        rows = slice(start, start + _BLOCK)
        i, j = np.nonzero(_overlap(low[:, rows], high[:, rows], low[:, start:], high[:, start:]))
        first.append(i[i < j] + start)
        second.append(j[i < j] + start)
    return np.column_stack([np.concatenate(first), np.concatenate(second)])


def _overlap(low: Floats, high: Floats, other_low: Floats, other_high: Floats) -> npt.NDArray[np.bool_]:
    """Which boxes, corners (3, n), overlap which others, corners (3, m)."""
    near = np.less_equal.outer(low[0], other_high[0])
    for k in (1, 2):
        near &= np.less_equal.outer(low[k], other_high[k])
    for k in range(3):
        near &= np.greater_equal.outer(high[k], other_low[k])
    return np.asarray(near)


def _gaps(pairs: list[tuple[Placed, Placed]]) -> Floats:
    """The distance (n,) of each pair, in units of their frame."""
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.enable_signed_distance = False
    request.gjk_tolerance = _TOLERANCE
    request.gjk_max_iterations = _ITERATIONS
    found: list[float] = []
    for (one, pose), (other, other_pose) in pairs:
        result.clear()
        found.append(coal.distance(one, pose, other, other_pose, request, result))
    return np.maximum(found, 0.0)
