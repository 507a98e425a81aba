"""Rotations as glTF writes them."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats

_ALIKE = 1e-12  # how far the square of a quaternion's length may be from one, to be taken as it is


def turns_of(quaternions: Floats) -> Floats:
    """The rotations (..., 3, 3) of quaternions (..., 4), x y z w, of any length. Raises ValueError: one of zeros."""
    largest = np.abs(quaternions).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError("a rotation of all zeros")
    near = quaternions / largest  # lest a square has no number
    squares = np.square(quaternions).sum(axis=-1, keepdims=True)
    unit = np.where(np.abs(squares - 1.0) > _ALIKE, near / np.linalg.norm(near, axis=-1, keepdims=True), quaternions)
    x, y, z, w = np.moveaxis(unit, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
