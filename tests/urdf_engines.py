"""What PyBullet, MuJoCo and yourdfpy make of a URDF file, as plain data to compare."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from meshforge.formats import read
from tests.loads.comparing import differences, shapes_of
from tests.loads.readers import READERS


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
    import mujoco

    return mujoco.MjModel.from_xml_path(str(path))


MASSES = ("body_mass", "body_inertia", "body_ipos", "body_iquat", "body_pos", "body_quat", "jnt_type", "jnt_axis")


def assert_mujoco_agrees(path: Path) -> None:
    """MuJoCo has as many shapes in a URDF as MeshForge reads there, and each where that is."""
    mujoco = READERS["mujoco"]
    assert differences(shapes_of(read(path)), list(mujoco.shapes(path)), mujoco, ".urdf") == []


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
