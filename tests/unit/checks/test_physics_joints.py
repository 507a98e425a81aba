"""What is wrong at rest and in motion: overlaps, blocked joints, bodies that come off, loose pieces."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.checks.physics.simulation import simulate
from meshforge.geometry import Pose, Shape
from meshforge.symbolic import Joint, JointKind, NonConvexPiece, SymbolicMesh
from tests.cups import cup, surface
from tests.mjcf_engines import asset
from tests.unit.cli.in_process import Run
from tests.unit.language.scenes import box

CARCASS = box([0, 0, 0], [1, 1, 1])
LEAF = box([1.01, 0, 0], [1.05, 1, 1])


def joint(
    kind: JointKind, limits: tuple[float, float] | None, axis: str = "x", at: tuple[float, ...] = (0, 0, 0)
) -> Joint:
    return Joint("j", kind, "one", "two", np.array(at, float), np.eye(3)["xyz".index(axis)], limits)


def pair(*hulls: Shape, joints: list[Joint] | None = None, first: int = 1) -> SymbolicMesh:
    """The first hulls are of the body `one`, the last one of `two`."""
    bodies = ["one"] * first + ["two"] * (len(hulls) - first)
    return cup(*hulls, bodies=bodies, joints=joints or [], shown=())


def found(mesh: SymbolicMesh) -> dict[str, tuple[str, tuple[str, ...]]]:
    return {finding.rule: (finding.severity, finding.hulls) for finding in simulate(mesh).findings}


def test_a_drawer_in_a_solid_carcass_is_an_error_and_in_a_hollow_one_none(run: Run) -> None:
    drawer, slide = box([0.25, 0.25, 0.25], [0.75, 0.75, 0.75]), joint("prismatic", (0, 0.5))
    assert found(pair(CARCASS, drawer, joints=[slide])) == {"physics-overlap": ("error", ("h0", "h1"))}
    sides = [box([0, 0, 0], [1, 1, 0.2]), box([0, 0, 0.8], [1, 1, 1]), box([0, 0, 0.2], [0.2, 1, 0.8])]
    assert found(pair(*sides, drawer, joints=[slide], first=3)) == {}
    link = '<link name="{}"><collision><geometry><box size="{}"/></geometry></collision></link>'
    ends = '<parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="0" upper=".4" effort="1" velocity="1"/>'
    text = link.format("a", "1 1 1") + link.format("b", ".5 .5 .5") + f'<joint name="j" type="prismatic">{ends}</joint>'
    Path("desk.urdf").write_text(f'<robot name="r">{text}</robot>')
    told = run("check", "desk.urdf", "--physics")
    assert told.code == 1 and "overlap at rest: a/geom0 and b/geom0 (750.0 mm, joined)" in told.out


@pytest.mark.parametrize(
    ("axis", "depth", "severity"), [("z", 0.1, None), ("x", 0.02, "warning"), ("x", 0.1, "error"), (None, 0.1, "error")]
)
def test_neighbours_may_overlap_at_an_axis_and_a_little(axis: str | None, depth: float, severity: str | None) -> None:
    """A long leaf that hangs on the edge of a board: about a pin in the edge, or in a groove; or on nothing."""
    leaf = box([1 - depth, 0, 0], [2, 0.2, 0.2])
    joints = [joint("revolute" if axis == "z" else "prismatic", (0, 0.001), axis, (1, 0.1, 0))] if axis else []
    told = found(pair(box([0, 0, 0], [1, 0.2, 0.2]), leaf, joints=joints))
    assert told.get("physics-overlap", (None, ()))[0] == severity


@pytest.mark.parametrize(
    ("low", "high", "wall", "severity"),
    [(0, 90, None, None), (0, 90, 45, "error"), (0, 90, 87, "warning"), (0, 40, 60, None)],
)
def test_a_door_must_come_through_its_range(low: int, high: int, wall: int | None, severity: str | None) -> None:
    """A door on the front of a cabinet, hinged at its right edge, and a post of the cabinet on its way."""
    door = box([0, -0.06, 0], [1, -0.02, 1])
    turn = Pose.from_rpy((0, 0, 0), (0, 0, np.radians(-(wall or 0))))
    post = box([0.55, -0.05, 0.4], [0.65, -0.03, 0.6]).move(turn)
    hinge = joint("revolute", (np.radians(-high), np.radians(-low)), "z", (0, -0.04, 0))
    mesh = pair(CARCASS, *([post] if wall is not None else []), door, joints=[hinge], first=1 + (wall is not None))
    told = found(mesh)
    assert told.get("physics-motion", (None, ()))[0] == severity
    if severity == "error":
        assert set(told["physics-motion"][1]) == {"h1", "h2"}


def test_what_the_file_keeps_apart_is_never_in_the_way(tmp_path: Path) -> None:
    inside = (
        '<body name="one"><freejoint/><geom size=".5 .5 .05" type="box"/>'
        '<geom pos=".4 0 .2" size=".05 .05 .15" type="box"/>'
        '<body name="two"><joint type="slide" axis="1 0 0" range="0 .4" limited="true"/>'
        '<geom pos="0 0 .2" size=".1 .1 .1" type="box"/></body></body>'
    )
    exclude = '<contact><exclude body1="one" body2="two"/></contact>'
    told = [found(SymbolicMesh.of(asset(tmp_path, inside, more))) for more in ("", exclude)]
    assert ["physics-motion" in one for one in told] == [True, False]
    assert told[0]["physics-motion"][0] == "error"


SLIDES = {
    "urdf": """<robot name="r"><link name="a"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
