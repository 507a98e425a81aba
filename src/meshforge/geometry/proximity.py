"""Distances between convex shapes, behind a comparison of AABBs: by coal, or by FCL where coal has no wheel."""

from collections.abc import Sequence
from importlib.util import find_spec
from math import inf
from typing import TYPE_CHECKING

from meshforge.geometry.arrays import bounds, near_boxes
from meshforge.geometry.shape import Shape

if TYPE_CHECKING or find_spec("coal"):
    from meshforge.geometry import coal_distance as _engine
else:
    from meshforge.geometry import fcl_distance as _engine


def distance(a: Shape, b: Shape) -> float:
    """Return the smallest distance [m] between two convex shapes, 0 where they touch or overlap."""
    return close_pairs([a, b], inf)[0, 1]


def close_pairs(
    shapes: Sequence[Shape], reach: float, unchanged: frozenset[int] = frozenset()
) -> dict[tuple[int, int], float]:
    """Return distance of each pair (i, j), i < j, of shapes at most `reach` [m] apart, in order of (i, j).

    unchanged: indices among which no pair is wanted, only pairs with one of the others.
    """
    if len(shapes) < 2:
        return {}
    low, high = bounds([shape.aabb for shape in shapes])
    near = near_boxes(low, high, reach)
    if unchanged:
        near = [(i, j) for i, j in near if i not in unchanged or j not in unchanged]
    gaps = _engine.measure_gaps(shapes, near, low.min(axis=0), high.max(axis=0))
    return {pair: gap for pair, gap in zip(near, gaps, strict=True) if gap <= reach}
