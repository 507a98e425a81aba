"""Converted files as engines and other libraries read them: counts, places, sizes, joints, masses."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from meshforge.formats import read, save
from meshforge.formats.visuals import VisualSurfaces
from meshforge.symbolic import Asset, Joint
from tests.conversion_samples import block, doors, foreign, inertial
from tests.corpus_path import corpus
from tests.urdf_engines import assert_mujoco_agrees, bullet, yourdf

HINGE, SLIDE, FREE = 3, 2, 0  # mjtJoint


def at_rest(path: Path) -> tuple[Any, Any]:
    """The model of a file, and its state with all joints at zero."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def joints_of(model: Any, data: Any) -> dict[str, tuple[int, list[float], list[float], list[float]]]:
    """Kind, axis and anchor in the world, and range of each joint, by its name."""
    return {
        model.joint(k).name: (
            int(model.jnt_type[k]),
            np.round(data.xaxis[k], 9).tolist(),
            np.round(data.xanchor[k], 9).tolist(),
            np.round(model.jnt_range[k], 12).tolist() if model.jnt_limited[k] else [],
        )
        for k in range(model.njnt)
    }


def masses_of(model: Any, data: Any) -> dict[str, tuple[float, np.ndarray, np.ndarray]]:
    found = {}
    for k in range(1, model.nbody):
        turn = data.ximat[k].reshape(3, 3)
        found[model.body(k).name] = (
            float(model.body_mass[k]),
            data.xipos[k].copy(),
            turn @ np.diag(model.body_inertia[k]) @ turn.T,
        )
    return found


def assert_same_masses(one: dict[str, Any], other: dict[str, Any]) -> None:
    assert one.keys() == other.keys()
    for name, (mass, centre, inertia) in one.items():
        assert other[name][0] == pytest.approx(mass, rel=1e-9)
        np.testing.assert_allclose(other[name][1], centre, atol=1e-9, err_msg=name)
        np.testing.assert_allclose(other[name][2], inertia, atol=1e-9 * float(np.abs(inertia).max() + 1), err_msg=name)


def unfused(path: Path) -> Path:
    """A copy of a URDF beside it that MuJoCo loads without joining links that are fixed to each other."""
    head = b'<mujoco><compiler fusestatic="false" discardvisual="false" strippath="false"/></mujoco>\n</robot>'
    copy = path.with_name(f"unfused-{path.name}")
    copy.write_bytes(path.read_bytes().replace(b"</robot>", head))
    return copy


def test_a_made_mjcf_has_the_joints_and_masses_of_the_urdf_as_mujoco_reads_it(tmp_path: Path) -> None:
    urdf = save(doors(), tmp_path / "u" / "m.urdf").path
    mjcf = save(read(urdf), tmp_path / "x" / "m.xml").path
    own, made = at_rest(unfused(urdf)), at_rest(mjcf)
    assert joints_of(*made) == joints_of(*own)
    assert joints_of(*made)["hinge"][3] == [-0.5, 1.25]
    assert len(joints_of(*made)) == 3
    assert_same_masses(masses_of(*own), masses_of(*made))
    for field in ("dof_damping", "dof_frictionloss", "jnt_actfrcrange"):
        np.testing.assert_array_equal(getattr(made[0], field), getattr(own[0], field), err_msg=field)


