"""Unreal's primitives, which files hold as meshes: what they are where the mesh really is one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from meshforge.formats.naming.marks import unreal_kind
from meshforge.geometry import Box, Capsule, Pose, Shape, Sphere, tight_box, tight_capsule

_NEAR = 0.01  # share of its size by which a mesh may differ from the primitive
_EXACT = 1e-5  # the same for a ball, so that a short capsule is none
_ROUND = 0.5  # share of a ball or capsule that its inscribed mesh fills at least; a cube in a ball fills 0.37


def unreal_shape(name: str, hull: Shape) -> tuple[Shape, str | None]:
    """The primitive that the prefix of a name makes of a hull; where it is another shape, the hull and a note."""
    kind = unreal_kind(name)
    made = _MAKERS[kind](hull) if kind in _MAKERS else hull
    return (hull, f"{name!r} is no {_WORDS[kind]}: it is read as a hull") if made is None else (made, None)


def _box(hull: Shape) -> Box | None:
    box = tight_box(hull.vertices)
    return box if hull.volume >= (1 - _NEAR) * box.volume else None


def _sphere(hull: Shape, near: float = _NEAR) -> Sphere | None:
    points = hull.vertices
    # the centre to which all vertices are equally far, by least squares
    centre = np.linalg.lstsq(
        2 * (points[1:] - points[0]), (points[1:] ** 2).sum(1) - (points[0] ** 2).sum(), rcond=None
    )
    distances = np.linalg.norm(points - centre[0], axis=1)
    sphere = Sphere(Pose.of_translation(centre[0]), float(distances.mean()))
    round_ = np.ptp(distances) <= near * sphere.radius and hull.volume >= _ROUND * sphere.volume
    return sphere if round_ else None


def _capsule(hull: Shape) -> Capsule | None:
    capsule = tight_capsule(hull.vertices)
    if not isinstance(capsule, Capsule):
        return None
    local = capsule.pose.inverse().apply(np.asarray(hull.vertices))
    local[:, 2] -= np.clip(local[:, 2], -capsule.half_length, capsule.half_length)
    depth = capsule.radius - np.linalg.norm(local, axis=1)
    round_ = depth.max() <= _NEAR * capsule.radius and hull.volume >= _ROUND * capsule.volume
    return capsule if round_ else None


_MAKERS: dict[str | None, Callable[[Shape], Shape | None]] = {
    "UBX": _box,
    "USP": _sphere,
    "UCP": lambda hull: _sphere(hull, _EXACT) or _capsule(hull) or _sphere(hull),
}
_WORDS: dict[str | None, str] = {"UBX": "box", "USP": "sphere", "UCP": "capsule"}
