"""The masses of rigid bodies as the mass schema tells them, in the root frame."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from meshforge.asset import Inertial
from meshforge.formats.usd.reading.stage import Scene
from meshforge.geometry import Floats, Shape, inertia


def inertial_of(scene: Scene, prim: Any, body: str, hulls: Sequence[Shape]) -> Inertial | None:
    """What a body weighs by what it says itself; hulls: of the body, whose inertia it has where it says none.

    None where it leaves its mass to the density of its colliders, or where nothing tells its inertia.
    """
    mass = told(scene, prim, "physics:mass")
    if mass is None or mass <= 0:
        return None
    mass *= scene.kilograms
    centre, moments = centre_of(scene, prim), moments_of(scene, prim)
    if moments is None:
        return Inertial(body, mass, *inertia(hulls, mass, centre)) if hulls else None
    if centre is None:
        centre = inertia(hulls, mass)[0] if hulls else scene.pose(prim).translation
    return Inertial(body, mass, centre, moments)


def told(scene: Scene, prim: Any, name: str) -> float | None:
    """An authored number of a prim, None where there is none that is finite."""
    attribute = prim.GetAttribute(name)
    value = scene.get(attribute) if attribute and attribute.HasAuthoredValue() else None
    return float(value) if value is not None and np.isfinite(value) else None


def centre_of(scene: Scene, prim: Any) -> Floats | None:
    """The centre of mass (3,) [m] that a body says; minus infinity stands for none."""
    value = scene.get(prim.GetAttribute("physics:centerOfMass"))
    if value is None or not np.isfinite(value).all():
        return None
    linear, offset = scene.placement(prim)
    centre: Floats = linear @ np.array(value, dtype=np.float64) + offset
    return centre


def moments_of(scene: Scene, prim: Any) -> Floats | None:
    """The inertia (3, 3) [kg m^2] that a body says, None where its moments are not all positive."""
    moments = scene.get(prim.GetAttribute("physics:diagonalInertia"))
    axes = scene.get(prim.GetAttribute("physics:principalAxes"))
    if moments is None or not np.isfinite(moments).all() or min(moments) <= 0:
        return None
    turn = scene.pose(prim).rotation @ (turn_of(axes) if axes is not None else np.eye(3))
    unit = scene.kilograms * scene.metres**2
    return np.asarray(turn @ np.diag(np.array(moments, dtype=np.float64) * unit) @ turn.T)


def turn_of(quaternion: Any) -> Floats:
    """The rotation (3, 3) of a quaternion of the library; none at all for one that is zero."""
    w, (x, y, z) = float(quaternion.GetReal()), map(float, quaternion.GetImaginary())
    length = float(np.linalg.norm([w, x, y, z]))
    if not np.isfinite(length) or length == 0:
        return np.eye(3)
    w, x, y, z = w / length, x / length, y / length, z / length
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
