"""The capsule."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats
from meshforge.geometry.pose import Pose
from meshforge.geometry.shapes.base import Shape, scaled_rotation
from meshforge.geometry.shapes.polytope import Polytope
from meshforge.geometry.shapes.tessellation import capsule


@dataclass(frozen=True, eq=False, slots=True)
class Capsule(Shape):
    """A capsule about the Z axis of `pose`, centred; radius and half_length of its straight part [m]."""

    kind: ClassVar[str] = "capsule"
    pose: Pose
    radius: float
    half_length: float

    @property
    def aabb(self) -> Aabb:
        reach = self.half_length * np.abs(self.pose.rotation[:, 2]) + self.radius
        return Aabb(self.pose.translation - reach, self.pose.translation + reach)

    @property
    def volume(self) -> float:
        return np.pi * self.radius**2 * (2.0 * self.half_length + 4.0 / 3.0 * self.radius)

    @property
    def centroid(self) -> Floats:
        return self.pose.translation

    def support(self, direction: Floats) -> Floats:
        axis = self.pose.rotation[:, 2]
        end = self.pose.translation + axis * (self.half_length if axis @ direction >= 0 else -self.half_length)
        return end + direction * (self.radius / float(np.linalg.norm(direction)))

    def tessellate(self) -> Polytope:
        points, faces = capsule(self.radius, self.half_length)
        return Polytope(self.pose.apply(points), faces)

    def transform(self, linear: Floats, offset: Floats) -> Shape:
        split = scaled_rotation(linear @ self.pose.rotation)
        if split is None or np.ptp(split[1]) > 1e-9 * split[1].max():
            return self.tessellate().transform(linear, offset)
        rotation, scales = split
        scale = float(scales.mean())
        pose = Pose(rotation, linear @ self.pose.translation + offset)
        return Capsule(pose, self.radius * scale, self.half_length * scale)
