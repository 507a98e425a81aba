"""The ellipsoid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats, frozen_floats
from meshforge.geometry.pose import Pose
from meshforge.geometry.shapes.base import Shape, scaled_rotation
from meshforge.geometry.shapes.polytope import Polytope
from meshforge.geometry.shapes.tessellation import unit_sphere


@dataclass(frozen=True, eq=False, slots=True)
class Ellipsoid(Shape):
    """An ellipsoid about the origin of `pose`; radii: (3,) semi-axes along the axes of `pose` [m]."""

    kind: ClassVar[str] = "ellipsoid"
    pose: Pose
    radii: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "radii", frozen_floats(self.radii, (3,)))

    @property
    def aabb(self) -> Aabb:
        reach = np.linalg.norm(self.pose.rotation * self.radii, axis=1)
        return Aabb(self.pose.translation - reach, self.pose.translation + reach)

    @property
    def volume(self) -> float:
        return float(4.0 / 3.0 * np.pi * np.prod(self.radii))

    @property
    def centroid(self) -> Floats:
        return self.pose.translation

    def support(self, direction: Floats) -> Floats:
        pull = self.radii * (self.pose.rotation.T @ direction)
        return self.pose.rotation @ (self.radii * pull / np.linalg.norm(pull)) + self.pose.translation

    def tessellate(self) -> Polytope:
        points, faces = unit_sphere()
        return Polytope(self.pose.apply(points * self.radii), faces)

    def transform(self, linear: Floats, offset: Floats) -> Shape:
        center = linear @ self.pose.translation + offset
        split = scaled_rotation(linear @ self.pose.rotation)
        if split is not None:
            return Ellipsoid(Pose(split[0], center), self.radii * split[1])
        rotation, radii, _ = np.linalg.svd(linear @ self.pose.rotation * self.radii)
        if np.linalg.det(rotation) < 0:
            rotation = rotation * np.array([1.0, 1.0, -1.0])
        return Ellipsoid(Pose(rotation, center), radii)
