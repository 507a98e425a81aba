"""What PyBullet, MuJoCo and yourdfpy make of a URDF file, as plain data to compare."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from meshforge.symbolic import Asset

Corners = tuple[np.ndarray, np.ndarray]


def bullet(path: Path) -> dict[str, Any]:
    """Dynamics (masses, inertia, friction ...), joints, shapes and visuals of each link, as PyBullet reads it."""
    import pybullet

    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(path), flags=pybullet.URDF_USE_INERTIA_FROM_FILE, physicsClientId=client)
        links = range(-1, pybullet.getNumJoints(body, physicsClientId=client))
        at = {"physicsClientId": client}
        shapes = [pybullet.getCollisionShapeData(body, k, **at) for k in links]
        return {
            "dynamics": [pybullet.getDynamicsInfo(body, k, **at) for k in links],
            "joints": [pybullet.getJointInfo(body, k, **at) for k in links if k >= 0],
            "states": [pybullet.getLinkState(body, k, **at)[:6] for k in links if k >= 0],
            "shapes": [[(s[2], s[3], Path(s[4].decode()).name, s[5], s[6]) for s in own] for own in shapes],
            "visuals": [(v[1:4], Path(v[4].decode()).name, v[5:8]) for v in pybullet.getVisualShapeData(body, **at)],
            "bounds": [pybullet.getAABB(body, k, **at) for k in links],
        }
    finally:
        pybullet.disconnect(client)


def mujoco_model(path: Path) -> Any:
    """The file as MuJoCo compiles it."""
    import mujoco

    return mujoco.MjModel.from_xml_path(str(path))


MASSES = ("body_mass", "body_inertia", "body_ipos", "body_iquat", "body_pos", "body_quat", "jnt_type", "jnt_axis")
GEOMS = ("geom_type", "geom_size", "geom_pos", "geom_quat", "geom_friction", "mesh_vert")


def mujoco_boxes(path: Path) -> dict[str, Corners]:
    """The world AABB of each named geom at zero, from the vertices that MuJoCo has, or for a box from its size."""
    import mujoco

    model = mujoco_model(path)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    found = {}
    for k in range(model.ngeom):
        mesh = model.geom_dataid[k]
        if mesh >= 0:
            start = model.mesh_vertadr[mesh]
            points = model.mesh_vert[start : start + model.mesh_vertnum[mesh]].astype(float)
        elif model.geom_type[k] == mujoco.mjtGeom.mjGEOM_BOX:
            signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
            points = signs * model.geom_size[k]
        else:
            continue
        world = points @ data.geom_xmat[k].reshape(3, 3).T + data.geom_xpos[k]
        found[model.geom(k).name] = (world.min(axis=0), world.max(axis=0))
    return found


def assert_mujoco_agrees(path: Path, asset: Asset) -> int:
    """MuJoCo has each of its named meshes and boxes where the asset has the hull of that name; how many there were."""
    tails = [g.name.removeprefix(f"{g.body}/") for g in asset.geoms]
    hulls = {tail: g.shape for tail, g in zip(tails, asset.geoms, strict=True) if tails.count(tail) == 1}
    boxes = mujoco_boxes(path)
    common = [name for name in boxes if name in hulls]  # MuJoCo drops names that two links share
    for name in common:
        low, high = boxes[name]
        np.testing.assert_allclose(low, hulls[name].aabb.min, atol=1e-5, err_msg=name)
        np.testing.assert_allclose(high, hulls[name].aabb.max, atol=1e-5, err_msg=name)
    return len(common)


def yourdf(path: Path) -> Any:
    """The file as yourdfpy reads it, collision meshes included."""
    import yourdfpy

    return yourdfpy.URDF.load(
        str(path),
        load_meshes=False,
        load_collision_meshes=True,
        build_collision_scene_graph=True,
        force_collision_mesh=False,
    )
