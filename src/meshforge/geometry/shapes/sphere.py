"""The sphere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats
from meshforge.geometry.pose import Pose
from meshforge.geometry.shapes.base import Shape, scaled_rotation
from meshforge.geometry.shapes.polytope import Polytope
from meshforge.geometry.shapes.tessellation import unit_sphere


@dataclass(frozen=True, eq=False, slots=True)
class Sphere(Shape):
    """A sphere about the origin of `pose`, whose rotation is kept only to be written back; radius [m]."""

    kind: ClassVar[str] = "sphere"
    pose: Pose
    radius: float

    @property
    def aabb(self) -> Aabb:
        return Aabb(self.pose.translation - self.radius, self.pose.translation + self.radius)

    @property
    def volume(self) -> float:
        return 4.0 / 3.0 * np.pi * self.radius**3

    @property
    def centroid(self) -> Floats:
        return self.pose.translation

    def support(self, direction: Floats) -> Floats:
        return self.pose.translation + direction * (self.radius / float(np.linalg.norm(direction)))

    def tessellate(self) -> Polytope:
        points, faces = unit_sphere()
        return Polytope(self.pose.apply(points * self.radius), faces)

    def transform(self, linear: Floats, offset: Floats) -> Shape:
        split = scaled_rotation(linear @ self.pose.rotation)
        if split is None or np.ptp(split[1]) > 1e-9 * split[1].max():
            return self.tessellate().transform(linear, offset)
        rotation, scales = split
        return Sphere(Pose(rotation, linear @ self.pose.translation + offset), self.radius * float(scales.mean()))
