"""USD's own library: the shapes that its physics reader hands to engines."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tests.loads.readers.base import Place, Reader, Seen, box, capsule, cylinder, ellipsoid, hull


def _shapes(path: Path) -> Iterator[Seen]:
    from pxr import Usd, UsdGeom, UsdPhysics

    stage = Usd.Stage.Open(str(path))
    metres = UsdGeom.GetStageMetersPerUnit(stage)
    world = UsdGeom.XformCache()
    found = UsdPhysics.UsdPhysicsLoadStageFromPrimRange(stage, ["/"]).values()
    every = [(str(at), told) for prims, each in found for at, told in zip(prims, each, strict=True)]
    bodies = {
        at: _place(told.position, told.rotation) for at, told in every if isinstance(told, UsdPhysics.RigidBodyDesc)
    }
    nowhere = _place((0, 0, 0), 1)
    for at, told in every:
        if hasattr(told, "localPos") and told.isValid:
            place = bodies.get(str(told.rigidBody), nowhere) @ _place(told.localPos, told.localRot)
            prim = stage.GetPrimAtPath(at)
            yield from _told(
                told, place, prim, Place.of_matrix(np.array(world.GetLocalToWorldTransform(prim)).T), metres
            )


def _told(told: Any, place: Place, prim: Any, own: Place, metres: float) -> Iterator[Seen]:
    """place: world_T_shape, own: world_T_prim, scale and all; in the unit of the stage."""
    place = Place(place.rotation, place.translation * metres)
    match type(told).__name__.removesuffix("ShapeDesc"):
        case "Cube":
            yield box(np.array(told.halfExtents) * metres, place)
        case "Sphere":
            yield ellipsoid(told.radius * metres, place, "sphere")
        case "Capsule":
            yield capsule(told.radius * metres, told.halfHeight * metres, place, _axis(told))
        case "Cylinder":
            yield cylinder(told.radius * metres, told.halfHeight * metres, place, _axis(told))
        case "Mesh":
            points = np.array(prim.GetAttribute("points").Get())
            yield hull(points * metres, Place(own.rotation, own.translation * metres))


def _place(position: Any, rotation: Any) -> Place:
    """Of a position and a quaternion of the library, or 1 for none."""
    return Place.of_quaternion(position, (0, 0, 0, 1) if rotation == 1 else (*rotation.imaginary, rotation.real))


def _axis(told: Any) -> int:
    return "XYZ".index(str(told.axis)[-1])


READER = Reader("USD", "usd-core", "pxr.Usd", dict.fromkeys((".usda", ".usdc", ".usdz"), "shape"), _shapes)
