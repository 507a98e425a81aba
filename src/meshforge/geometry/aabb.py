"""Axis-aligned bounding boxes."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import dist

import numpy as np
import numpy.typing as npt

from meshforge.geometry.arrays import Floats, frozen_floats


@dataclass(frozen=True, eq=False, slots=True, init=False)
class Aabb:
    """The axis-aligned box between two corners; min, max: (3,) [m]."""

    min: Floats
    max: Floats

    def __init__(self, min: npt.ArrayLike, max: npt.ArrayLike) -> None:
        object.__setattr__(self, "min", frozen_floats(min, (3,)))
        object.__setattr__(self, "max", frozen_floats(max, (3,)))

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

    @property
    def corners(self) -> Floats:
        """The eight corners (8, 3)."""
        return np.array(list(itertools.product(*zip(self.min, self.max, strict=True))))


def bounds(boxes: Sequence[Aabb]) -> tuple[Floats, Floats]:
    """The lowest corners (n, 3) of n boxes, at least one, and the highest."""
    low, high = np.concatenate([box.min for box in boxes]), np.concatenate([box.max for box in boxes])
    return low.reshape(-1, 3), high.reshape(-1, 3)
