"""Shapes as triangles to look at: round primitives much finer than their tessellations, with smooth normals."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import assert_never

import numpy as np

from meshforge.asset import Surface
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Ints, Polytope, Pose, Shape, Sphere


@dataclass(frozen=True, eq=False, slots=True)
class Skin:
    """Triangles of one thing: vertices (n, 3) [m], faces (m, 3); normals (n, 3) where it is to look round."""

    vertices: Floats
    faces: Ints
    normals: Floats | None = None


def skin(shape: Shape | Surface, sides: int = 96) -> Skin:
    """The triangles to draw a shape with; sides: how many a round one has about its axis."""
    match shape:
        case Sphere():
            return _revolved(_dome_profile(sides), sides, shape.pose, np.full(3, shape.radius))
        case Ellipsoid():
            return _revolved(_dome_profile(sides), sides, shape.pose, shape.radii)
        case Cylinder():
            scales = np.array([shape.radius, shape.radius, shape.half_length])
            return _revolved(_CYLINDER, sides, shape.pose, scales)
        case Capsule():
            return _revolved(_capsule_profile(shape, sides), sides, shape.pose, np.full(3, shape.radius))
        case Box() | Polytope() | Surface():
            return Skin(shape.vertices, shape.faces)
        case Shape():
            return Skin(shape.vertices, shape.faces)
        case _:
            assert_never(shape)


_CYLINDER = np.array(
    [[0, -1, 0, -1], [1, -1, 0, -1], [1, -1, 1, 0], [1, 1, 1, 0], [1, 1, 0, 1], [0, 1, 0, 1]], dtype=np.float64
)
"""Radius, height, and the normal's radial and axial part, from bottom to top; doubled rings make sharp rims."""


def _dome_profile(sides: int) -> Floats:
    turn = np.linspace(-np.pi / 2, np.pi / 2, sides // 2 + 1)
    r, z = np.cos(turn), np.sin(turn)
    r[[0, -1]] = 0.0
    return np.column_stack([r, z, r, z])


def _capsule_profile(shape: Capsule, sides: int) -> Floats:
    """The profile in units of the radius."""
    dome = _dome_profile(sides)
    middle = len(dome) // 2 + 1
    straight = np.array([0.0, shape.half_length / shape.radius, 0.0, 0.0])
    return np.concatenate([dome[:middle] - straight, dome[middle - 1 :] + straight])


def _revolved(profile: Floats, sides: int, pose: Pose, scales: Floats) -> Skin:
    """The surface that a profile (k, 4) sweeps about Z, scaled along the axes, then posed."""
    turn = np.arange(sides) * (2 * np.pi / sides)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    points, normals = (_swept(profile[:, k : k + 2], circle) for k in (0, 2))
    normals = normals / scales @ pose.rotation.T
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return Skin(pose.apply(points * scales), _bands(profile, sides), normals)


def _swept(rings: Floats, circle: Floats) -> Floats:
    """Points (k * sides, 3) of rings (k, 2), each a radius and a height."""
    flat = rings[:, None, :1] * circle[None]
    return np.concatenate([flat, np.broadcast_to(rings[:, None, 1:], (*flat.shape[:2], 1))], axis=2).reshape(-1, 3)


def _bands(profile: Floats, sides: int) -> Ints:
    """Outward triangles between neighbouring rings; none between rings in one place, one a side at a pole."""
    here = np.arange(sides)
    there = (here + 1) % sides
    faces = []
    for k, (low, high) in enumerate(itertools.pairwise(profile)):
        a, b = k * sides, (k + 1) * sides
        if np.array_equal(low[:2], high[:2]):
            continue
        if low[0] > 0:
            faces.append(np.column_stack([a + here, a + there, b + there]))
        if high[0] > 0:
            faces.append(np.column_stack([a + here, b + there, b + here]))
    return np.concatenate(faces)
