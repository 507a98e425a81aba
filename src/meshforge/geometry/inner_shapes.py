"""Shapes inside a convex hull: the largest box, cylinder, capsule and sphere, the hull with planes moved inwards."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats
from meshforge.geometry.convex import convex_hull, principal_extents
from meshforge.geometry.fill import SAME_LENGTH
from meshforge.geometry.fit import frame_of_axis, tight_box, tight_capsule, tight_cylinder
from meshforge.geometry.pose import Pose
from meshforge.geometry.round_shapes import Capsule, Cylinder, Ellipsoid, Sphere
from meshforge.geometry.shape import Box, Polytope, PrimitiveShape, Shape
from meshforge.geometry.surface import planes_of

_GAP = 1e-9  # of the logarithm of the volume, to the largest one
_SAME_VOLUME = 1e-6  # what is larger by no more than this share is no reason for another direction
_PLANE_DIGITS = 9  # planes that agree to so many, where the hull is of size 1, are one


def inscribe(primitive: str, hull: Polytope, axis: int | None = None) -> PrimitiveShape:
    """Return the largest box, cylinder, capsule or sphere inside a hull.

    axis: along which a cylinder or a capsule lies. None tries X, Y and Z, the principal axes of the vertices, and the
    direction of the smallest primitive around them, as a box always does; the first of these whose volume is largest.
    """
    planes = _InnerPlanes(hull)
    found = [_inscribe(primitive, planes, frame) for frame in _list_frames(primitive, hull, axis)]
    most = max(shape.volume for shape in found)
    return next(shape for shape in found if shape.volume >= most * (1 - _SAME_VOLUME))


def shrink(shape: Shape, distance: float, name: str) -> Shape:
    """Return a shape with its surface moved inwards by a distance [m]: planes, radii, semi-axes of an ellipsoid.

    Raises GeometryError naming the hull where nothing is left.
    """
    sizes: dict[str, Any] = {}
    match shape:
        case Box():
            sizes = {"half": shape.half}
        case Sphere() | Capsule():
            sizes = {"radius": shape.radius}
        case Cylinder():
            sizes = {"radius": shape.radius, "half_length": shape.half_length}
        case Ellipsoid():
            sizes = {"radii": shape.radii}
    planes = None if sizes else _InnerPlanes(shape.tessellate())
    least = planes.inscribe_ball()[1] if planes else min(np.min(size) for size in sizes.values())
    if distance >= least * (1 - SAME_LENGTH):
        problem = f"hull {name!r} vanishes when its surface moves inwards by {distance:g} m: {least:.3g} m is the most"
        raise GeometryError(problem, remedy="Give a smaller distance, or leave this hull out of the selection.")
    if planes:
        return planes.move_inwards(distance, name)
    primitive: Any = shape
    made: Shape = replace(primitive, **{key: size - distance for key, size in sizes.items()})
    return made


class _InnerPlanes:
    """The planes of a hull, each once, where the hull is of size 1 about the middle of its vertices."""

    def __init__(self, hull: Polytope) -> None:
        planes = planes_of(hull.vertices, hull.faces)
        self.middle, self.size = planes.middle, float(np.ptp(hull.vertices, axis=0).max())
        rows = np.column_stack([planes.normals, planes.offsets / self.size])
        if len(planes.normals) < len(hull.faces):  # without needles they may enclose nothing: those of its box do
            ends = (hull.vertices - self.middle) / self.size
            box = np.column_stack([[*np.eye(3), *-np.eye(3)], [*ends.max(axis=0), *-ends.min(axis=0)]])
            rows = np.concatenate([rows, box])
        _, first = np.unique(np.round(rows, _PLANE_DIGITS), axis=0, return_index=True)
        self.normals, self.offsets = rows[first, :3], rows[first, 3]

    def place(self, center: Floats, frame: Floats) -> Pose:
        """The pose at a centre (3,) in these coordinates whose axes are the rows of a frame (3, 3)."""
        return Pose(frame.T, self.middle + self.size * center)

    def maximize(self, reaches: Floats, terms: Floats) -> tuple[Floats, Floats]:
        """The centre (3,) and sizes (k,) [m] of the largest shape inside, by an interior-point method (Boyd and
        Vandenberghe, Convex Optimization, 11.3).

        reaches: (m, k), how far each size reaches towards each plane; terms: (j, k), the logarithm of the volume is the
        sum of those of terms @ sizes.
        """
        count = reaches.shape[1]
        signs = np.column_stack([np.zeros((count, 3)), -np.eye(count)])  # no size is negative
        rows = np.concatenate([np.column_stack([self.normals, reaches]), signs])
        limits = np.concatenate([self.offsets, np.zeros(count)])
        logs = np.column_stack([np.zeros((len(terms), 3)), terms])
        x = np.concatenate([np.zeros(3), np.full(count, float(self.offsets.min()) / (2 * reaches.sum(axis=1).max()))])
        weight = 1.0

        def value(x: Floats) -> float:
            inner, outer = logs @ x, limits - rows @ x
            if min(inner.min(), outer.min()) <= 0:
                return np.inf
            return float(-weight * np.log(inner).sum() - np.log(outer).sum())

        while weight < len(rows) / _GAP:
            for _ in range(50):
                up, down = logs / (logs @ x)[:, None], rows / (limits - rows @ x)[:, None]
                slope = down.sum(axis=0) - weight * up.sum(axis=0)
                step = np.linalg.lstsq(down.T @ down + weight * (up.T @ up), -slope)[0]  # of many largest ones, any
                gain, part, now = float(-slope @ step), 1.0, value(x)
                if gain < 1e-10:
                    break
                while part > 1e-10 and value(x + part * step) > now - part * gain / 4:
                    part /= 2
                x = x + part * step if part > 1e-10 else x
            weight *= 10
        return x[:3], self.size * x[3:]

    def inscribe_ball(self) -> tuple[Floats, float]:
        """The centre (3,) and radius [m] of the largest ball inside."""
        center, (radius,) = self.maximize(np.ones((len(self.normals), 1)), np.ones((1, 1)))
        return center, float(radius)

    def move_inwards(self, distance: float, name: str) -> Polytope:
        """What the planes enclose, each moved inwards by a distance [m] that leaves something."""
        from scipy.spatial import HalfspaceIntersection  # lazy: slow to import

        rows = np.column_stack([self.normals, distance / self.size - self.offsets])
        corners = HalfspaceIntersection(rows, self.inscribe_ball()[0]).intersections
        return convex_hull(self.middle + self.size * corners, name=name)


def _list_frames(primitive: str, hull: Polytope, axis: int | None) -> Iterable[Floats]:
    """The frames (3, 3) that are tried: along the last row of each lies a cylinder or a capsule."""
    if primitive == "sphere":
        return [np.eye(3)]
    if axis is not None:
        return [frame_of_axis(np.eye(3)[axis])]
    _, principal, _ = principal_extents(hull.vertices)
    if primitive == "box":
        return [np.eye(3), principal, tight_box(hull.vertices).pose.rotation.T]
    around = (tight_cylinder if primitive == "cylinder" else tight_capsule)(hull.vertices)
    return [frame_of_axis(row) for row in (*np.eye(3)[::-1], *principal, around.pose.rotation[:, 2])]


def _inscribe(primitive: str, planes: _InnerPlanes, frame: Floats) -> PrimitiveShape:
    """The largest primitive in planes, along the rows of a frame (3, 3), a cylinder or a capsule along the last."""
    along = np.abs(planes.normals @ frame[2])
    match primitive:
        case "box":
            center, half = planes.maximize(np.abs(planes.normals @ frame.T), np.eye(3))
            return Box(planes.place(center, frame), half)
        case "cylinder":
            across = np.sqrt((1 - along**2).clip(0.0))
            reaches, terms = np.column_stack([across, along]), np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
        case "capsule":
            reaches = np.column_stack([np.ones(len(along)), along])
            terms = np.array([[1.0, 0.0], [1.0, 0.0], [4 / 3, 2.0]])
        case _:
            center, radius = planes.inscribe_ball()
            return Sphere(planes.place(center, frame), radius)
    center, sizes = planes.maximize(reaches, terms)
    place, radius, half_length = planes.place(center, frame), float(sizes[0]), float(sizes[1])
    if primitive == "cylinder":
        return Cylinder(place, radius, half_length)
    return Capsule(place, radius, half_length) if half_length > 1e-6 * radius else Sphere(place, radius)
