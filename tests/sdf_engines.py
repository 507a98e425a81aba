"""What PyBullet and Drake, whose parser is Gazebo's own, make of an SDF file, as plain data to compare."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Pose, Shape, Sphere
from meshforge.symbolic import Asset


@dataclass(frozen=True)
class Seen:
    """A primitive collision shape in the world: its kind, its centre (3,), its rotation (3, 3) and its sizes."""

    kind: str
    centre: np.ndarray
    rotation: np.ndarray
    sizes: tuple[float, ...]


def sizes_of(shape: Shape) -> tuple[float, ...]:
    """The sizes of a primitive as SDF tells them."""
    match shape:
        case Box():
            return tuple(2 * shape.half)
        case Ellipsoid():
            return tuple(shape.radii)
        case Sphere():
            return (shape.radius,)
        case Cylinder() | Capsule():
            return (shape.radius, 2 * shape.half_length)
    raise AssertionError(f"{shape.kind} is no primitive")


def assert_same_primitives(asset: Asset, seen: Sequence[Seen], slack: float = 1e-9) -> int:
    """Each primitive of an asset is seen, and none besides; how many there were."""
    left = list(seen)
    for geom in asset.geoms:
        shape = geom.shape
        if isinstance(shape, Box | Capsule | Cylinder | Ellipsoid | Sphere):
            like = [k for k, one in enumerate(left) if _same(one, shape, shape.pose, slack)]
            assert like, f"{geom.name} is not seen among {left}"
            left.pop(like[0])
    assert left == []
    return len(seen)


def _same(seen: Seen, shape: Shape, pose: Pose, slack: float) -> bool:
    if seen.kind != shape.kind or not np.allclose(seen.sizes, sizes_of(shape), atol=slack):
        return False
    turn = seen.kind == "sphere" or np.allclose(seen.rotation, pose.rotation, atol=10 * slack)
    return turn and np.allclose(seen.centre, pose.translation, atol=10 * slack)


def bullet(path: Path) -> dict[str, Any]:
    """The number of collision shapes, and the boxes around links with all shapes in them, as PyBullet reads a file."""
    import pybullet

    client = pybullet.connect(pybullet.DIRECT)
    try:
        at = {"physicsClientId": client}
        bodies = pybullet.loadSDF(str(path), **at)
        pairs = [(body, k) for body in bodies for k in range(-1, pybullet.getNumJoints(body, **at))]
        return {
            "shapes": sum(len(pybullet.getCollisionShapeData(body, k, **at)) for body, k in pairs),
            "masses": sorted(pybullet.getDynamicsInfo(body, k, **at)[0] for body, k in pairs),
            "bounds": [pybullet.getAABB(body, k, **at) for body, k in pairs],
        }
    finally:
        pybullet.disconnect(client)


def drake(path: Path, packages: dict[str, Path]) -> tuple[list[Seen], int]:
    """The primitives, and the number of other shapes, as Drake reads a file; skips the test where there is no Drake."""
    pytest.importorskip("pydrake", reason="drake is not installed (pip install drake)")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
    from pydrake.multibody.tree import BodyIndex
    from pydrake.systems.framework import DiagramBuilder

    builder = DiagramBuilder()
    plant, scene = AddMultibodyPlantSceneGraph(builder, 0.0)
    parser = Parser(plant)
    for name, folder in packages.items():
        parser.package_map().Add(name, str(folder))
    parser.AddModels(str(path))
    plant.Finalize()
    diagram = builder.Build()
    context = plant.GetMyContextFromRoot(diagram.CreateDefaultContext())
    inspector = scene.model_inspector()
    seen, others = [], 0
    for k in range(plant.num_bodies()):
        body = plant.get_body(BodyIndex(k))
        for geometry in plant.GetCollisionGeometriesForBody(body):
            at = plant.EvalBodyPoseInWorld(context, body) @ inspector.GetPoseInFrame(geometry)
            kind, sizes = _drake_sizes(inspector.GetShape(geometry))
            others += not sizes
            if sizes:
                seen.append(Seen(kind, at.translation(), at.rotation().matrix(), sizes))
    return seen, others


def _drake_sizes(shape: Any) -> tuple[str, tuple[float, ...]]:
    kind = type(shape).__name__.lower()
    match kind:
        case "box":
            return kind, tuple(shape.size())
        case "sphere":
            return kind, (shape.radius(),)
        case "cylinder" | "capsule":
            return kind, (shape.radius(), shape.length())
        case "ellipsoid":
            return kind, (shape.a(), shape.b(), shape.c())
    return kind, ()