def test_bullet_and_yourdfpy_have_the_joints_and_masses_of_a_urdf_made_of_an_mjcf(tmp_path: Path) -> None:
    before = read(save(doors(), tmp_path / "x" / "m.xml").path)
    path = save(before, tmp_path / "u" / "m.urdf").path
    seen = bullet(path)
    joints = {joint[1].decode(): joint for joint in seen["joints"]}
    assert {name: joint[2] for name, joint in joints.items()} == {"hinge": 0, "rail": 1, "axle": 0, "handle_fixed": 4}
    assert joints["hinge"][8:10] == pytest.approx((-0.5, 1.25))
    assert joints["rail"][8:10] == pytest.approx((0.0, 0.4))
    assert joints["axle"][8] > joints["axle"][9]  # without limits
    assert [dynamics[0] for dynamics in seen["dynamics"]] == pytest.approx([1.5, 2.5, 3.5, 4.5, 5.5])
    assert [len(own) for own in seen["shapes"]] == [2, 1, 1, 1, 1]
    robot = yourdf(path).robot
    assert {link.name: len(link.visuals) for link in robot.links if link.visuals} == {"frame": 1, "door": 1}
    assert [link.name for link in robot.links] == ["frame", "door", "handle", "drawer", "wheel"]
    rail = next(joint for joint in robot.joints if joint.name == "rail")
    assert rail.axis.tolist() == pytest.approx([0.6, 0.8, 0])
    assert {joint.name: joint.type for joint in robot.joints} == {
        "hinge": "revolute",
        "handle_fixed": "fixed",
        "rail": "prismatic",
        "axle": "continuous",
    }
    assert_mujoco_agrees(path)


def several() -> Asset:
    """A body on three joints with anchors of their own, one of them away from its frame; and a ball."""
    asset = foreign(
        {"world": doors().bodies[0].pose, "arm": doors().bodies[1].pose, "hand": doors().bodies[2].pose},
        [("arm/bone", "arm", block(0.5, 0.5, 0)), ("hand/palm", "hand", block(1, 1, 1))],
    )
    x, z = np.array([1.0, 0, 0]), np.array([0.0, 0.6, 0.8])
    joints = (
        Joint("slide", "prismatic", "world", "arm", np.zeros(3), x, (-1.0, 1.0)),
        Joint("swing", "revolute", "world", "arm", np.array([0.3, 0.1, 0.2]), z, (-2.0, 2.0)),
        Joint("twist", "revolute", "world", "arm", np.array([0.9, 0.4, 0.1]), x, (-1.0, 3.0)),
        Joint("wrist", "ball", "arm", "hand", np.array([0.8, 0.9, 0.5]), x),
    )
    masses = (inertial("arm", 2.0, (0.5, 0.5, 0)), inertial("hand", 1.0, (1, 1, 1)))
    return replace(asset, mechanism=replace(asset.mechanism, joints=joints, inertials=masses))


def test_several_joints_of_one_body_and_a_ball_move_alike_in_urdf(tmp_path: Path) -> None:
    mjcf = save(several(), tmp_path / "x" / "m.xml").path
    urdf = save(read(mjcf), tmp_path / "u" / "m.urdf").path
    turns = {"slide": 0.4, "swing": 0.9, "twist": -0.6}
    seen = []
    for path in (mjcf, unfused(urdf)):
        model, data = at_rest(path)
        for name, value in turns.items():
            data.qpos[model.jnt_qposadr[model.joint(name).id]] = value
        if path != mjcf:
            for name, value in {"wrist_x": 0.3, "wrist_y": -0.2, "wrist_z": 0.5}.items():
                data.qpos[model.jnt_qposadr[model.joint(name).id]] = value
        else:
            start, quaternion = model.jnt_qposadr[model.joint("wrist").id], np.array([1.0, 0, 0, 0])
            for axis, value in zip(np.eye(3), (0.3, -0.2, 0.5), strict=True):
                step = np.array([np.cos(value / 2), *np.sin(value / 2) * axis])
                mujoco.mju_mulQuat(quaternion, quaternion.copy(), step)
            data.qpos[start : start + 4] = quaternion
        mujoco.mj_forward(model, data)
        seen.append({model.geom(k).name: data.geom_xpos[k].copy() for k in range(model.ngeom)})
    for name, where in seen[0].items():
        np.testing.assert_allclose(seen[1][name], where, atol=1e-9, err_msg=name)


