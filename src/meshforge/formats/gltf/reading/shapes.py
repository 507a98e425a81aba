"""The shapes that physics extensions describe, in the space of their node: Y is their axis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from meshforge.errors import GeometryError
from meshforge.formats.meshfile.gltf import Json
from meshforge.formats.meshfile.gltf.items import number, numbers
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Pose, Shape, Sphere, convex_hull

Z_TO_Y = Pose([[1, 0, 0], [0, 0, 1], [0, -1, 0]], np.zeros(3))
"""Takes the axis of our own shapes, Z, to that of glTF's."""
_RING = 32  # corners of each end of a tapered cylinder


@dataclass(frozen=True, eq=False, slots=True)
class Described:
    """A shape, or None with the reason; taper: a shape that no engine has natively, made into a hull."""

    shape: Shape | None
    reason: str = ""
    taper: bool = False
    is_plane: bool = False


def described(kind: str, own: Json, default: tuple[float, float, float]) -> Described:
    """The shape of a type with its parameters.

    default: radius of cylinders and capsules, height of cylinders, height of capsules, which the specifications set
    apart; a capsule with one `radius` (an older form) tells its whole height. Raises ValueError: no number.
    """
    match kind:
        case "box":
            size = numbers(own, "size", 3, (1.0, 1.0, 1.0))
            return _solid("box", size, lambda: Box(Pose.identity(), size / 2))
        case "sphere":
            radius = number(own, "radius", 0.5)
            return _solid("sphere", np.array([radius]), lambda: Sphere(Pose.identity(), radius))
        case "cylinder" | "capsule":
            return _round(kind, own, default)
        case "plane":
            return Described(None, "a plane has no end", is_plane=True)
    return Described(None, f"a shape of type {kind!r} is not known")


def _round(kind: str, own: Json, default: tuple[float, float, float]) -> Described:
    radius, of_cylinder, of_capsule = default
    if "radius" in own:
        top = bottom = number(own, "radius", radius)
        height = number(own, "height", 2.0) - (2 * top if kind == "capsule" else 0.0)
    else:
        top, bottom = number(own, "radiusTop", radius), number(own, "radiusBottom", radius)
        height = number(own, "height", of_cylinder if kind == "cylinder" else of_capsule)
    sizes = np.array([max(top, bottom), height])
    if kind == "capsule" and abs(height) <= 1e-9 * sizes[0]:
        return _solid("sphere", sizes[:1], lambda: Sphere(Pose.identity(), top))
    if top == bottom:
        make = Cylinder if kind == "cylinder" else Capsule
        return _solid(kind, sizes, lambda: make(Z_TO_Y, top, height / 2))
    if min(top, bottom) < 0:
        return Described(None, f"a {kind} of negative radius")
    ends = [_end(kind, top, height / 2), _end(kind, bottom, -height / 2)]
    found = _solid(kind, sizes, lambda: convex_hull(np.concatenate(ends)))
    return Described(found.shape, found.reason, taper=found.shape is not None)


def _solid(kind: str, sizes: Floats, make: Callable[[], Shape]) -> Described:
    """The shape that `make` makes, unless it has no volume."""
    if sizes.min() <= 0:
        return Described(None, f"a {kind} without volume: {', '.join(f'{s:g}' for s in sizes)} m")
    try:
        return Described(make())
    except GeometryError as error:
        return Described(None, error.problem)


def _end(kind: str, radius: float, height: float) -> Floats:
    """Points (n, 3) of the disk or ball at a height."""
    if radius == 0.0:
        return np.array([[0.0, height, 0.0]])
    if kind == "capsule":
        return Sphere(Pose.of_translation([0.0, height, 0.0]), radius).vertices
    angles = np.arange(_RING) * (2 * np.pi / _RING)
    return np.column_stack([radius * np.cos(angles), np.full(_RING, height), radius * np.sin(angles)])
