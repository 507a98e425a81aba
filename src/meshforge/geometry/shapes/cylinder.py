"""The cylinder."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats
from meshforge.geometry.pose import Pose
from meshforge.geometry.shapes.base import Shape, scaled_rotation
from meshforge.geometry.shapes.polytope import Polytope
from meshforge.geometry.shapes.tessellation import unit_cylinder


@dataclass(frozen=True, eq=False, slots=True)
class Cylinder(Shape):
    """A cylinder about the Z axis of `pose`, centred; radius, half_length [m]."""

    kind: ClassVar[str] = "cylinder"
    pose: Pose
    radius: float
    half_length: float

    @property
    def aabb(self) -> Aabb:
        axis = self.pose.rotation[:, 2]
        reach = self.half_length * np.abs(axis) + self.radius * np.sqrt(np.clip(1.0 - axis**2, 0.0, 1.0))
        return Aabb(self.pose.translation - reach, self.pose.translation + reach)

    @property
    def volume(self) -> float:
        return 2.0 * np.pi * self.radius**2 * self.half_length

    @property
    def centroid(self) -> Floats:
        return self.pose.translation

    def support(self, direction: Floats) -> Floats:
        x, y, z = self.pose.rotation.T @ direction
        flat = float(np.hypot(x, y))
        scale = self.radius / flat if flat > 0 else 0.0
        local = np.array([x * scale, y * scale, self.half_length if z >= 0 else -self.half_length])
        point: Floats = self.pose.rotation @ local + self.pose.translation
        return point

    def tessellate(self) -> Polytope:
        points, faces = unit_cylinder()
        return Polytope(self.pose.apply(points * [self.radius, self.radius, self.half_length]), faces)

    def transform(self, linear: Floats, offset: Floats) -> Shape:
        split = scaled_rotation(linear @ self.pose.rotation)
        if split is None or abs(split[1][0] - split[1][1]) > 1e-9 * split[1].max():
            return self.tessellate().transform(linear, offset)
        rotation, scales = split
        pose = Pose(rotation, linear @ self.pose.translation + offset)
        return Cylinder(pose, self.radius * float(scales[:2].mean()), self.half_length * float(scales[2]))
