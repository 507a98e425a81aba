"""Unit tessellations of the round primitives, at most 64 vertices, whose AABB is that of the true shape."""

from __future__ import annotations

from functools import cache

import numpy as np

from meshforge.geometry.arrays import Floats, Ints, frozen_floats, frozen_ints

_AROUND = 8  # a multiple of four, so that a ring reaches +-X and +-Y
_SIDES = 32


def _ring(radius: float, z: float, count: int) -> Floats:
    turn = np.arange(count) * (2 * np.pi / count)
    x, y = np.cos(turn), np.sin(turn)
    x[np.abs(x) < 1e-15], y[np.abs(y) < 1e-15] = 0.0, 0.0
    return np.column_stack([radius * x, radius * y, np.full(count, z)])


def _lofted(rings: list[Floats]) -> tuple[Floats, Ints]:
    """The closed surface through rings of equal count from bottom to top; a ring of one point is a pole."""
    starts = np.concatenate([[0], np.cumsum([len(r) for r in rings])])
    faces: list[list[int]] = []
    for lower, upper, a, b in zip(rings, rings[1:], starts, starts[1:], strict=False):
        count = max(len(lower), len(upper))
        for k in range(count):
            n = (k + 1) % count
            if len(lower) > 1:
                faces.append([a + k, a + n, b + (n if len(upper) > 1 else 0)])
            if len(upper) > 1:
                faces.append([a + (k if len(lower) > 1 else 0), b + n, b + k])
    return frozen_floats(np.concatenate(rings), (-1, 3)), frozen_ints(faces, (-1, 3))


def _dome(steps: int) -> list[tuple[float, float]]:
    """Radius and height of the rings of a unit half sphere, equator first, pole left out."""
    return [(float(np.cos(a)), float(np.sin(a))) for a in np.arange(steps) * (np.pi / 2 / steps)]


@cache
def unit_sphere() -> tuple[Floats, Ints]:
    """Vertices (58, 3) and outward triangles of the sphere of radius 1 about the origin."""
    dome = _dome(4)
    below = [_ring(r, -z, _AROUND) for r, z in reversed(dome[1:])]
    above = [_ring(r, z, _AROUND) for r, z in dome]
    return _lofted([np.array([[0.0, 0.0, -1.0]]), *below, *above, np.array([[0.0, 0.0, 1.0]])])


@cache
def unit_cylinder() -> tuple[Floats, Ints]:
    """Vertices (64, 3) and outward triangles of the cylinder of radius 1 from z = -1 to z = 1."""
    vertices = np.concatenate([_ring(1.0, -1.0, _SIDES), _ring(1.0, 1.0, _SIDES)])
    side = [t for k in range(_SIDES) for t in _quad(k, (k + 1) % _SIDES)]
    caps = [t for k in range(1, _SIDES - 1) for t in ([0, k + 1, k], [_SIDES, _SIDES + k, _SIDES + k + 1])]
    return frozen_floats(vertices, (-1, 3)), frozen_ints(side + caps, (-1, 3))


def _quad(k: int, n: int) -> list[list[int]]:
    return [[k, n, _SIDES + n], [k, _SIDES + n, _SIDES + k]]


def capsule(radius: float, half_length: float) -> tuple[Floats, Ints]:
    """Vertices (50, 3) and outward triangles of the capsule about local Z; half_length of its straight part [m]."""
    dome = [(radius * r, radius * z + half_length) for r, z in _dome(3)]
    top = radius + half_length
    below = [_ring(r, -z, _AROUND) for r, z in reversed(dome)]
    above = [_ring(r, z, _AROUND) for r, z in dome]
    return _lofted([np.array([[0.0, 0.0, -top]]), *below, *above, np.array([[0.0, 0.0, top]])])
