"""Rigid transforms: where a shape or a body is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from meshforge.geometry.arrays import Floats, frozen_floats


@dataclass(frozen=True, eq=False, slots=True, init=False)
class Pose:
    """A rotation and a translation, `a_T_b`: takes coordinates in b to coordinates in a.

    rotation: (3, 3), a proper rotation; translation: (3,) [m].
    """

    rotation: Floats
    translation: Floats

    def __init__(self, rotation: npt.ArrayLike, translation: npt.ArrayLike) -> None:
        object.__setattr__(self, "rotation", frozen_floats(rotation, (3, 3)))
        object.__setattr__(self, "translation", frozen_floats(translation, (3,)))

    @staticmethod
    def identity() -> Pose:
        return Pose(np.eye(3), np.zeros(3))

    @staticmethod
    def of_translation(translation: npt.ArrayLike) -> Pose:
        return Pose(np.eye(3), translation)

    @staticmethod
    def from_rpy(xyz: Sequence[float], rpy: Sequence[float]) -> Pose:
        """The URDF origin: roll, pitch, yaw about the fixed X, Y, Z axes [rad]; xyz [m]."""
        (sr, sp, sy), (cr, cp, cy) = np.sin(rpy), np.cos(rpy)
        rotation = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
        return Pose(rotation, xyz)

    def to_rpy(self) -> tuple[float, float, float]:
        """Roll, pitch, yaw [rad], the inverse of `from_rpy` (yaw 0 where pitch is +-90 degrees)."""
        r = self.rotation
        horizontal = float(np.hypot(r[0, 0], r[1, 0]))
        pitch = float(np.arctan2(-r[2, 0], horizontal))
        yaw = float(np.arctan2(r[1, 0], r[0, 0])) if horizontal > 1e-12 else 0.0
        # roll of what is left when the yaw is undone: exact for any yaw, where pitch is near 90 degrees too
        sy, cy = np.sin(yaw), np.cos(yaw)
        roll = float(np.arctan2(sy * r[0, 2] - cy * r[1, 2], cy * r[1, 1] - sy * r[0, 1]))
        return roll, pitch, yaw

    def to_quaternion(self) -> Floats:
        """The rotation as a unit quaternion (4,), w x y z, w not negative."""
        r = self.rotation
        # the four squares times four; the largest is divided by, so that nothing is lost near half turns
        squares = 1.0 + np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) @ np.diag(r)
        largest = int(np.argmax(squares))
        products = np.array(
            [
                [squares[0], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
                [r[2, 1] - r[1, 2], squares[1], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
                [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], squares[2], r[1, 2] + r[2, 1]],
                [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], squares[3]],
            ]
        )[largest]
        quaternion: Floats = products / np.linalg.norm(products)
        return -quaternion if quaternion[0] < 0 else quaternion

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(self.rotation @ other.rotation, self.rotation @ other.translation + self.translation)

    def inverse(self) -> Pose:
        return Pose(self.rotation.T, -self.rotation.T @ self.translation)

    def apply(self, points: Floats) -> Floats:
        """Points (n, 3) in b to points (n, 3) in a."""
        return points @ self.rotation.T + self.translation
