"""The smallest cylinder and the smallest capsule around points."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from meshforge.geometry.arrays import Floats
from meshforge.geometry.convex import convex_hull
from meshforge.geometry.fit.circle import smallest_circle
from meshforge.geometry.fit.descend import descend
from meshforge.geometry.fit.remember import remembered
from meshforge.geometry.pose import Pose
from meshforge.geometry.shapes import Capsule, Cylinder, Polytope, Sphere

_STARTS = 24
_DIRECTIONS = 96  # axes to begin with, besides those of the hull's faces and edges


@remembered
def tight_cylinder(points: Floats, *, name: str = "points", thicken: float | None = None) -> Cylinder:
    """The smallest cylinder around points (n, 3), in any orientation; all points are inside to 1e-12 of its size.

    Raises GeometryError as `convex_hull` does.
    """
    corners, everything, middle, size, axes = _prepared(points, name, thicken)
    line = _descended(lambda lines: _cylinder_volumes(corners, lines), corners, axes, 6)
    frame = _frame(line[:3])
    center, _ = smallest_circle((corners @ frame.T)[:, :2])
    local = everything @ frame.T
    radius = float(np.linalg.norm(local[:, :2] - center, axis=1).max())
    low, high = float(local[:, 2].min()), float(local[:, 2].max())
    origin = middle + size * (frame.T @ np.array([*center, (low + high) / 2]))
    return Cylinder(Pose(frame.T, origin), size * radius, size * (high - low) / 2)


@remembered
def tight_capsule(points: Floats, *, name: str = "points", thicken: float | None = None) -> Capsule | Sphere:
    """The smallest capsule around points (n, 3), in any orientation; all points are inside to 1e-12 of its size.

    A sphere where a straight part would not help. Raises GeometryError as `convex_hull` does.
    """
    corners, everything, middle, size, axes = _prepared(points, name, thicken)
    line = _descended(lambda lines: _capsules(corners, lines)[0], corners, axes, 7)
    _, radii, lows, highs = _capsules(everything, line[None])
    radius, low, high = float(radii[0]), float(lows[0]), float(highs[0])
    frame, along = _frame(line[:3]), line[:3] / np.linalg.norm(line[:3])
    foot = line[3:6] - along * (line[3:6] @ along)
    origin = middle + size * (foot + along * ((low + high) / 2))
    if high - low <= 1e-9:
        return Sphere(Pose.of_translation(origin), size * (radius + (high - low) / 2))
    return Capsule(Pose(frame.T, origin), size * radius, size * (high - low) / 2)


def _prepared(points: Floats, name: str, thicken: float | None) -> tuple[Floats, Floats, Floats, float, Floats]:
    """Corners of the hull about their middle in units of their size, all points likewise, that middle and size, axes.

    The corners find the shape; all points, some a rounding outside the hull, give it its size.
    """
    hull = convex_hull(points, name=name, thicken=thicken)
    middle = hull.aabb.center
    corners = hull.vertices - middle
    size = float(np.abs(corners).max())
    everything = np.concatenate([points - middle, corners])
    return corners / size, everything / size, middle, size, _axes(hull)


def _axes(hull: Polytope) -> Floats:
    """Unit vectors (k, 3): normals of faces, edges, and many evenly over a half sphere."""
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    found = np.concatenate([np.cross(b - a, c - a), b - a])
    found = found[np.argsort(-np.linalg.norm(found, axis=1), kind="stable")][:_DIRECTIONS]
    height = (np.arange(_DIRECTIONS) + 0.5) / _DIRECTIONS
    turn = np.arange(_DIRECTIONS) * np.pi * (3 - np.sqrt(5))
    across = np.sqrt(1 - height**2)
    even = np.column_stack([across * np.cos(turn), across * np.sin(turn), height])
    return np.concatenate([np.eye(3)[::-1], found / np.linalg.norm(found, axis=1, keepdims=True), even])


def _descended(volumes: Callable[[Floats], Floats], corners: Floats, axes: Floats, count: int) -> Floats:
    """The arguments (count,) of the smallest volume: axis (3), a point on it (3), and what else there is."""
    lines = np.zeros((len(axes), count))
    lines[:, :3], lines[:, 3:6] = axes, _centers(corners, axes)
    starts = lines[np.argsort(volumes(lines), kind="stable")[:_STARTS]]
    return descend(volumes, starts, 0.03)


def _centers(corners: Floats, axes: Floats) -> Floats:
    """Roughly the centre (k, 3) of the smallest circle around the corners seen along each axis (k, 3).

    By Badoiu and Clarkson: steps, ever smaller, towards the farthest corner.
    """
    centers = np.zeros((len(axes), 3))
    for step in range(12):
        _, away = _seen(corners, axes, centers)
        centers += (corners[np.argmax(away, axis=1)] - centers) / (step + 2)
    return centers


def _seen(corners: Floats, axes: Floats, centers: Floats) -> tuple[Floats, Floats]:
    """Heights along, and squared distances from, the lines through centers (k, 3) along axes (k, 3), each (k, n)."""
    units = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    heights = units @ corners.T
    across = heights - np.einsum("ij,ij->i", units, centers)[:, None]
    squares = np.square(corners[None] - centers[:, None]).sum(axis=2) - across**2
    return heights, squares.clip(0.0)


def _cylinder_volumes(corners: Floats, lines: Floats) -> Floats:
    """Volumes (k,) of the cylinders about lines (k, 6), but for a factor of pi."""
    heights, squares = _seen(corners, lines[:, :3], lines[:, 3:6])
    volumes: Floats = squares.max(axis=1) * np.ptp(heights, axis=1)
    return volumes


def _capsules(corners: Floats, lines: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Volumes but for a factor of pi, radii, lower and upper ends of the straight parts, each (k,).

    lines: (k, 7), the last of them by how much the radius is larger than it must be for that line.
    """
    heights, squares = _seen(corners, lines[:, :3], lines[:, 3:6])
    radii = np.sqrt(squares.max(axis=1)) * (1 + np.abs(lines[:, 6]))
    rise = np.sqrt((radii[:, None] ** 2 - squares).clip(0.0))
    lows, highs = (heights + rise).min(axis=1), (heights - rise).max(axis=1)
    middles = (lows + highs) / 2  # where no straight part is needed, the sphere sits between the two ends
    lows, highs = np.minimum(lows, middles), np.maximum(highs, middles)
    volumes = radii**2 * (highs - lows + 4 / 3 * radii)
    return volumes, radii, lows, highs


def _frame(axis: Floats) -> Floats:
    """A rotation (3, 3) whose last row is the axis, turned upwards, and whose first is as near to X as can be."""
    third = axis / np.linalg.norm(axis)
    third = third * (1.0 if third[np.argmax(np.abs(third))] > 0 else -1.0)
    first = np.eye(3)[0] if abs(third[0]) < 0.9 else np.eye(3)[1]
    first = first - third * (first @ third)
    first = first / np.linalg.norm(first)
    return np.stack([first, np.cross(third, first), third])
