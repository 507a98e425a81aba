"""Rigid transforms, and rotations: the 24 axis-aligned ones, the smallest between two directions, quaternions."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.geometry.arrays import Floats, freeze_floats

_ROUNDING = 1e-9  # an entry this near -1, 0 or 1 is one of them


@dataclass(frozen=True, eq=False, slots=True, init=False)
class Pose:
    """A rotation and a translation, `a_T_b`: takes coordinates in b to coordinates in a.

    rotation: (3, 3), a proper rotation; translation: (3,) [m].
    """

    rotation: Floats
    translation: Floats

    def __init__(self, rotation: npt.ArrayLike, translation: npt.ArrayLike) -> None:
        object.__setattr__(self, "rotation", freeze_floats(rotation, (3, 3)))
        object.__setattr__(self, "translation", freeze_floats(translation, (3,)))

    @staticmethod
    def identity() -> Pose:
        return Pose(np.eye(3), np.zeros(3))

    @staticmethod
    def of_translation(translation: npt.ArrayLike) -> Pose:
        return Pose(np.eye(3), translation)

    @staticmethod
    def from_rpy(xyz: Sequence[float], rpy: Sequence[float]) -> Pose:
        """Return the URDF origin: roll, pitch, yaw about the fixed X, Y, Z axes [rad]; xyz [m]."""
        (sr, sp, sy), (cr, cp, cy) = np.sin(rpy), np.cos(rpy)
        rotation = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
        return Pose(rotation, xyz)

    def to_rpy(self) -> tuple[float, float, float]:
        """Return roll, pitch, yaw [rad], the inverse of `from_rpy` (yaw 0 where pitch is +-90 degrees)."""
        r = self.rotation
        horizontal = float(np.hypot(r[0, 0], r[1, 0]))
        pitch = float(np.arctan2(-r[2, 0], horizontal))
        yaw = float(np.arctan2(r[1, 0], r[0, 0])) if horizontal > 1e-12 else 0.0
        # roll of what is left when the yaw is undone: exact for any yaw, where pitch is near 90 degrees too
        sy, cy = np.sin(yaw), np.cos(yaw)
        roll = float(np.arctan2(sy * r[0, 2] - cy * r[1, 2], cy * r[1, 1] - sy * r[0, 1]))
        return roll, pitch, yaw

    def to_quaternion(self) -> Floats:
        """Return the rotation as a unit quaternion (4,), w x y z, w not negative."""
        r = self.rotation
        # the four squares times four; the largest is divided by, so that nothing is lost near half turns
        squares = 1.0 + np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) @ np.diag(r)
        products = np.array(
            [
                [squares[0], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
                [r[2, 1] - r[1, 2], squares[1], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
                [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], squares[2], r[1, 2] + r[2, 1]],
                [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], squares[3]],
            ]
        )[int(np.argmax(squares))]
        quaternion: Floats = products / np.linalg.norm(products)
        return -quaternion if quaternion[0] < 0 else quaternion

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(self.rotation @ other.rotation, self.rotation @ other.translation + self.translation)

    def inverse(self) -> Pose:
        return Pose(self.rotation.T, -self.rotation.T @ self.translation)

    def apply(self, points: Floats) -> Floats:
        """Convert points (n, 3) in b to points (n, 3) in a."""
        return points @ self.rotation.T + self.translation


@cache
def axis_aligned_rotations() -> tuple[Floats, ...]:
    """Return the 24 rotations that take axes to axes, (3, 3) each, in a fixed order with the identity first."""
    turns = []
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), order] = signs
            if np.linalg.det(matrix) > 0:
                turns.append(matrix)
    return tuple(turns)


def snap_rotation(rotation: Floats) -> Floats:
    """Return the rotation itself, or the axis-aligned one that it is but for rounding."""
    rounded = np.rint(rotation) + 0.0
    return rounded if np.abs(rotation - rounded).max() <= _ROUNDING else rotation


def rotation_about(axis: Floats, angle: float) -> Floats:
    """Return the rotation by an angle [rad] about a unit vector (3,), by the right-hand rule."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn: Floats = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    return turn


def smallest_rotation(start: Floats, end: Floats) -> Floats:
    """Return the smallest rotation that takes the unit vector `start` to the axis `end` (3,).

    For opposite ones it is the half turn about the axis that follows `end` in the order X, Y, Z, X.
    """
    normal = np.cross(start, end)
    sine, cosine = float(np.linalg.norm(normal)), float(start @ end)
    if sine > _ROUNDING:
        return rotation_about(normal / sine, float(np.arctan2(sine, cosine)))
    if cosine > 0:
        return np.eye(3)
    return np.diag(np.where(np.roll(np.abs(np.rint(end)), 1) > 0, 1.0, -1.0))


def nearest_aligned_rotation(rotation: Floats) -> Floats:
    """Return the axis-aligned rotation nearest to another; of equally near ones the nearest to the identity."""
    return _best_aligned(lambda turn: float(np.trace(turn.T @ rotation)))


def nearest_aligned_rotation_between(start: Floats, end: Floats) -> Floats:
    """Return the axis-aligned rotation that takes `start` nearest to `end` (3,), of these the nearest to identity."""
    return _best_aligned(lambda turn: float(end @ turn @ start))


def _best_aligned(likeness: Callable[[Floats], float]) -> Floats:
    best = max(map(likeness, axis_aligned_rotations()))
    tied = [turn for turn in axis_aligned_rotations() if likeness(turn) >= best - _ROUNDING]
    return max(tied, key=lambda turn: float(np.trace(turn)))


def rotation_of_quaternion(quaternion: npt.ArrayLike) -> Floats:
    """Return the rotation (3, 3) of a quaternion (4,), w x y z, of any length but zero."""
    return np.array(_rotation_rows(np.asarray(quaternion) / np.linalg.norm(quaternion)))


def rotations_of_quaternions(quaternions: Floats) -> Floats:
    """Return rotations (k, 3, 3) of quaternions (k, 4), scalar first, of any length."""
    rows = _rotation_rows((quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T)
    return np.moveaxis(np.array(rows), 2, 0)


def _rotation_rows(unit: Floats) -> list[list[Any]]:
    """The rows of the rotation of a unit quaternion (4,), or of many at once (4, k)."""
    w, x, y, z = unit
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def quaternions_of_rotations(rotations: Floats) -> Floats:
    """Return quaternions (k, 4) of rotations (k, 3, 3), as eigenvectors of a symmetric matrix of each (Bar-Itzhack)."""
    r = np.moveaxis(rotations, 0, 2)
    form = np.zeros((len(rotations), 4, 4))
    form[:, 0, 0] = np.trace(r)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        form[:, k + 1, k + 1] = r[k, k] - r[i, i] - r[j, j]
        form[:, i + 1, j + 1] = form[:, j + 1, i + 1] = r[i, j] + r[j, i]
        form[:, 0, k + 1] = form[:, k + 1, 0] = r[j, i] - r[i, j]
    return np.linalg.eigh(form)[1][:, :, -1]
