"""Axis-aligned bounding boxes."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from dataclasses import dataclass

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
        boxes = list(boxes)
        return Aabb(np.min([b.min for b in boxes], axis=0), np.max([b.max for b in boxes], axis=0))

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
        return float(np.linalg.norm(self.size))

    @property
    def corners(self) -> Floats:
        """The eight corners (8, 3)."""
        return np.array(list(itertools.product(*zip(self.min, self.max, strict=True))))
