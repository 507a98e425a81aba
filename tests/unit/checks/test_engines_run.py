"""Numbers of `docs/engines.md` that are told as tried: the engines are run, as they are installed."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from meshforge.engines import ENGINES
from meshforge.geometry import Aabb, Box
from tests.mesh_files import obj


def compiled(volume: float) -> mujoco.MjModel:
    cube = Box.of_bounds(Aabb([0, 0, 0], [1, 1, 1])).tessellate().vertices * np.cbrt(volume)
    spec = mujoco.MjSpec()
    spec.add_mesh(name="cube", uservert=cube.ravel().tolist())
    spec.worldbody.add_body().add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="cube")
    return spec.compile()


def test_mujoco_takes_a_mesh_at_the_limit_and_refuses_a_smaller_one() -> None:
    (limit,) = (limit for limit in ENGINES["mujoco"].limits if limit.rule == "volume")
    assert compiled(limit.number).ngeom == 1
    with pytest.raises(ValueError, match="mesh volume is too small"):
        compiled(limit.number / 2)


def test_mujoco_has_the_native_shapes_that_are_told() -> None:
    known = {name.removeprefix("mjGEOM_").lower() for name in dir(mujoco.mjtGeom)}
    assert ENGINES["mujoco"].primitives <= known


URDF = """<robot name="r"><link name="l"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><mesh filename="plate.obj"/></geometry></collision></link></robot>"""


def test_the_margin_of_bullet_makes_a_hull_at_the_limit_twice_as_thick(tmp_path: Path) -> None:
    import pybullet

    (limit,) = (limit for limit in ENGINES["bullet"].limits if limit.rule == "thin")
    plate = Box.of_bounds(Aabb([-1, -1, 0], [1, 1, limit.number])).tessellate()
    (tmp_path / "plate.obj").write_bytes(obj((plate.vertices, plate.faces)))
    (tmp_path / "plate.urdf").write_text(URDF)
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(tmp_path / "plate.urdf"), physicsClientId=client)
        sphere = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.1, physicsClientId=client)
        spots = [[0, 0, 0.5], [0, 0, -0.5]]
        balls = [pybullet.createMultiBody(1, sphere, basePosition=at, physicsClientId=client) for at in spots]
        gaps = [pybullet.getClosestPoints(body, ball, 1, physicsClientId=client)[0][8] for ball in balls]
    finally:
        pybullet.disconnect(client)
    thickness = 1.0 - 2 * 0.1 - sum(gaps)
    assert thickness == pytest.approx(2 * limit.number, abs=1e-5)
