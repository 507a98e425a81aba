"""A program for a process of its own, since PyBullet may crash: loads a file in PyBullet, and writes the shapes that
collide there as JSON rows: kind (`unknown`, with the link for the size, where it does not say what it has), size,
position and quaternion in the root frame, points of a mesh, margin [m]."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pybullet as bullet

_KINDS = {
    bullet.GEOM_BOX: "box",
    bullet.GEOM_SPHERE: "sphere",
    bullet.GEOM_CAPSULE: "capsule",
    bullet.GEOM_CYLINDER: "cylinder",
    bullet.GEOM_MESH: "mesh",
}
_MARGIN = 0.001
"""Of each hull of a mesh [m], as its importers set it (gUrdfDefaultCollisionMargin); it says 0 of several in a link."""


def _load(path: str) -> tuple[int, ...]:
    if path.endswith(".urdf"):
        return (bullet.loadURDF(path, useFixedBase=True, flags=bullet.URDF_USE_INERTIA_FROM_FILE),)
    if path.endswith(".sdf"):
        return tuple(bullet.loadSDF(path))
    shape = bullet.createCollisionShape(bullet.GEOM_MESH, fileName=path)
    return (bullet.createMultiBody(baseCollisionShapeIndex=shape),) if shape >= 0 else (-1,)


def _read_link(body: int, link: int, alone: str) -> Iterator[list[Any]]:
    """The rows of a link; alone: the mesh file that all of it is of, which has a row there for each hull."""
    place = bullet.getLinkState(body, link)[:2] if link >= 0 else bullet.getBasePositionAndOrientation(body)
    name = (bullet.getJointInfo(body, link)[12] if link >= 0 else bullet.getBodyInfo(body)[0]).decode()
    for index, row in enumerate(bullet.getCollisionShapeData(body, link)[: 1 if alone else None]):
        kind, size, file = row[2:5]
        pose = bullet.multiplyTransforms(*place, *row[5:7])
        if kind != bullet.GEOM_MESH:
            if kind in _KINDS:
                yield [_KINDS[kind], size, *pose, [], 0.0]
            continue
        # in a link a mesh keeps its vertices to itself: the same file alone, of the same scale, has the same hulls,
        # of an OBJ one for each of its objects
        if not alone and file == b"unknown_file":  # a round shape of which it made a polytope
            yield ["mesh", size, *place, bullet.getMeshData(body, link, collisionShapeIndex=index)[1], _MARGIN]
            continue
        try:
            shape = bullet.createCollisionShape(bullet.GEOM_MESH, fileName=alone or file.decode(), meshScale=size)
        except bullet.error:  # a Collada file
            yield ["unknown", name, *pose, [], _MARGIN]
            continue
        other = bullet.createMultiBody(baseCollisionShapeIndex=shape)
        for k in range(len(bullet.getCollisionShapeData(other, -1))):
            yield ["mesh", size, *pose, bullet.getMeshData(other, -1, collisionShapeIndex=k)[1], _MARGIN]
        bullet.removeBody(other)


def main(path: str, out: str) -> int:
    """Return the exit code: 3 where PyBullet refuses the file."""
    bullet.connect(bullet.DIRECT)
    try:
        bodies = _load(path)
    except bullet.error:
        return 3
    if not bodies or min(bodies) < 0:
        return 3
    links = [(body, link) for body in bodies for link in range(-1, bullet.getNumJoints(body))]
    alone = "" if path.endswith((".urdf", ".sdf")) else path
    rows = [row for body, link in links for row in _read_link(body, link, alone)]
    Path(out).write_text(json.dumps(rows), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