def test_a_free_body_becomes_the_root_link_and_a_free_body_again(tmp_path: Path) -> None:
    cup = '<body name="cup" pos="1 2 3"><freejoint name="f"/><geom size=".1"/></body>'
    text = f"<mujoco><worldbody>{cup}</worldbody></mujoco>"
    (tmp_path / "cup.xml").write_text(text)
    saved = save(read(tmp_path / "cup.xml"), tmp_path / "u" / "cup.urdf")
    assert [body.name for body in read(saved.path).bodies] == ["cup"]
    assert any("1 joint (f) is left out" in note for note in saved.notes)
    assert bullet(saved.path)["dynamics"][0][0] > 1  # not fixed
    two = text.replace("</worldbody>", '<body name="lid"><freejoint/><geom size=".2"/></body></worldbody>')
    (tmp_path / "two.xml").write_text(two)
    again = save(read(save(read(tmp_path / "two.xml"), tmp_path / "u" / "two.urdf").path), tmp_path / "x" / "two.xml")
    assert at_rest(again.path)[0].jnt_type.tolist() == [FREE, FREE]


def test_a_colour_is_the_same_in_every_description_format(tmp_path: Path) -> None:
    urdf = save(doors(), tmp_path / "u" / "m.urdf").path
    assert list(_bullet_colors(urdf)[0]) == pytest.approx([1, 0.25, 0, 1])
    mjcf = save(read(urdf), tmp_path / "x" / "m.xml").path
    model, _ = at_rest(mjcf)
    shown = [model.geom_rgba[k].tolist() for k in range(model.ngeom) if model.geom_group[k] == 2]
    assert pytest.approx([1, 0.25, 0, 1]) in shown
    import trimesh

    scene = trimesh.load_scene(save(read(mjcf), tmp_path / "g" / "m.glb").path)
    coloured = [mesh.visual for mesh in scene.geometry.values() if mesh.visual.kind == "texture"]
    colors = [visual.material.main_color.tolist() for visual in coloured]
    assert any(color[0] == 255 and color[2] == 0 and 0 < color[1] < 64 for color in colors)


def _bullet_colors(path: Path) -> list[Any]:
    import pybullet

    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(path), physicsClientId=client)
        shown = pybullet.getVisualShapeData(body, physicsClientId=client)
        return sorted((v[7] for v in shown), key=lambda color: color[2])  # the least blue first
    finally:
        pybullet.disconnect(client)


def test_the_sektion_cabinet_opens_in_mujoco_as_its_urdf_does(tmp_path: Path) -> None:
    folder = corpus("doors_cabinets", "IsaacGymEnvs", "sektion_cabinet_model", "urdf")
    before = read(folder / "sektion_cabinet.urdf")
    path = save(before, tmp_path / "m.xml").path
    model, data = at_rest(path)
    own = joints_of(model, data)
    for joint in before.mechanism.joints:
        if joint.kind != "fixed":
            kind, axis, anchor, limits = own[joint.name]
            assert kind == (HINGE if joint.kind == "revolute" else SLIDE)
            np.testing.assert_allclose(axis, joint.axis, atol=1e-9)
            np.testing.assert_allclose(anchor, joint.anchor, atol=1e-9)
            assert limits == pytest.approx(joint.limits)
    data.qpos[model.jnt_qposadr[model.joint("drawer_top_joint").id]] = 0.4
    shut = data.body("drawer_top").xpos.copy()
    mujoco.mj_forward(model, data)
    np.testing.assert_allclose(data.body("drawer_top").xpos - shut, [0.4, 0, 0], atol=1e-9)
    hulls = [geom for geom in before.geoms if not geom.shape.is_primitive]
    assert isinstance(before.visuals, VisualSurfaces)
    assert model.nmesh == len(hulls) + len(before.non_convex) + len({visual.what for visual in before.visuals.visuals})


def test_a_real_table_in_mjcf_loads_in_bullet_with_its_masses(tmp_path: Path) -> None:
    source = corpus("tables_desks", "clvrai-furniture", "objects", "table_klubbo_0740.xml")
    before = read(source)
    saved = save(before, tmp_path / "m.urdf")
    seen = bullet(saved.path)
    model, data = at_rest(source)
    masses = sorted(mass for mass, _, _ in masses_of(model, data).values())
    assert sorted(d[0] for d in seen["dynamics"] if d[0] > 0) == pytest.approx(masses, rel=1e-6)
    assert sum(len(own) for own in seen["shapes"]) == len(before.geoms)
    assert_mujoco_agrees(saved.path)
