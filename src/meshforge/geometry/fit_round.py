"""The smallest cylinder, capsule and circle around points."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np

from meshforge.geometry.arrays import Floats
from meshforge.geometry.convex import convex_hull
from meshforge.geometry.fit_box import descend, memoize_fit
from meshforge.geometry.pose import Pose
from meshforge.geometry.round_shapes import Capsule, Cylinder, Sphere
from meshforge.geometry.shape import Polytope

_STARTS = 24
_DIRECTIONS = 96  # axes to begin with, besides those of the hull's faces and edges

_SLACK = 1e-12  # relative; points this far outside are on the circle


@memoize_fit
def tight_cylinder(points: Floats, *, name: str = "points", thicken: float | None = None) -> Cylinder:
    """The smallest cylinder around points (n, 3), in any orientation; all points are inside to 1e-12 of its size.

    Raises GeometryError as `convex_hull` does.
    """
    corners, everything, middle, size, axes = _prepare(points, name, thicken)
    line = _minimize_volume(lambda lines: _cylinder_volumes(corners, lines), corners, axes, 6)
    frame = _frame_of_axis(line[:3])
    center, _ = smallest_circle((corners @ frame.T)[:, :2])
    local = everything @ frame.T
    radius = float(np.linalg.norm(local[:, :2] - center, axis=1).max())
    low, high = float(local[:, 2].min()), float(local[:, 2].max())
    origin = middle + size * (frame.T @ np.array([*center, (low + high) / 2]))
    return Cylinder(Pose(frame.T, origin), size * radius, size * (high - low) / 2)


@memoize_fit
def tight_capsule(points: Floats, *, name: str = "points", thicken: float | None = None) -> Capsule | Sphere:
    """The smallest capsule around points (n, 3), in any orientation; all points are inside to 1e-12 of its size.

    A sphere where a straight part would not help. Raises GeometryError as `convex_hull` does.
    """
    corners, everything, middle, size, axes = _prepare(points, name, thicken)
    line = _minimize_volume(lambda lines: _measure_capsules(corners, lines)[0], corners, axes, 7)
    _, radii, lows, highs = _measure_capsules(everything, line[None])
    radius, low, high = float(radii[0]), float(lows[0]), float(highs[0])
    frame, along = _frame_of_axis(line[:3]), line[:3] / np.linalg.norm(line[:3])
    origin = middle + size * (line[3:6] - along * (line[3:6] @ along) + along * ((low + high) / 2))
    if high - low <= 1e-9:
        return Sphere(Pose.of_translation(origin), size * (radius + (high - low) / 2))
    return Capsule(Pose(frame.T, origin), size * radius, size * (high - low) / 2)


def _prepare(points: Floats, name: str, thicken: float | None) -> tuple[Floats, Floats, Floats, float, Floats]:
    """Corners of the hull about their middle in units of their size, all points likewise, that middle and size, axes.

    The corners find the shape; all points, some a rounding outside the hull, give it its size.
    """
    hull = convex_hull(points, name=name, thicken=thicken)
    middle = hull.aabb.center
    corners = hull.vertices - middle
    size = float(np.abs(corners).max())
    return corners / size, np.concatenate([points - middle, corners]) / size, middle, size, _candidate_axes(hull)


def _candidate_axes(hull: Polytope) -> Floats:
    """Unit vectors (k, 3): normals of faces, edges, and many evenly over a half sphere."""
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    found = np.concatenate([np.cross(b - a, c - a), b - a])
    found = found[np.argsort(-np.linalg.norm(found, axis=1), kind="stable")][:_DIRECTIONS]
    height = (np.arange(_DIRECTIONS) + 0.5) / _DIRECTIONS
    turn = np.arange(_DIRECTIONS) * np.pi * (3 - np.sqrt(5))
    across = np.sqrt(1 - height**2)
    even = np.column_stack([across * np.cos(turn), across * np.sin(turn), height])
    return np.concatenate([np.eye(3)[::-1], found / np.linalg.norm(found, axis=1, keepdims=True), even])


def _minimize_volume(volumes: Callable[[Floats], Floats], corners: Floats, axes: Floats, count: int) -> Floats:
    """The arguments (count,) of the smallest volume: axis (3), a point on it (3), and what else there is."""
    lines = np.zeros((len(axes), count))
    lines[:, :3], lines[:, 3:6] = axes, _estimate_centers(corners, axes)
    return descend(volumes, lines[np.argsort(volumes(lines), kind="stable")[:_STARTS]], 0.03)


def _estimate_centers(corners: Floats, axes: Floats) -> Floats:
    """Roughly the centre (k, 3) of the smallest circle around the corners seen along each axis (k, 3).

    By Badoiu and Clarkson: steps, ever smaller, towards the farthest corner.
    """
    centers = np.zeros((len(axes), 3))
    for step in range(12):
        _, away = _project_on_lines(corners, axes, centers)
        centers += (corners[np.argmax(away, axis=1)] - centers) / (step + 2)
    return centers


def _project_on_lines(corners: Floats, axes: Floats, centers: Floats) -> tuple[Floats, Floats]:
    """Heights along, and squared distances from, the lines through centers (k, 3) along axes (k, 3), each (k, n)."""
    units = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    heights = units @ corners.T
    across = heights - np.einsum("ij,ij->i", units, centers)[:, None]
    return heights, (np.square(corners[None] - centers[:, None]).sum(axis=2) - across**2).clip(0.0)


def _cylinder_volumes(corners: Floats, lines: Floats) -> Floats:
    """Volumes (k,) of the cylinders about lines (k, 6), but for a factor of pi."""
    heights, squares = _project_on_lines(corners, lines[:, :3], lines[:, 3:6])
    volumes: Floats = squares.max(axis=1) * np.ptp(heights, axis=1)
    return volumes


def _measure_capsules(corners: Floats, lines: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Volumes but for a factor of pi, radii, lower and upper ends of the straight parts, each (k,).

    lines: (k, 7), the last of them by how much the radius is larger than it must be for that line.
    """
    heights, squares = _project_on_lines(corners, lines[:, :3], lines[:, 3:6])
    radii = np.sqrt(squares.max(axis=1)) * (1 + np.abs(lines[:, 6]))
    rise = np.sqrt((radii[:, None] ** 2 - squares).clip(0.0))
    lows, highs = (heights + rise).min(axis=1), (heights - rise).max(axis=1)
    middles = (lows + highs) / 2  # where no straight part is needed, the sphere sits between the two ends
    lows, highs = np.minimum(lows, middles), np.maximum(highs, middles)
    volumes = radii**2 * (highs - lows + 4 / 3 * radii)
    return volumes, radii, lows, highs


