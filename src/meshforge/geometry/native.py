"""The native cylinder, capsule and sphere of the least radius around shapes, not tessellated; the smallest ball."""

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from meshforge.geometry.arrays import Aabb, Bools, Floats
from meshforge.geometry.fill import SAME_LENGTH, check_extent, choose_axis, pose_along
from meshforge.geometry.pose import Pose
from meshforge.geometry.round_shapes import Capsule, Cylinder, Ellipsoid, Sphere
from meshforge.geometry.shape import Shape

_RIM_CORNERS = 1024  # of the polygon around a rim that lies askew; 5e-6 of its radius larger
_MERIDIANS = 192  # of the polyhedron around an ellipsoid; 3e-4 of its radii larger
_SAME_VOLUME = 1e-6  # what encloses less by no more than this share is no reason for another axis
_PARALLEL = 1e-9  # [rad] between axes that are one
_ROUNDING = 1e-13  # relative, of squares: what is this near the wall touches it


def native_cylinder(shapes: Iterable[Shape], bounds: Aabb, axis: int | None = None) -> Cylinder:
    """Return the cylinder along an axis, as long as that side of `bounds`, of the least radius around the shapes.

    bounds: the box around all; axis: by default of its longest side. These raise GeometryError: a side has no extent.
    """
    axis = choose_axis(bounds, axis)
    pose, parts = _split_shapes(shapes, bounds, axis)
    center, radius = _fit_line(parts, bounds, axis)
    return Cylinder(pose @ Pose.of_translation([*center, 0.0]), radius, float(bounds.size[axis]) / 2)


def find_cylinder_axis(shapes: Sequence[Shape], bounds: Aabb) -> int:
    """Return the axis (0, 1, 2) along which the native cylinder around shapes has the least volume: a disc is a disc.

    Of equal ones that along the longest side of `bounds`, then Z, then Y, then X.
    """
    volumes = [native_cylinder(shapes, bounds, axis).volume for axis in range(3)]
    least = [axis for axis in range(3) if volumes[axis] <= min(volumes) * (1 + _SAME_VOLUME)]
    longest = check_extent(bounds)
    return longest if longest in least else least[-1]


def native_capsule(shapes: Iterable[Shape], bounds: Aabb, axis: int | None = None) -> Capsule | Sphere:
    """Return the capsule along an axis, the default as above, around shapes: of the least radius, then shortest.

    A sphere where no straight part is needed.
    """
    axis = choose_axis(bounds, axis)
    pose, parts = _split_shapes(shapes, bounds, axis)
    center, radius = _fit_line(parts, bounds, axis)
    low, high = parts.measure_straight_part(center, radius)
    place = pose @ Pose.of_translation([*center, (low + high) / 2])
    if high - low <= SAME_LENGTH * float(bounds.size.max()):
        return Sphere(Pose.of_translation(place.translation), radius + max(high - low, 0.0) / 2)
    return Capsule(place, radius, (high - low) / 2)


def native_sphere(shapes: Iterable[Shape], bounds: Aabb) -> Sphere:
    """Return the smallest sphere around the shapes; bounds: the box around them all."""
    pose, parts = _split_shapes(shapes, bounds, check_extent(bounds), discs=False)
    center, radius = smallest_ball(parts.centers, parts.radii)
    return Sphere(Pose.of_translation(pose.apply(center[None])[0]), radius)


@dataclass(frozen=True, eq=False, slots=True)
class _Parts:
    """Points, balls, and discs across Z, whose convex hull is that of some shapes; in a frame of their own.

    centers: (n, 3) [m]; radii: (n,) [m], 0 for points; flat: (n,), whether it is a disc.
    """

    centers: Floats
    radii: Floats
    flat: Bools

    def measure_straight_part(self, center: Floats, radius: float) -> tuple[float, float]:
        """The lower and the upper end of the axis of the shortest capsule about a line along Z.

        center: (2,), where the line is; the lower end is the higher one where a sphere is enough.
        """
        away = np.linalg.norm(self.centers[:, :2] - center, axis=1)
        free = radius - np.where(self.flat, 0.0, self.radii)
        squares = free**2 - (away + np.where(self.flat, self.radii, 0.0)) ** 2
        rise = np.sqrt(np.where(squares > _ROUNDING * radius**2, squares, 0.0))
        heights = self.centers[:, 2]
        return float((heights + rise).min()), float((heights - rise).max())


def _split_shapes(shapes: Iterable[Shape], bounds: Aabb, axis: int, *, discs: bool = True) -> tuple[Pose, _Parts]:
    """The pose at the middle of `bounds` with Z along an axis, and the parts of the shapes in that frame.

    discs: whether cylinders along Z become discs, else points, as others do.
    """
    pose = pose_along(axis, bounds)
    back = pose.inverse()
    each = [_split_shape(shape.move(back), discs) for shape in shapes]
    radii = np.concatenate([np.full(len(points), radius) for points, radius, _ in each])
    flat = np.concatenate([np.full(len(points), is_flat) for points, _, is_flat in each])
    return pose, _Parts(np.concatenate([points for points, _, _ in each]), radii, flat)


