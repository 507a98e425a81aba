"""What an MJCF says of contact holds in the check: excluded pairs, bits, pairs, friction."""

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from meshforge.checks.physics.mechanism import ContactRules, JointTree
from meshforge.checks.physics.model import compile_model
from meshforge.checks.physics.simulation import Physics, simulate
from meshforge.geometry import Pose
from meshforge.symbolic import Hull, SymbolicMesh
from tests.mjcf_engines import asset

BOXES = (
    '<body name="one"><freejoint/><geom name="a" type="box" size=".5 .5 .5" {}/></body>'
    '<body name="two" pos=".6 0 0"><freejoint/><geom name="b" type="box" size=".5 .5 .5" {}/></body>'
)


def mesh(folder: Path, inside: str, contact: str = "") -> SymbolicMesh:
    return SymbolicMesh.of(asset(folder, inside, f"<contact>{contact}</contact>" if contact else ""))


def rules(found: Physics) -> set[str]:
    return {finding.rule for finding in found.findings}


def test_bodies_that_the_file_lets_touch_are_found_to_overlap(tmp_path: Path) -> None:
    found = simulate(mesh(tmp_path, BOXES.format("", "")))
    assert [overlap.excluded for overlap in found.overlaps] == [False]
    assert "physics-overlap" in rules(found) and "excluded" not in found.description


@pytest.mark.parametrize(
    ("first", "second", "contact"),
    [
        ("", "", '<exclude body1="two" body2="one"/>'),
        ('contype="1" conaffinity="2"', 'contype="1" conaffinity="2"', ""),
        ('contype="1" conaffinity="0"', 'contype="4" conaffinity="2"', ""),
        ('contype="1048577"', 'contype="1048576" conaffinity="2"', ""),
    ],
)
def test_an_overlap_that_the_file_excludes_does_no_harm(tmp_path: Path, first: str, second: str, contact: str) -> None:
    found = simulate(mesh(tmp_path, BOXES.format(first, second), contact))
    (overlap,) = found.overlaps
    assert overlap.excluded and overlap.depth == pytest.approx(0.4, rel=0.05)
    assert rules(found) == set() and found.rest is not None and found.rest.moved < 1e-3
    assert found.description.endswith("1 overlap of bodies, 1 excluded by the file")


def test_a_pair_touches_whatever_bits_and_exclusions_say(tmp_path: Path) -> None:
    apart = 'contype="0" conaffinity="0"'
    contact = '<exclude body1="one" body2="two"/><pair geom1="a" geom2="b"/>'
    found = simulate(mesh(tmp_path, BOXES.format(apart, apart), contact))
    assert [overlap.excluded for overlap in found.overlaps] == [False]
    assert "physics-overlap" in rules(found) and found.rest is not None and found.rest.fastest > 1


def test_what_meets_nothing_by_its_bits_still_stands_on_the_plane(tmp_path: Path) -> None:
    alone = '<body><freejoint/><geom name="a" type="box" size=".5 .5 .5" contype="0"/></body>'
    found = simulate(mesh(tmp_path, alone))
    assert found.rest is not None and found.rest.sunk < 1e-3 and rules(found) == set()


def test_a_hull_rubs_on_the_plane_as_the_file_has_it(tmp_path: Path) -> None:
    slippery = '<body><freejoint/><geom type="box" size=".5 .5 .5" friction=".2 .01 .003" condim="4"/></body>'
    found = mesh(tmp_path, slippery)
    model = compile_model(found, JointTree.of(found))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.ncon and {int(contact.dim) for contact in data.contact} == {4}
    np.testing.assert_allclose(data.contact[0].friction, [0.2, 0.2, 0.01, 0.003, 0.003])


@pytest.mark.parametrize(("friction", "slides"), [(1.0, False), (0.05, True)])
def test_a_leaning_plank_slides_where_it_is_slippery(tmp_path: Path, friction: float, slides: bool) -> None:
    leaning = (
        f'<body name="wall" pos="-.9 0 0"><freejoint/><geom type="box" size="1 1 1" mass="5000" friction="{friction}"/>'
        f"</body>"
        f'<body name="plank" pos=".8 0 0" euler="0 -30 0"><freejoint/>'
        f'<geom type="box" size=".05 .5 1.1" friction="{friction}"/></body>'
    )
    found = simulate(mesh(tmp_path, leaning))
    assert found.rest is not None and (found.rest.tilt > 20) == slides


def test_a_made_hull_collides_as_its_parent(tmp_path: Path) -> None:
    before = mesh(tmp_path, BOXES.format('friction=".3" contype="2" conaffinity="0"', ""))
    a, b = before.hulls
    made = Hull("made", a.body, a.shape.move(Pose.of_translation([0, 0, 0.1])), parent=a.name)
    touching = ContactRules(before.with_hulls([made, b, replace(b, name="new", parent=None)]))
    assert touching.contacts[0].friction[0] == 0.3 and touching.contacts[0].contype == 2
    assert not touching.may_touch(0, 1) and touching.may_touch(1, 2)