def _frame_of_axis(axis: Floats) -> Floats:
    """A rotation (3, 3) whose last row is the axis, turned upwards, and whose first is as near to X as can be."""
    third = axis / np.linalg.norm(axis)
    third = third * (1.0 if third[np.argmax(np.abs(third))] > 0 else -1.0)
    first = np.eye(3)[0] if abs(third[0]) < 0.9 else np.eye(3)[1]
    first = first - third * (first @ third)
    first = first / np.linalg.norm(first)
    return np.stack([first, np.cross(third, first), third])


def smallest_circle(points: Floats) -> tuple[Floats, float]:
    """Centre (2,) and radius of the smallest circle around points (n, 2); all are inside, the radius sees to it.

    The circle of the few points that bear it grows by the farthest point outside, until there is none.
    """
    bearing = points[:1]
    center, radius = points[0], 0.0
    for _ in range(len(points) + 8):
        reach = np.linalg.norm(points - center, axis=1)
        farthest = int(np.argmax(reach))
        if reach[farthest] <= radius * (1 + _SLACK):
            break
        center, radius, bearing = _circle_around_few(np.concatenate([bearing, points[farthest : farthest + 1]]))
    return center, float(np.linalg.norm(points - center, axis=1).max())


def _circle_around_few(points: Floats) -> tuple[Floats, float, Floats]:
    """The smallest circle around at most four points, with those of them that bear it."""
    best: tuple[float, Floats, Floats] | None = None
    for count in (1, 2, 3):
        for chosen in itertools.combinations(range(len(points)), count):
            some = points[list(chosen)]
            center = _circumcentre(some)
            if center is None:
                continue
            radius = float(np.linalg.norm(some - center, axis=1).max())
            inside = bool((np.linalg.norm(points - center, axis=1) <= radius * (1 + _SLACK)).all())
            if inside and (best is None or radius < best[0]):
                best = radius, center, some
    if best is None:  # rounding: nearly collinear points on a circle without end
        center = points.mean(axis=0)
        return center, float(np.linalg.norm(points - center, axis=1).max()), points[:3]
    return best[1], best[0], best[2]


def _circumcentre(points: Floats) -> Floats | None:
    """The centre of the circle through one to three points with as few of them across; None where they are in line."""
    if len(points) < 3:
        return np.asarray(points.mean(axis=0))
    a, b = points[1] - points[0], points[2] - points[0]
    twice = 2 * (a[0] * b[1] - a[1] * b[0])
    if abs(twice) <= 1e-14 * float(a @ a + b @ b):
        return None
    aa, bb = float(a @ a), float(b @ b)
    center: Floats = points[0] + np.array([b[1] * aa - a[1] * bb, a[0] * bb - b[0] * aa]) / twice
    return center
