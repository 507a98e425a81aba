"""Shapes that fill an axis-aligned box: the primitives that replace hulls, and templates mapped onto their box."""

from collections.abc import Iterable

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Aabb, Floats, Ints
from meshforge.geometry.pose import Pose
from meshforge.geometry.round_shapes import Capsule, Cylinder, Ellipsoid, Sphere, tessellate_capsule, unit_cylinder
from meshforge.geometry.shape import Box, Polytope, Shape

ROUND = 0.01
"""Sides that agree within this share of the longer one make a native round primitive, by their mean."""
SAME_LENGTH = 1e-9
"""Sides that differ by less than this share are equal: rounding must not choose the axis."""


def longest_axis(bounds: Aabb) -> int:
    """Return the axis (0, 1, 2) of the longest side; of equal ones Z, then Y, then X."""
    longest = float(bounds.size.max())
    return max(axis for axis in range(3) if bounds.size[axis] >= longest * (1 - SAME_LENGTH))


def aabb_box(bounds: Aabb) -> Box:
    """Return the box that is `bounds`. Raises GeometryError where a side has no extent; so do the other shapes here."""
    check_extent(bounds)
    return Box.of_bounds(bounds)


def aabb_cylinder(bounds: Aabb, axis: int | None = None) -> Cylinder | Polytope:
    """Return the cylinder along an axis, or the longest, that fills `bounds`: native if round, else of 64 vertices."""
    axis = choose_axis(bounds, axis)
    across = np.delete(bounds.size, axis)
    if _are_equal(across):
        return Cylinder(pose_along(axis, bounds), float(across.mean()) / 2, float(bounds.size[axis]) / 2)
    return _stretch(*unit_cylinder(), axis, bounds)


def aabb_capsule(bounds: Aabb, axis: int | None = None) -> Capsule | Sphere | Ellipsoid | Polytope:
    """Return the capsule along an axis, or the longest, that fills `bounds`: native if round, else of 50 vertices.

    One without a straight part is a sphere or an ellipsoid. The ends of a polytope rise by the mean of its half widths.
    """
    axis = choose_axis(bounds, axis)
    across, length = np.delete(bounds.size, axis), float(bounds.size[axis])
    radius = float(across.mean()) / 2
    straight = length / 2 - radius
    if straight <= SAME_LENGTH * length:
        return aabb_sphere(bounds)
    if not _are_equal(across):
        points, faces = tessellate_capsule(1.0, straight / radius)
        return _stretch(points / [1.0, 1.0, 1.0 + straight / radius], faces, axis, bounds)
    return Capsule(pose_along(axis, bounds), radius, straight)


def aabb_sphere(bounds: Aabb) -> Sphere | Ellipsoid:
    """Return the ellipsoid that fills `bounds`; a sphere where it is round."""
    check_extent(bounds)
    if _are_equal(bounds.size):
        return Sphere(Pose.of_translation(bounds.center), float(bounds.size.mean()) / 2)
    return Ellipsoid(Pose.of_translation(bounds.center), bounds.size / 2)


def shape_of_radius(
    primitive: str, radius: float, bounds: Aabb, axis: int | None = None
) -> Capsule | Cylinder | Sphere:
    """Return the cylinder, capsule or sphere of a radius [m] about the centre of `bounds`, as long along an axis.

    A capsule that is no longer than it is wide is a sphere.
    """
    axis = choose_axis(bounds, axis)
    half = float(bounds.size[axis]) / 2
    if primitive == "cylinder":
        return Cylinder(pose_along(axis, bounds), radius, half)
    if primitive == "sphere" or half - radius <= SAME_LENGTH * half:
        return Sphere(Pose.of_translation(bounds.center), radius)
    return Capsule(pose_along(axis, bounds), radius, half - radius)


def map_to_box(shapes: Iterable[Shape], source: Aabb, target: Aabb) -> tuple[Shape, ...]:
    """Return the images of shapes under the map that takes the box `source` onto `target`, axis by axis, never turned.

    A side of `source` without extent is moved only. Raises GeometryError where a side of `target` has no extent.
    """
    check_extent(target)
    flat = source.size <= 0
    factors = np.where(flat, 1.0, target.size / np.where(flat, 1.0, source.size))
    offset = target.center - source.center * factors
    return tuple(shape.transform(np.diag(factors), offset) for shape in shapes)


def check_extent(bounds: Aabb) -> int:
    """Return the axis of the longest side. Raises GeometryError where a side has no extent."""
    if not (bounds.size > 0).all():
        sides = " x ".join(f"{side:.3g}" for side in bounds.size)
        raise GeometryError(f"a bounding box of {sides} m cannot be filled", remedy="Give it a thickness first.")
    return longest_axis(bounds)


def choose_axis(bounds: Aabb, axis: int | None) -> int:
    """Return the axis itself, that of the longest side for None. Raises GeometryError as `check_extent` does."""
    longest = check_extent(bounds)
    return longest if axis is None else axis


def _are_equal(sides: Floats) -> bool:
    return bool(np.ptp(sides) <= ROUND * sides.max())


def pose_along(axis: int, bounds: Aabb) -> Pose:
    """Return the pose at the middle of `bounds` whose Z axis is the coordinate axis; the others follow in order."""
    return Pose(np.roll(np.eye(3), axis - 2, axis=0), bounds.center)


def _stretch(unit: Floats, faces: Ints, axis: int, bounds: Aabb) -> Polytope:
    """A unit tessellation about Z, its axis turned to `axis`, that reaches the sides of `bounds` exactly."""
    turned = np.roll(unit, axis - 2, axis=1)
    points = bounds.center + turned * (bounds.size / 2)
    points = np.where(turned >= 1.0, bounds.max, np.where(turned <= -1.0, bounds.min, points))
    return Polytope(points, faces)