def _split_shape(shape: Shape, discs: bool) -> tuple[Floats, float, bool]:
    """Centres (n, 3) of the parts of a shape, their radius, and whether they are discs across Z."""
    match shape:
        case Sphere():
            return shape.pose.translation[None], shape.radius, False
        case Capsule():
            return _ends(shape), shape.radius, False
        case Cylinder() if discs and float(np.linalg.norm(shape.pose.rotation[:2, 2])) <= _PARALLEL:
            return _ends(shape), shape.radius, True
        case Cylinder():
            return shape.pose.apply(_around_cylinder() * [shape.radius, shape.radius, shape.half_length]), 0.0, False
        case Ellipsoid():
            return shape.pose.apply(_around_sphere() * shape.radii), 0.0, False
        case _:
            return shape.vertices, 0.0, False


def _ends(shape: Capsule | Cylinder) -> Floats:
    return shape.pose.apply(np.array([[0.0, 0.0, -shape.half_length], [0.0, 0.0, shape.half_length]]))


@cache
def _around_cylinder() -> Floats:
    """The corners (n, 3) of a prism around the cylinder of radius 1 from z = -1 to z = 1."""
    turn = np.arange(_RIM_CORNERS) * (2 * np.pi / _RIM_CORNERS)
    rim = np.column_stack([np.cos(turn), np.sin(turn)]) / np.cos(np.pi / _RIM_CORNERS)
    return np.concatenate([np.column_stack([rim, np.full(len(rim), z)]) for z in (-1.0, 1.0)])


@cache
def _around_sphere() -> Floats:
    """The corners (n, 3) of a polyhedron around the sphere of radius 1."""
    step = 2 * np.pi / _MERIDIANS
    turn, height = np.arange(_MERIDIANS) * step, np.arange(_MERIDIANS // 2 + 1) * step - np.pi / 2
    across, along = np.cos(height), np.sin(height)
    corners = np.stack([np.outer(across, np.cos(turn)), np.outer(across, np.sin(turn)),
                        np.repeat(along[:, None], _MERIDIANS, axis=1)], axis=2)  # fmt: skip
    middle = across * np.cos(step / 2)  # of the edge between two corners of one height
    areas = np.abs(middle[:-1] * along[1:] - middle[1:] * along[:-1])
    nearest_face = (areas / np.hypot(np.diff(middle), np.diff(along))).min()
    points: Floats = corners.reshape(-1, 3) / nearest_face
    return points


def _fit_line(parts: _Parts, bounds: Aabb, axis: int) -> tuple[Floats, float]:
    """Where (2,) the line along Z is that has the parts nearest, and how far they reach from it.

    At least half the width of `bounds`: one without a width of its own was given one.
    """
    center, radius = smallest_ball(parts.centers[:, :2], parts.radii)
    return center, max(radius, float(np.delete(bounds.size, axis).max()) / 2)


_SLACK = 1e-12  # relative; what reaches this far out is on the surface
_EXTRA_ROUNDS = 200  # besides one a point: around balls the search comes ever nearer, without an end


def smallest_ball(centers: Floats, radii: Floats | None = None) -> tuple[Floats, float]:
    """Return centre (d,) and radius of the smallest ball around balls of centres (n, d); d is 2 or 3.

    radii: (n,), 0 where None: the centres are points then. All are inside, the radius sees to it. The ball around the
    few points that bear it grows by the farthest point outside, until there is none.
    """
    own = np.zeros(len(centers)) if radii is None else radii
    largest = int(np.argmax(own))
    bearing, center, radius = centers[[largest]], centers[largest], float(own[largest])
    for _ in range(len(centers) + _EXTRA_ROUNDS):
        reach = np.linalg.norm(centers - center, axis=1) + own
        farthest = int(np.argmax(reach))
        if reach[farthest] <= radius * (1 + _SLACK):
            break
        away = centers[farthest] - center
        length = float(np.linalg.norm(away))
        unit = away / length if length > 0 else np.eye(len(center))[0]
        point = centers[farthest] + own[farthest] * unit
        center, radius, bearing = _ball_around_few(np.concatenate([bearing, point[None]]))
    return center, float((np.linalg.norm(centers - center, axis=1) + own).max())


def _ball_around_few(points: Floats) -> tuple[Floats, float, Floats]:
    """The smallest ball around at most d + 2 points (n, d), with those of them that bear it."""
    best: tuple[Floats, float, Floats] | None = None
    for count in range(1, points.shape[1] + 2):
        for chosen in itertools.combinations(range(len(points)), count):
            some = points[list(chosen)]
            center = _circumcentre(some)
            if center is None:
                continue
            radius = float(np.linalg.norm(some - center, axis=1).max())
            inside = bool((np.linalg.norm(points - center, axis=1) <= radius * (1 + _SLACK)).all())
            if inside and (best is None or radius < best[1]):
                best = center, radius, some
    if best:
        return best
    center = points.mean(axis=0)  # rounding: nearly collinear points on a ball without end
    return center, float(np.linalg.norm(points - center, axis=1).max()), points[: points.shape[1] + 1]


def _circumcentre(points: Floats) -> Floats | None:
    """The centre of the ball through points with as few of them across; None where they are in line or in a plane."""
    if len(points) < 3:
        return np.asarray(points.mean(axis=0))
    sides = points[1:] - points[0]
    offset, _, rank, _ = np.linalg.lstsq(sides, np.square(sides).sum(axis=1) / 2, rcond=1e-14)
    if rank < len(sides):
        return None
    center: Floats = points[0] + offset
    return center
