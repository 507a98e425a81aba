"""Joints and masses of a URDF in the root frame; odd ones never stop a reading."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from meshforge.geometry import Pose
from meshforge.symbolic import Inertial, Joint, Mechanism
from tests.urdf_sample import read, robot, sample

LINKS = '<link name="a"/><link name="b"/>'


def joint(inside: str = "", kind: str = "revolute") -> str:
    return f'<joint name="j" type="{kind}"><parent link="a"/><child link="b"/>{inside}</joint>'


def mechanism(tmp_path: Path, *inside: str) -> Mechanism:
    path = tmp_path / "r.urdf"
    path.write_text(robot(*inside))
    return read(path).mechanism


def test_joints_and_masses_are_in_the_root_frame(tmp_path: Path) -> None:
    found = read(sample(tmp_path)).mechanism
    (axle,) = found.joints
    assert (axle.name, axle.kind, axle.parent, axle.child, axle.limits) == ("axle", "revolute", "base", "wheel", None)
    np.testing.assert_allclose(axle.anchor, [0.4, 0.3, 0])
    np.testing.assert_allclose(axle.axis, [0, -1, 0], atol=1e-3)  # 1.57 about X
    assert [(i.body, i.mass) for i in found.inertials] == [("base", 2.5), ("wheel", 0.5)]
    np.testing.assert_allclose(found.inertials[0].centre, [0, 0, 0.1])
    np.testing.assert_allclose(found.inertials[0].inertia, np.diag([0.1, 0.2, 0.3]))


@pytest.mark.parametrize(
    ("kind", "inside", "limits"),
    [
        ("revolute", '<limit lower="-1" upper="2"/>', (-1, 2)),
        ("prismatic", '<limit upper="2"/>', (0, 2)),
        ("revolute", "<limit/>", None),  # nothing to move within: engines let it turn
        ("revolute", "", None),
        ("revolute", '<limit lower="2" upper="1"/>', None),
        ("continuous", '<limit lower="-1" upper="2"/>', None),
        ("revolute", '<limit lower="nan" upper="none"/>', None),
    ],
)
def test_limits_are_those_that_engines_keep(kind: str, inside: str, limits: Any, tmp_path: Path) -> None:
    assert mechanism(tmp_path, LINKS, joint(inside, kind)).joints[0].limits == limits


@pytest.mark.parametrize(
    ("said", "kind"),
    [
        ("fixed", "fixed"),
        ("revolute", "revolute"),
        ("continuous", "revolute"),
        ("prismatic", "prismatic"),
        ("floating", "floating"),
        ("planar", "fixed"),
        ("spherical", "ball"),
        ("rubber", "fixed"),
    ],
)
def test_every_type_of_joint_is_a_kind(said: str, kind: str, tmp_path: Path) -> None:
    assert mechanism(tmp_path, LINKS, joint(kind=said)).joints[0].kind == kind


@pytest.mark.parametrize(
    ("axis", "wanted"),
    [
        ("", (1, 0, 0)),
        ('<axis xyz="0 0 5"/>', (0, 0, 1)),
        ('<axis xyz="0 0 0"/>', (1, 0, 0)),
        ('<axis xyz="up"/>', (1, 0, 0)),
        ('<axis xyz="0 3 4"/>', (0, 0.6, 0.8)),
    ],
)
def test_axes_are_of_unit_length(axis: str, wanted: tuple[float, ...], tmp_path: Path) -> None:
    np.testing.assert_allclose(mechanism(tmp_path, LINKS, joint(axis)).joints[0].axis, wanted)


def test_damping_friction_effort_and_velocity_are_numbers_or_not_there(tmp_path: Path) -> None:
    said = '<limit effort="3" velocity="0"/><dynamics damping="0.5" friction="much"/>'
    found = mechanism(tmp_path, LINKS, joint(said)).joints[0]
    assert (found.damping, found.friction, found.effort, found.velocity) == (0.5, 0.0, 3.0, None)


@pytest.mark.parametrize(
    ("inside", "masses"),
    [
        ('<inertial><mass value="2"/></inertial>', [2.0]),
        ('<inertial><origin xyz="1 2"/><mass value="2"/><inertia ixx="x"/></inertial>', [2.0]),
        ('<inertial><mass value="0"/></inertial>', []),
        ('<inertial><mass value="heavy"/></inertial>', []),
        ("<inertial/>", []),
        ("", []),
    ],
)
def test_a_mass_is_there_where_it_is_more_than_nothing(inside: str, masses: list[float], tmp_path: Path) -> None:
    found = mechanism(tmp_path, f'<link name="a">{inside}</link>')
    assert [inertial.mass for inertial in found.inertials] == masses


def test_a_mechanism_turns_with_its_root_frame() -> None:
    turn = Pose([[1, 0, 0], [0, 0, -1], [0, 1, 0]], [0, 0, 5])
    joint = Joint("j", "revolute", "a", "b", np.array([1.0, 2, 3]), np.array([0, 1.0, 0]), (0.0, 1.0))
    inertial = Inertial("a", 1.0, np.array([1.0, 2, 3]), np.diag([1.0, 2, 3]))
    moved = Mechanism((joint,), (inertial,)).move(turn)
    np.testing.assert_allclose(moved.joints[0].anchor, [1, -3, 7])
    np.testing.assert_allclose(moved.joints[0].axis, [0, 0, 1])
    np.testing.assert_allclose(moved.inertials[0].centre, [1, -3, 7])
    np.testing.assert_allclose(moved.inertials[0].inertia, np.diag([1, 3, 2]))
    assert replace(moved.joints[0], anchor=joint.anchor, axis=joint.axis).limits == joint.limits
