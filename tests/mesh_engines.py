"""What trimesh, PyBullet and MuJoCo make of a plain mesh file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from meshforge.geometry import Floats


def objects(path: Path) -> dict[str, Any]:
    """The objects of an OBJ by name, as trimesh splits it."""
    import trimesh

    scene = trimesh.load_scene(path, split_objects=True, group_material=False, process=False)
    return dict(scene.geometry)


def bounds(path: Path) -> Floats:
    """The corners (2, 3) of all vertices that trimesh finds in a file, used by a face or not."""
    import trimesh

    mesh = trimesh.load_mesh(path, process=False)
    return np.asarray(mesh.bounds)


class Bullet:
    """PyBullet with one mesh file as a collision shape, to be asked by rays."""

    def __init__(self, path: Path) -> None:
        import pybullet

        self.engine = pybullet
        self.client = pybullet.connect(pybullet.DIRECT)
        at = {"physicsClientId": self.client}
        shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, fileName=str(path), **at)
        self.body = pybullet.createMultiBody(baseCollisionShapeIndex=shape, **at)

    def __enter__(self) -> Bullet:
        return self

    def __exit__(self, *_: object) -> None:
        self.engine.disconnect(self.client)

    def hits(self, point: Floats) -> bool:
        """Whether a ray from above, down to a point, hits the shape before it comes to the point."""
        start = point + np.array([0, 0, 100.0])
        ((body, *_),) = self.engine.rayTest(start.tolist(), point.tolist(), physicsClientId=self.client)
        return bool(body == self.body)

    @property
    def bounds(self) -> Floats:
        return np.array(self.engine.getAABB(self.body, physicsClientId=self.client))


def mujoco_hull(path: Path) -> Floats:
    """The vertices (n, 3) of the mesh of a file in the file's own frame, as MuJoCo compiles it."""
    import mujoco

    xml = (
        f'<mujoco><asset><mesh name="m" file="{path}" inertia="convex"/></asset>'
        '<worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>'
    )
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    turned = model.mesh_vert.astype(float) @ data.geom_xmat[0].reshape(3, 3).T
    return np.asarray(turned + data.geom_xpos[0])
