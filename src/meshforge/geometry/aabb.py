"""Axis-aligned bounding boxes, and which of many are near each other."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import dist

import numpy as np
import numpy.typing as npt

from meshforge.geometry.arrays import Floats, freeze_floats

_ROWS_AT_ONCE = 512  # rows of the broad phase at once, to bound its memory


@dataclass(frozen=True, eq=False, slots=True, init=False)
class Aabb:
    """The axis-aligned box between two corners; min, max: (3,) [m]."""

    min: Floats
    max: Floats

    def __init__(self, min: npt.ArrayLike, max: npt.ArrayLike) -> None:
        object.__setattr__(self, "min", freeze_floats(min, (3,)))
        object.__setattr__(self, "max", freeze_floats(max, (3,)))

    @staticmethod
    def of_points(points: Floats) -> Aabb:
        """The smallest box around points (n, 3), n at least 1."""
        return Aabb(points.min(axis=0), points.max(axis=0))

    @staticmethod
    def union(boxes: Iterable[Aabb]) -> Aabb:
        """The smallest box around all boxes, of which there is at least one."""
        low, high = bounds(list(boxes))
        return Aabb(low.min(axis=0), high.max(axis=0))

    @property
    def center(self) -> Floats:
        return (self.min + self.max) / 2

    @property
    def size(self) -> Floats:
        """Side lengths (3,) [m]."""
        return self.max - self.min

    @property
    def diagonal(self) -> float:
        """Length of the spatial diagonal [m]."""
        return dist(self.min.tolist(), self.max.tolist())

    def intersects(self, other: Aabb) -> bool:
        """Whether two boxes have more in common than a side, an edge or a corner."""
        return bool((np.maximum(self.min, other.min) < np.minimum(self.max, other.max)).all())

    @property
    def corners(self) -> Floats:
        """The eight corners (8, 3)."""
        return np.array(list(itertools.product(*zip(self.min, self.max, strict=True))))


def bounds(boxes: Sequence[Aabb]) -> tuple[Floats, Floats]:
    """The lowest corners (n, 3) of n boxes, at least one, and the highest."""
    low, high = np.concatenate([box.min for box in boxes]), np.concatenate([box.max for box in boxes])
    return low.reshape(-1, 3), high.reshape(-1, 3)


def near_boxes(low: Floats, high: Floats, reach: float) -> list[tuple[int, int]]:
    """Pairs (i, j), i < j, in order, of boxes (n, 3) within `reach` of each other along every axis."""
    reach += 1e-12 * max(-float(low.min()), float(high.max()))  # rounding must lose no pair
    low, high = low.T - reach, high.T
    pairs: list[tuple[int, int]] = []
    for start in range(0, low.shape[1], _ROWS_AT_ONCE):
        rows = slice(start, start + _ROWS_AT_ONCE)
        near = (low[:, rows, None] <= high[:, None, start:]) & (high[:, rows, None] >= low[:, None, start:])
        first, second = np.nonzero(near[0] & near[1] & near[2])
        pairs += [(i + start, j + start) for i, j in zip(first.tolist(), second.tolist(), strict=True) if i < j]
    return pairs
