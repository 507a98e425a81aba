"""Couplings of joints go between URDF, MJCF and SDF: MuJoCo moves the joint that drives, and the other one follows."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest
import yourdfpy
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from meshforge.formats import read, save
from meshforge.formats.conversion import plan_couplings
from meshforge.symbolic import Coupling, FeatureKind, Joint

FINGER = """\
<robot name="hand">
  <link name="palm"><collision><geometry><box size=".1 .1 .1"/></geometry></collision></link>
  {links}
  {joints}
</robot>
"""
LINK = """<link name="{0}"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size=".02 .02 .1"/></geometry></collision></link>"""
JOINT = """<joint name="q{0}" type="{kind}"><origin xyz="0 0 .2"/><parent link="{1}"/><child link="l{0}"/>
<axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/>{mimic}</joint>"""


def hand(folder: Path, *mimics: str, kind: str = "revolute") -> Path:
    """A URDF of a chain of links, one for each of the mimics, which may be empty."""
    count = len(mimics)
    links = "\n".join(LINK.format(f"l{k}") for k in range(1, count + 1))
    parents = ["palm", *(f"l{k}" for k in range(1, count))]
    joints = [JOINT.format(k + 1, parents[k], mimic=mimic, kind=kind) for k, mimic in enumerate(mimics)]
    path = folder / "hand.urdf"
    path.write_text(FINGER.format(links=links, joints="\n".join(joints)))
    return path


def mimic(joint: str, factor: float, offset: float) -> str:
    return f'<mimic joint="{joint}" multiplier="{factor}" offset="{offset}"/>'


def follow(path: Path, driver: str, follower: str, at: float) -> float:
    """Where MuJoCo puts a joint after a while, another one being held at a place."""
    spec = mujoco.MjSpec.from_file(str(path))
    spec.option.gravity = np.zeros(3)
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, name1=driver, data=[at, *[0.0] * 11])
    for joint in spec.joints:
        joint.damping = [2.0, 0.0, 0.0]
    model = spec.compile()
    data = mujoco.MjData(model)
    for _ in range(4000):
        mujoco.mj_step(model, data)
    return float(data.joint(follower).qpos[0])


def converted(source: Path, *suffixes: str) -> Path:
    """The file of an asset that goes through formats one after another."""
    path = source
    for k, suffix in enumerate(suffixes):
        path = save(read(path), source.parent / f"step{k}" / f"hand{suffix}").path
    return path


@pytest.mark.parametrize("way", [(".xml",), (".sdf", ".xml"), (".xml", ".urdf", ".sdf", ".xml")], ids=" ".join)
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_a_joint_follows_in_mujoco_however_it_came_there(tmp_path: Path, way: tuple[str, ...], kind: str) -> None:
    path = converted(hand(tmp_path, "", mimic("q1", 1.05, 0.02), kind=kind), *way)
    assert follow(path, "q1", "q2", 0.5) == pytest.approx(0.02 + 1.05 * 0.5, abs=2e-3)
    (equality,) = etree.parse(path).getroot().findall("equality/joint")
    assert dict(equality.attrib) == {"joint1": "q2", "joint2": "q1", "polycoef": "0.02 1.05 0 0 0"}


def test_yourdfpy_finds_the_coupling_of_a_urdf_made_of_an_mjcf(tmp_path: Path) -> None:
    path = converted(hand(tmp_path, "", mimic("q1", -1.5, 0.25)), ".xml", ".urdf")
    robot = yourdfpy.URDF.load(str(path), load_meshes=False)
    found = robot.joint_map["q2"].mimic
    assert (found.joint, found.multiplier, found.offset) == ("q1", -1.5, 0.25)
    assert robot.actuated_joint_names == ["q1"]


def test_an_sdf_says_a_coupling_in_the_version_that_has_them(tmp_path: Path) -> None:
    root = etree.parse(converted(hand(tmp_path, "", mimic("q1", 1.05, 0.02)), ".sdf")).getroot()
    assert root.get("version") == "1.11"
    (found,) = root.findall(".//joint/axis/mimic")
    assert dict(found.attrib) == {"joint": "q1", "axis": "axis"}
    assert {child.tag: child.text for child in found} == {"multiplier": "1.05", "offset": "0.02", "reference": "0"}


def test_the_reference_of_an_sdf_counts(tmp_path: Path) -> None:
    path = converted(hand(tmp_path, "", mimic("q1", 2.0, 0.0)), ".sdf")
    path.write_text(path.read_text().replace("<reference>0</reference>", "<reference>0.1</reference>"))
    (joint,) = [joint for joint in read(path).mechanism.joints if joint.coupling]
    assert joint.coupling == Coupling("q1", (-0.2, 2.0))


def test_a_reference_position_of_an_mjcf_is_the_zero_of_its_coupling(tmp_path: Path) -> None:
    (tmp_path / "a.xml").write_text(
        '<mujoco><compiler angle="radian"/><worldbody><body><joint name="a" ref="0.3"/><geom size=".1"/>'
        '<body pos="1 0 0"><joint name="b" ref="0.1"/><geom size=".1"/></body></body></worldbody>'
        '<equality><joint joint1="b" joint2="a" polycoef="0.02 2"/></equality></mujoco>'
    )
    path = converted(tmp_path / "a.xml", ".urdf", ".xml")
    before = follow(tmp_path / "a.xml", "a", "b", 0.2) - 0.1  # held 0.2 beyond its reference
    assert follow(path, "a", "b", 0.2) == pytest.approx(before, abs=2e-3) == pytest.approx(0.42, abs=2e-3)


def test_a_chain_follows_the_joint_that_drives_it(tmp_path: Path) -> None:
    source = hand(tmp_path, "", mimic("q1", 2.0, 0.1), mimic("q2", -0.5, 0.2))
    saved = save(read(source), tmp_path / "out" / "hand.xml")
    assert "joint 'q3' follows 'q1' itself, no longer through 'q2'" in saved.notes
    assert follow(saved.path, "q1", "q3", 0.3) == pytest.approx(0.2 - 0.5 * (0.1 + 2 * 0.3), abs=3e-3)


@pytest.mark.parametrize("suffix", [".xml", ".sdf"])
@pytest.mark.parametrize(
    ("mimics", "said"),
    [
        (("", mimic("gone", 1, 0)), "1 coupling (q2) is left out: there is no joint 'gone' that turns or slides"),
        ((mimic("q2", 1, 0), mimic("q1", 1, 0)), "1 coupling (q1) is left out: q1 -> q2 -> q1 is a ring"),
        ((mimic("q1", 1, 0),), "1 coupling (q1) is left out: q1 -> q1 is a ring"),
    ],
)
def test_what_cannot_be_coupled_is_named(tmp_path: Path, mimics: tuple[str, ...], said: str, suffix: str) -> None:
    saved = save(read(hand(tmp_path, *mimics)), tmp_path / "out" / f"hand{suffix}")
    assert said in saved.notes
    assert FeatureKind.MIMICS not in {feature.kind for feature in saved.report.kept}
    assert not any(joint.coupling for joint in read(saved.path).mechanism.joints)


MODEL = """<mujoco><worldbody><body><joint name="a"/><geom size=".1"/>
<body pos="1 0 0"><joint name="b"/><geom size=".1"/></body></body></worldbody><equality>{}</equality></mujoco>"""


def test_a_coupling_that_is_not_linear_is_left_out_by_name(tmp_path: Path) -> None:
    (tmp_path / "a.xml").write_text(MODEL.format('<joint joint1="b" joint2="a" polycoef="0 1 .5 0 0"/>'))
    notes = save(read(tmp_path / "a.xml"), tmp_path / "a.urdf").notes
    assert "1 coupling (b) is left out: it follows a polynomial, and URDF has linear couplings only" in notes


@pytest.mark.parametrize(
    "other",
    ['<joint joint1="b" polycoef="0.5"/>', '<joint joint1="b" joint2="a" active="false"/>', '<weld body1="world"/>'],
)
def test_other_equalities_are_named_and_no_couplings(tmp_path: Path, other: str) -> None:
    (tmp_path / "a.xml").write_text(MODEL.format(other))
    asset = read(tmp_path / "a.xml")
    assert not any(joint.coupling for joint in asset.mechanism.joints)
    notes = save(asset, tmp_path / "a.urdf").notes
    assert any("equality joint" in note or "equality weld" in note for note in notes)


def test_a_gltf_and_a_stage_name_the_couplings_that_they_lack(tmp_path: Path) -> None:
    source = read(hand(tmp_path, "", mimic("q1", 1, 0)))
    for suffix in (".glb", ".usda"):
        notes = save(source, tmp_path / "out" / f"a{suffix}").notes
        assert any(note.startswith("1 coupling (q2) is left out: MeshForge does not convert") for note in notes)


@given(st.lists(st.tuples(st.floats(-2, 2), st.floats(-2, 2)), min_size=1, max_size=5), st.floats(-2, 2))
def test_a_chain_through_to_its_driver_is_at_the_same_place(links: list[tuple[float, float]], at: float) -> None:
    joints = [Joint("q0", "revolute", "a", "b", np.zeros(3), np.eye(3)[0])]
    places = [at]
    for k, (offset, factor) in enumerate(links):
        coupling = Coupling(f"q{k}", (offset, factor))
        joints.append(Joint(f"q{k + 1}", "revolute", "a", "b", np.zeros(3), np.eye(3)[0], coupling=coupling))
        places.append(offset + factor * places[-1])
    plan = plan_couplings(joints[::-1], "URDF")
    assert not plan.lost
    evaluate: Callable[[Coupling], float] = lambda own: sum(c * at**k for k, c in enumerate(own.coefficients))  # noqa: E731
    for k, place in enumerate(places[1:], 1):
        own = plan.by_joint[f"q{k}"]
        assert own.joint == "q0" and evaluate(own) == pytest.approx(place, abs=1e-9)
