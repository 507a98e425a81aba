"""The box."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats, frozen_floats
from meshforge.geometry.pose import Pose
from meshforge.geometry.shapes.base import Shape, scaled_rotation
from meshforge.geometry.shapes.polytope import Polytope

_CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
_FACES = [
    [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
    [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
]  # fmt: skip


@dataclass(frozen=True, eq=False, slots=True)
class Box(Shape):
    """A box about its own centre; half: (3,) half sides along the axes of `pose` [m]."""

    kind: ClassVar[str] = "box"
    pose: Pose
    half: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "half", frozen_floats(self.half, (3,)))

    @staticmethod
    def of_bounds(bounds: Aabb) -> Box:
        """The axis-aligned box that is `bounds`."""
        return Box(Pose.of_translation(bounds.center), bounds.size / 2)

    @property
    def aabb(self) -> Aabb:
        reach = np.abs(self.pose.rotation) @ self.half
        return Aabb(self.pose.translation - reach, self.pose.translation + reach)

    @property
    def volume(self) -> float:
        return float(8.0 * np.prod(self.half))

    @property
    def centroid(self) -> Floats:
        return self.pose.translation

    def support(self, direction: Floats) -> Floats:
        side = np.where(self.pose.rotation.T @ direction >= 0, 1.0, -1.0)
        return self.pose.rotation @ (side * self.half) + self.pose.translation

    def tessellate(self) -> Polytope:
        return Polytope(self.pose.apply(_CORNERS * self.half), np.array(_FACES))

    def transform(self, linear: Floats, offset: Floats) -> Shape:
        split = scaled_rotation(linear @ self.pose.rotation)
        if split is None:
            return self.tessellate().transform(linear, offset)
        rotation, scales = split
        return Box(Pose(rotation, linear @ self.pose.translation + offset), self.half * scales)
