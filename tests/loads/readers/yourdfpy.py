"""yourdfpy: URDF."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tests.loads.readers.base import Place, Reader, Seen, box, cylinder, ellipsoid, hull


def _shapes(path: Path) -> Iterator[Seen]:
    import yourdfpy

    robot = yourdfpy.URDF.load(
        str(path),
        load_meshes=False,
        load_collision_meshes=True,
        build_collision_scene_graph=True,
        force_collision_mesh=False,
    )
    scene = robot.collision_scene
    for link in robot.robot.links:
        frame = Place.of_matrix(robot.get_transform(link.name, collision_geometry=True))
        for collision in link.collisions:
            own = np.eye(4) if collision.origin is None else collision.origin
            yield from _told(collision.geometry, frame @ Place.of_matrix(own), robot, scene)


def _told(geometry: Any, place: Place, robot: Any, scene: Any) -> Iterator[Seen]:
    if geometry.box is not None:
        yield box(np.asarray(geometry.box.size) / 2, place)
    elif geometry.sphere is not None:
        yield ellipsoid(geometry.sphere.radius, place, "sphere")
    elif geometry.cylinder is not None:
        yield cylinder(geometry.cylinder.radius, geometry.cylinder.length / 2, place)
    elif geometry.mesh is not None:
        yield from _mesh(geometry.mesh, place, robot)


def _mesh(mesh: Any, place: Place, robot: Any) -> Iterator[Seen]:
    import trimesh

    loaded = trimesh.load_mesh(robot._filename_handler(fname=mesh.filename), process=False)
    scale = np.ones(3) if mesh.scale is None else np.broadcast_to(mesh.scale, 3)
    for piece in loaded.split(only_watertight=False):
        yield hull(piece.vertices * scale, place)


READER = Reader("yourdfpy", "yourdfpy", "yourdfpy", {".urdf": "shape"}, _shapes)
