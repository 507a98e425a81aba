"""Rotations: the 24 axis-aligned ones exactly, and the smallest that takes one direction to another."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from functools import cache

import numpy as np

from meshforge.geometry import Floats

_ROUNDING = 1e-9  # an entry this near -1, 0 or 1 is one of them


@cache
def axis_aligned() -> tuple[Floats, ...]:
    """The 24 rotations that take axes to axes, (3, 3) each, in a fixed order with the identity first."""
    turns = []
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), order] = signs
            if np.linalg.det(matrix) > 0:
                turns.append(matrix)
    return tuple(turns)


def exact(rotation: Floats) -> Floats:
    """The rotation itself, or the axis-aligned one that it is but for rounding."""
    rounded = np.rint(rotation) + 0.0
    return rounded if np.abs(rotation - rounded).max() <= _ROUNDING else rotation


def about(axis: Floats, angle: float) -> Floats:
    """The rotation by an angle [rad] about a unit vector (3,), by the right-hand rule."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn: Floats = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    return turn


def smallest(start: Floats, end: Floats) -> Floats:
    """The smallest rotation that takes the unit vector `start` to the axis `end` (3,).

    For opposite ones it is the half turn about the axis that follows `end` in the order X, Y, Z, X.
    """
    normal = np.cross(start, end)
    sine, cosine = float(np.linalg.norm(normal)), float(start @ end)
    if sine > _ROUNDING:
        return about(normal / sine, float(np.arctan2(sine, cosine)))
    if cosine > 0:
        return np.eye(3)
    return np.diag(np.where(np.roll(np.abs(np.rint(end)), 1) > 0, 1.0, -1.0))


def nearest_aligned(rotation: Floats) -> Floats:
    """The axis-aligned rotation nearest to another; of equally near ones the nearest to the identity."""
    return _best(lambda turn: float(np.trace(turn.T @ rotation)))


def nearest_aligned_taking(start: Floats, end: Floats) -> Floats:
    """The axis-aligned rotation that takes `start` nearest to `end` (3,); of these the nearest to the identity."""
    return _best(lambda turn: float(end @ turn @ start))


def _best(likeness: Callable[[Floats], float]) -> Floats:
    best = max(map(likeness, axis_aligned()))
    tied = [turn for turn in axis_aligned() if likeness(turn) >= best - _ROUNDING]
    return max(tied, key=lambda turn: float(np.trace(turn)))