<link name="b"><collision><origin xyz="3 0 0"/><geometry><box size="1 1 1"/></geometry></collision></link>
<joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/>
<limit lower="LOW" upper="HIGH" effort="1" velocity="1"/></joint></robot>""",
    "sdf": """<sdf version="1.7"><model name="m">
<link name="a"><collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision></link>
<link name="b"><pose>3 0 0 0 0 0</pose><collision name="c"><geometry><box><size>1 1 1</size></box></geometry>
</collision></link><joint name="j" type="prismatic"><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>
<limit><lower>LOW</lower><upper>HIGH</upper></limit></axis></joint></model></sdf>""",
}


@pytest.mark.parametrize("limits", ["0.4 0", "0 0", "-0.1 0.4"])
@pytest.mark.parametrize("form", SLIDES)
def test_limits_that_are_empty_or_reversed_are_an_error(form: str, limits: str, run: Run) -> None:
    low, high = limits.split()
    Path(f"desk.{form}").write_text(SLIDES[form].replace("LOW", low).replace("HIGH", high))
    told, wrong = run("check", f"desk.{form}", "--physics"), float(low) >= float(high)
    said = f"joints whose limits leave them no way to go, which engines take for none: j ({low} to {high})"
    assert told.code == wrong and (said in told.out) is wrong


def test_a_handle_that_no_joint_holds_comes_off() -> None:
    handle = box([1.0, 0.4, 0.6], [1.1, 0.6, 0.7])
    assert found(pair(CARCASS, handle))["physics-apart"][0] == "error"
    assert found(pair(CARCASS, handle, joints=[joint("fixed", None)])) == {}
    assert found(pair(CARCASS, box([0.4, 0.4, 1.0], [0.6, 0.6, 1.1]))) == {}  # a lid lies where it is


@given(st.floats(0.0, 0.5))
def test_a_piece_that_touches_nothing_is_found_whatever_the_gap(gap: float) -> None:
    mesh = cup(CARCASS, box([1 + gap, 0, 0], [1.3 + gap, 1, 1]), shown=())
    share = gap / mesh.diagonal
    severity = None if share <= 0.0199 else "warning" if 0.0201 < share < 0.0499 else "error" if share > 0.0501 else "?"
    told = found(mesh).get("physics-loose", (None, ()))[0]
    assert severity in (told, "?")


def test_a_piece_floats_beside_an_opaque_one_too_and_not_where_that_is_between() -> None:
    for wide, loose in ((0.3, True), (2.0, False)):
        mesh = cup(CARCASS, box([1.6, 0, 0], [1.9, 1, 1]), shown=())
        assert mesh.asset
        piece = NonConvexPiece("arch", "cup", "not convex", surface([box([1, 0, 0], [1 + wide, 1, 0.2])]))
        mesh = replace(mesh, asset=replace(mesh.asset, non_convex=(piece,)))
        assert found(mesh).get("physics-loose") == (("error", ("h1",)) if loose else None)


def test_strict_counts_warnings_and_without_it_only_errors_do(run: Run) -> None:
    block = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
    faces = "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
    Path("cup.obj").write_text(block + faces)
    shown = '<visual><geometry><mesh filename="open.obj"/></geometry></visual>'
    solid = '<collision><geometry><mesh filename="cup.obj"/></geometry></collision>'
    Path("open.obj").write_text(block + faces.replace("f 2 6 8 4\n", ""))  # a box without its top
    Path("cup.urdf").write_text(f'<robot name="r"><link name="a">{shown}{solid}</link></robot>')
    codes = [run("check", "cup.urdf", "--clearance", *more).code for more in ((), ("--strict",))]
    assert codes == [0, 1] and run("check", "cup.urdf", "--strict").code == 0
