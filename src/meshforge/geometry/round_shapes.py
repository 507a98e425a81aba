"""The round primitives: sphere, ellipsoid, cylinder, capsule, and the tessellations that stand in for them."""

from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar

import numpy as np

from meshforge.geometry.arrays import Aabb, Floats, Ints, freeze_floats, freeze_ints
from meshforge.geometry.pose import Pose
from meshforge.geometry.shape import Box, Polytope, PrimitiveShape, Shape, split_scaled_rotation

_RING_POINTS = 8  # a multiple of four, so that a ring reaches +-X and +-Y
_CYLINDER_SIDES = 32


@dataclass(frozen=True, eq=False, slots=True)
class Sphere(PrimitiveShape):
    """A sphere about the origin of `pose`, whose rotation is kept only to be written back; radius [m]."""

    kind: ClassVar[str] = "sphere"
    radius: float

    @property
    def aabb(self) -> Aabb:
        return Aabb(self.pose.translation - self.radius, self.pose.translation + self.radius)

    @property
    def volume(self) -> float:
        return 4.0 / 3.0 * np.pi * self.radius**3

    def support(self, direction: Floats) -> Floats:
        return self.pose.translation + direction * (self.radius / float(np.linalg.norm(direction)))

    def tessellate(self) -> Polytope:
        points, faces = unit_sphere()
        return Polytope(self.pose.apply(points * self.radius), faces)

    def scale(self, pose: Pose, scales: Floats) -> Shape | None:
        return Sphere(pose, self.radius * float(scales.mean())) if _are_equal(scales, scales) else None


@dataclass(frozen=True, eq=False, slots=True)
class Ellipsoid(PrimitiveShape):
    """An ellipsoid about the origin of `pose`; radii: (3,) semi-axes along the axes of `pose` [m]."""

    kind: ClassVar[str] = "ellipsoid"
    radii: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "radii", freeze_floats(self.radii, (3,)))

    @property
    def aabb(self) -> Aabb:
        reach = np.linalg.norm(self.pose.rotation * self.radii, axis=1)
        return Aabb(self.pose.translation - reach, self.pose.translation + reach)

    @property
    def volume(self) -> float:
        return float(4.0 / 3.0 * np.pi * np.prod(self.radii))

    def support(self, direction: Floats) -> Floats:
        pull = self.radii * (self.pose.rotation.T @ direction)
        return self.pose.rotation @ (self.radii * pull / np.linalg.norm(pull)) + self.pose.translation

    def tessellate(self) -> Polytope:
        points, faces = unit_sphere()
        return Polytope(self.pose.apply(points * self.radii), faces)

    def scale(self, pose: Pose, scales: Floats) -> Shape:
        return Ellipsoid(pose, self.radii * scales)

    def transform(self, linear: Floats, offset: Floats) -> Shape:
        if split_scaled_rotation(linear @ self.pose.rotation):
            return PrimitiveShape.transform(self, linear, offset)
        rotation, radii, _ = np.linalg.svd(linear @ self.pose.rotation * self.radii)
        if np.linalg.det(rotation) < 0:
            rotation = rotation * np.array([1.0, 1.0, -1.0])
        return Ellipsoid(Pose(rotation, linear @ self.pose.translation + offset), radii)


@dataclass(frozen=True, eq=False, slots=True)
class Cylinder(PrimitiveShape):
    """A cylinder about the Z axis of `pose`, centred; radius, half_length [m]."""

    kind: ClassVar[str] = "cylinder"
    radius: float
    half_length: float

    @property
    def aabb(self) -> Aabb:
        axis = self.pose.rotation[:, 2]
        reach = self.half_length * np.abs(axis) + self.radius * np.sqrt(np.clip(1.0 - axis**2, 0.0, 1.0))
        return Aabb(self.pose.translation - reach, self.pose.translation + reach)

    @property
    def volume(self) -> float:
        return 2.0 * np.pi * self.radius**2 * self.half_length

    def support(self, direction: Floats) -> Floats:
        x, y, z = self.pose.rotation.T @ direction
        flat = float(np.hypot(x, y))
        scale = self.radius / flat if flat > 0 else 0.0
        local = np.array([x * scale, y * scale, self.half_length if z >= 0 else -self.half_length])
        point: Floats = self.pose.rotation @ local + self.pose.translation
        return point

    def tessellate(self) -> Polytope:
        points, faces = unit_cylinder()
        return Polytope(self.pose.apply(points * [self.radius, self.radius, self.half_length]), faces)

    def scale(self, pose: Pose, scales: Floats) -> Shape | None:
        made = Cylinder(pose, self.radius * float(scales[:2].mean()), self.half_length * float(scales[2]))
        return made if _are_equal(scales[:2], scales) else None


