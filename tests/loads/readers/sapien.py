"""SAPIEN: URDF, and mesh files through its builder; physics only, so that no graphics driver is wanted."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tests.loads.readers.base import Place, Reader, Seen, box, capsule, cylinder, ellipsoid, hull


def _shapes(path: Path) -> Iterator[Seen]:
    warnings.simplefilter("ignore")
    import sapien

    scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
    if path.suffix != ".urdf":
        builder = scene.create_actor_builder()
        builder.add_multiple_convex_collisions_from_file(str(path))
        rigid = builder.build_static().find_component_by_type(sapien.physx.PhysxRigidStaticComponent)
        yield from _of_body(rigid)
        return
    for articulation, actor in _loaded(scene, path):
        for link in articulation.links if articulation else ():
            yield from _of_body(link)
        if actor:
            yield from _of_body(actor.find_component_by_type(sapien.physx.PhysxRigidDynamicComponent))


def _loaded(scene: Any, path: Path) -> Iterator[tuple[Any, Any]]:
    """The articulations and the single bodies of a URDF, without what is seen of them."""
    import sapien.wrapper.urdf_loader as module

    class Unseen(module.URDFLoader):  # type: ignore[misc]
        """A loader that passes over what is seen, which would want a graphics driver."""

        def _build_link(self, link: Any, builder: Any) -> None:
            link.visuals.clear()
            super()._build_link(link, builder)

    loader = Unseen()
    loader.set_scene(scene)
    loader.load_multiple_collisions_from_file = True
    articulations, actors, _ = loader.parse(str(path))
    for builder in articulations:
        articulation = builder.build()
        articulation.set_qpos(np.zeros(articulation.dof))
        yield articulation, None
    for builder in actors:
        yield None, builder.build()


def _of_body(body: Any) -> Iterator[Seen]:
    for shape in body.collision_shapes:
        place = _place(body.entity_pose if hasattr(body, "entity_pose") else body.entity.pose) @ _place(
            shape.local_pose
        )
        match type(shape).__name__.removeprefix("PhysxCollisionShape"):
            case "Box":
                yield box(shape.half_size, place)
            case "Sphere":
                yield ellipsoid(shape.radius, place, "sphere")
            case "Capsule":
                yield capsule(shape.radius, shape.half_length, place, axis=0)
            case "Cylinder":
                yield cylinder(shape.radius, shape.half_length, place, axis=0)
            case "ConvexMesh" | "TriangleMesh":
                yield hull(shape.vertices * np.asarray(shape.scale), place)


def _place(pose: Any) -> Place:
    w, x, y, z = pose.q
    return Place.of_quaternion(pose.p, (x, y, z, w))


READER = Reader(
    "SAPIEN",
    "sapien",
    "sapien",
    {**dict.fromkeys((".urdf", ".obj", ".ply", ".glb", ".gltf"), "shape"), ".stl": "file"},
    _shapes,
    inward=7e-4,
    rounds=0.06,
    about="PhysX leaves out corners of a hull that lie within its plane tolerance, 0.7 mm.",
)
