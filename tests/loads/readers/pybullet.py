"""PyBullet: URDF, SDF, MJCF, OBJ and STL."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.loads.readers.base import Place, Reader, Seen, box, capsule, cylinder, ellipsoid, hull


def _shapes(path: Path) -> Iterator[Seen]:
    import pybullet

    pybullet.connect(pybullet.DIRECT)
    try:
        for body in _bodies(pybullet, path):
            for link in range(-1, pybullet.getNumJoints(body)):
                where = pybullet.getLinkState(body, link) if link >= 0 else pybullet.getBasePositionAndOrientation(body)
                frame = Place.of_quaternion(*where[:2])
                for index, shape in enumerate(pybullet.getCollisionShapeData(body, link)):
                    yield from _told(pybullet, shape, frame, (body, link, index))
    finally:
        pybullet.disconnect()


def _bodies(bullet: Any, path: Path) -> tuple[int, ...]:
    match path.suffix:
        case ".urdf":
            return (bullet.loadURDF(str(path), useFixedBase=True, flags=bullet.URDF_USE_INERTIA_FROM_FILE),)
        case ".sdf":
            bodies: tuple[int, ...] = bullet.loadSDF(str(path))
            return bodies
    shape = bullet.createCollisionShape(bullet.GEOM_MESH, fileName=str(path))
    return (bullet.createMultiBody(baseCollisionShapeIndex=shape),)


def _told(bullet: Any, shape: Any, frame: Place, at: tuple[int, int, int]) -> Iterator[Seen]:
    size, place = shape[3], frame @ Place.of_quaternion(*shape[5:7])
    match shape[2]:
        case bullet.GEOM_BOX:
            yield box([x / 2 for x in size], place)
        case bullet.GEOM_SPHERE:
            yield ellipsoid(size[0], place, "sphere")
        case bullet.GEOM_CAPSULE:
            yield capsule(size[1], size[0] / 2, place)
        case bullet.GEOM_CYLINDER:
            yield cylinder(size[1], size[0] / 2, place)
        case bullet.GEOM_MESH:
            body, link, index = at
            count, points = bullet.getMeshData(body, link, collisionShapeIndex=index)
            if count:
                yield hull(points, frame)  # they have the pose in them
                return
            # a mesh within a compound keeps its vertices to itself: the same file alone, of the same scale, tells them
            alone = bullet.createCollisionShape(bullet.GEOM_MESH, fileName=shape[4].decode(), meshScale=size)
            other = bullet.createMultiBody(baseCollisionShapeIndex=alone)
            for k in range(len(bullet.getCollisionShapeData(other, -1))):
                yield hull(bullet.getMeshData(other, -1, collisionShapeIndex=k)[1], place)
            bullet.removeBody(other)


READER = Reader(
    "PyBullet",
    "pybullet",
    "pybullet",
    {".urdf": "shape", ".sdf": "shape", ".obj": "shape", ".stl": "file"},
    _shapes,
    share=2e-4,
    rounds=0.01,
    about="It turns cylinders into polytopes of 64 corners. It computes hulls in integers, which moves corners by up "
    "to 2e-4 of a hull's width.",
    absent={".xml": "its reader of MJCF lets visual geoms collide and has no ellipsoids"},
    limits={
        (".sdf", "primitives"): "it does not support capsules and ellipsoids in an SDF",
        (".sdf", "model"): "it does not support frames in an SDF",
    },
)