@dataclass(frozen=True, eq=False, slots=True)
class Capsule(PrimitiveShape):
    """A capsule about the Z axis of `pose`, centred; radius and half_length of its straight part [m]."""

    kind: ClassVar[str] = "capsule"
    radius: float
    half_length: float

    @property
    def aabb(self) -> Aabb:
        reach = self.half_length * np.abs(self.pose.rotation[:, 2]) + self.radius
        return Aabb(self.pose.translation - reach, self.pose.translation + reach)

    @property
    def volume(self) -> float:
        return np.pi * self.radius**2 * (2.0 * self.half_length + 4.0 / 3.0 * self.radius)

    def support(self, direction: Floats) -> Floats:
        axis = self.pose.rotation[:, 2]
        end = self.pose.translation + axis * (self.half_length if axis @ direction >= 0 else -self.half_length)
        return end + direction * (self.radius / float(np.linalg.norm(direction)))

    def tessellate(self) -> Polytope:
        points, faces = tessellate_capsule(self.radius, self.half_length)
        return Polytope(self.pose.apply(points), faces)

    def scale(self, pose: Pose, scales: Floats) -> Shape | None:
        mean = float(scales.mean())
        return Capsule(pose, self.radius * mean, self.half_length * mean) if _are_equal(scales, scales) else None


def place_primitive(library: Any, shape: Shape, origin: Floats, unit: float) -> tuple[Any, Any, Floats]:
    """Return a primitive as one of a library for distances, its rotation (3, 3) and place (3,), in coordinates
    x -> (x - origin) / unit; coal and FCL call them alike."""
    match shape:
        case Box():
            made = library.Box(*(2 * shape.half / unit))
        case Sphere():
            made = library.Sphere(shape.radius / unit)
        case Cylinder():
            made = library.Cylinder(shape.radius / unit, 2 * shape.half_length / unit)
        case Capsule():
            made = library.Capsule(shape.radius / unit, 2 * shape.half_length / unit)
        case Ellipsoid():
            made = library.Ellipsoid(*(shape.radii / unit))
        case _:
            raise TypeError(f"no distance for shapes of kind {shape.kind}")
    return made, shape.pose.rotation, (shape.pose.translation - origin) / unit


def _are_equal(some: Floats, scales: Floats) -> bool:
    return bool(np.ptp(some) <= 1e-9 * scales.max())


def _ring(radius: float, z: float, count: int) -> Floats:
    turn = np.arange(count) * (2 * np.pi / count)
    x, y = np.cos(turn), np.sin(turn)
    x[np.abs(x) < 1e-15], y[np.abs(y) < 1e-15] = 0.0, 0.0
    return np.column_stack([radius * x, radius * y, np.full(count, z)])


def _loft(rings: list[Floats]) -> tuple[Floats, Ints]:
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
    return freeze_floats(np.concatenate(rings), (-1, 3)), freeze_ints(faces, (-1, 3))


def _dome(steps: int) -> list[tuple[float, float]]:
    """Radius and height of the rings of a unit half sphere, equator first, pole left out."""
    return [(float(np.cos(a)), float(np.sin(a))) for a in np.arange(steps) * (np.pi / 2 / steps)]


@cache
def unit_sphere() -> tuple[Floats, Ints]:
    """Return vertices (58, 3) and outward triangles of the sphere of radius 1 about the origin."""
    dome = _dome(4)
    below = [_ring(r, -z, _RING_POINTS) for r, z in reversed(dome[1:])]
    above = [_ring(r, z, _RING_POINTS) for r, z in dome]
    return _loft([np.array([[0.0, 0.0, -1.0]]), *below, *above, np.array([[0.0, 0.0, 1.0]])])


@cache
def unit_cylinder() -> tuple[Floats, Ints]:
    """Return vertices (64, 3) and outward triangles of the cylinder of radius 1 from z = -1 to z = 1."""
    vertices = np.concatenate([_ring(1.0, -1.0, _CYLINDER_SIDES), _ring(1.0, 1.0, _CYLINDER_SIDES)])
    sides = _CYLINDER_SIDES
    around = [(k, (k + 1) % sides) for k in range(sides)]
    side = [t for k, n in around for t in ([k, n, sides + n], [k, sides + n, sides + k])]
    caps = [t for k in range(1, sides - 1) for t in ([0, k + 1, k], [sides, sides + k, sides + k + 1])]
    return freeze_floats(vertices, (-1, 3)), freeze_ints(side + caps, (-1, 3))


def tessellate_capsule(radius: float, half_length: float) -> tuple[Floats, Ints]:
    """Return vertices (50, 3) and outward triangles of the capsule about local Z; half_length: straight part [m]."""
    dome = [(radius * r, radius * z + half_length) for r, z in _dome(3)]
    top = radius + half_length
    below = [_ring(r, -z, _RING_POINTS) for r, z in reversed(dome)]
    above = [_ring(r, z, _RING_POINTS) for r, z in dome]
    return _loft([np.array([[0.0, 0.0, -top]]), *below, *above, np.array([[0.0, 0.0, top]])])
