"""Drake, whose reader of SDF is Gazebo's own: SDF, URDF and MJCF."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.loads.readers.base import Place, Reader, Seen, box, capsule, cylinder, ellipsoid, hull


def _shapes(path: Path) -> Iterator[Seen]:
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
    from pydrake.multibody.tree import BodyIndex
    from pydrake.systems.framework import DiagramBuilder

    logging.getLogger("drake").setLevel(logging.ERROR)
    builder = DiagramBuilder()
    plant, scene = AddMultibodyPlantSceneGraph(builder, 0.0)
    parser = Parser(plant)
    parser.package_map().Add(path.parent.name, str(path.parent))
    parser.AddModels(str(path))
    plant.Finalize()
    diagram = builder.Build()
    context = plant.GetMyContextFromRoot(diagram.CreateDefaultContext())
    inspector = scene.model_inspector()
    for k in range(plant.num_bodies()):
        body = plant.get_body(BodyIndex(k))
        for geometry in plant.GetCollisionGeometriesForBody(body):
            at = plant.EvalBodyPoseInWorld(context, body) @ inspector.GetPoseInFrame(geometry)
            yield from _told(inspector.GetShape(geometry), Place(at.rotation().matrix(), at.translation()))


def _told(shape: Any, place: Place) -> Iterator[Seen]:
    match type(shape).__name__:
        case "Box":
            yield box(shape.size() / 2, place)
        case "Sphere":
            yield ellipsoid(shape.radius(), place, "sphere")
        case "Ellipsoid":
            yield ellipsoid((shape.a(), shape.b(), shape.c()), place)
        case "Capsule":
            yield capsule(shape.radius(), shape.length() / 2, place)
        case "Cylinder":
            yield cylinder(shape.radius(), shape.length() / 2, place)
        case "Mesh" | "Convex":
            own = shape.GetConvexHull()
            yield hull([own.vertex(k) for k in range(own.num_vertices())], place)


READER = Reader("Drake", "drake", "pydrake", dict.fromkeys((".sdf", ".urdf", ".xml"), "shape"), _shapes)
