"""Pairs of bodies that reach into each other are proposed, and those that a person confirms collide no more."""

from pathlib import Path
from tempfile import mkdtemp

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pxr import Usd, UsdPhysics

from meshforge.checks.base import CheckSubject
from meshforge.checks.physics.overlaps import DEEP
from meshforge.checks.physics.pairs import PairsCheck, exclude_pairs, propose_pairs
from meshforge.formats import load, save
from meshforge.formats.xml import parse_xml
from tests.mjcf_engines import put
from tests.unit.cli.in_process import Run

CABINET = """<mujoco>
  <worldbody>
    <body name="carcass">
      <geom name="floor" type="box" size=".2 .2 .01" pos="0 0 -.01"/>
      <body name="drawer">
        <joint name="slide" type="slide" axis="1 0 0" range="0 .2" limited="true"/>
        <geom name="bottom" type="box" size=".15 .15 .01" pos="0 0 .003"/>
      </body>
      <body name="door" pos=".21 -.2 .2">
        <joint name="hinge" type="hinge" axis="0 0 -1" range="0 90" limited="true"/>
        <geom name="leaf" type="box" size=".01 .2 .2" pos="0 .2 0"/>
      </body>
    </body>
  </worldbody>
  <contact>
    <!-- authored -->
    <exclude body1="world" body2="door"/>
  </contact>
</mujoco>
"""


@pytest.fixture
def cabinet(tmp_path: Path) -> Path:
    put(tmp_path, {"cabinet.xml": CABINET})
    return tmp_path / "cabinet.xml"


def contacts(path: Path) -> set[tuple[str, str]]:
    """Pairs of bodies that MuJoCo finds deep in each other, at rest or anywhere on the way of a joint."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data, found = mujoco.MjData(model), set[tuple[str, str]]()
    for joint in range(model.njnt):
        low, high = model.jnt_range[joint].tolist()
        for at in np.linspace(low, high, 40):
            data.qpos[:] = 0
            data.qpos[joint] = at
            mujoco.mj_fwdPosition(model, data)
            for contact in data.contact[: data.ncon]:
                names = sorted(model.body(int(model.geom_bodyid[geom])).name for geom in contact.geom)
                found |= {(names[0], names[1])} if contact.dist < -DEEP * load(path).diagonal else set()
    return found


def test_what_reaches_into_each_other_is_proposed_drawn_and_excluded_by_name(cabinet: Path, run: Run) -> None:
    told = run("check", "cabinet.xml", "--pairs", "--pictures", "drawn")
    assert told.code == 0 and "2 pairs of bodies could be excluded from contact" in told.out
    assert "carcass:drawer at rest, carcass/floor is 7.0 mm in drawer/bottom\n" in told.out
    assert (
        "drawer:door as slide moves, pulled out by" in told.out and "not in `all`: they are no neighbours" in told.out
    )
    assert sorted(path.name for path in Path("drawn").iterdir()) == [f"cabinet.xml.pairs-{k}.png" for k in (1, 2)]
    assert contacts(cabinet) == {("carcass", "drawer"), ("door", "drawer")}
    done = run("check", "cabinet.xml", "--fix", "--exclude", "all", "--exclude", "door:drawer", "--out", "fixed")
    assert done.code == 0 and "fixed: carcass:drawer do not touch any more" in done.out
    lines = '    <exclude body1="carcass" body2="drawer"/>\n    <exclude body1="door" body2="drawer"/>\n'
    assert Path("fixed/cabinet.xml").read_text() == CABINET.replace("  </contact>", f"{lines}  </contact>")
    assert contacts(Path("fixed/cabinet.xml")) == set()
    again = run("check", "fixed/cabinet.xml", "--pairs")
    assert "no bodies reach into each other, at rest or as joints move" in again.out


def test_pairs_go_along_into_formats_that_have_them_and_are_named_by_the_rest(cabinet: Path, run: Run) -> None:
    assert run("convert", "cabinet.xml", "one/c.urdf", "--exclude", "drawer:door").code == 0
    (pair,) = parse_xml(Path("one/c.srdf").read_bytes(), "").each("disable_collisions")
    assert pair.attributes == {"link1": "drawer", "link2": "door", "reason": "User"}
    Path("one/c.srdf").write_text(
        '<robot name="c">\n  <group name="arm"/>\n  <disable_collisions link1="door" link2="drawer"/>\n</robot>'
    )
    assert (
        run("convert", "one/c.urdf", "two/d.urdf", "--exclude", "carcass:drawer", "--exclude", "drawer:carcass").code
        == 0
    )
    text = Path("two/d.srdf").read_text()
    assert '<group name="arm"/>' in text and text.count("<disable_collisions") == 2
    assert run("convert", "two/d.urdf", "three/e.urdf").code == 0 and Path("three/e.srdf").read_text() == text
    assert run("convert", "three/e.urdf", "four/e.usda", "--exclude", "carcass:door").code == 0
    stage = Usd.Stage.Open("four/e.usda")
    targets = [UsdPhysics.FilteredPairsAPI(prim).GetFilteredPairsRel().GetTargets() for prim in stage.Traverse()]
    assert sorted(str(path) for some in targets for path in some) == ["/e/carcass", "/e/door", "/e/drawer"]
    back = run("convert", "four/e.usda", "five/e.xml")
    assert back.code == 0 and "3 excluded pairs" in back.err
    model = mujoco.MjModel.from_xml_path("five/e.xml")
    assert model.nexclude == 3
    lost = run("convert", "two/d.urdf", "six/d.sdf")
    assert "2 excluded pairs (door:drawer, drawer:carcass) are left out" in lost.err
    refused = run("convert", "cabinet.xml", "c.sdf", "--exclude", "drawer:door")
    assert (
        refused.code == 2
        and "SDF has no pairs of bodies that do not touch" in refused.err
        and not Path("c.sdf").exists()
    )


@pytest.mark.parametrize(
    ("pair", "said"), [("drawr:door", "'drawr'"), ("drawer", "needs two"), ("door:door", "needs two")]
)
def test_a_pair_that_cannot_be_is_one_error_and_writes_nothing(cabinet: Path, run: Run, pair: str, said: str) -> None:
    refused = run("convert", "cabinet.xml", "out.xml", "--exclude", pair)
    assert refused.code == 2 and said in refused.err and not Path("out.xml").exists()


def test_a_body_without_a_name_in_the_file_gets_one(tmp_path: Path, run: Run) -> None:
    put(tmp_path, {"c.xml": CABINET.replace(' name="drawer"', "")})
    (name,) = {hull.body for hull in load(tmp_path / "c.xml")} - {"carcass", "door"}
    assert run("convert", "c.xml", "out.xml", "--exclude", f"carcass:{name}").code == 0
    assert contacts(Path("out.xml")) == {(name, "door")}


def test_a_drawer_that_its_carcass_fills_is_proposed_with_a_doubt_that_all_leaves_out(tmp_path: Path, run: Run) -> None:
    put(tmp_path, {"c.xml": CABINET.replace('pos="0 0 .003"', 'pos="0 0 -.01"')})
    told = run("check", "c.xml", "--pairs")
    assert "not in `all`: `--physics` finds an error in it" in told.out
    assert exclude_pairs(load(tmp_path / "c.xml"), ["all"])[1] == ()


def test_what_cannot_be_simulated_is_one_message(cabinet: Path, monkeypatch: pytest.MonkeyPatch, run: Run) -> None:
    monkeypatch.setattr("meshforge.checks.physics.pairs.BODIES", 2)
    (note,) = PairsCheck().measure(CheckSubject(load(cabinet))).notes
    assert note == "no pairs are proposed: it has more than 1,000 hulls or 2 bodies"
    refused = run("convert", "cabinet.xml", "out.xml", "--exclude", "all")
    assert refused.code == 2 and "--exclude BODY:BODY" in refused.err and not Path("out.xml").exists()


@given(st.lists(st.tuples(st.floats(-0.15, 0.15), st.floats(0.02, 0.2)), min_size=2, max_size=3), st.data())
@settings(max_examples=10)
def test_when_all_proposals_are_confirmed_nothing_is_left_and_no_other_pair_is_touched(
    rows: list[tuple[float, float]], data: st.DataObject
) -> None:
    folder = Path(mkdtemp())
    body = '<body name="b{}" pos="{} 0 {}"><joint type="slide" axis="{}" range="0 .1" limited="true"/>{}</body>'
    box, ways = '<geom type="box" size="{} .05 .02"/>', st.sampled_from(["1 0 0", "0 0 1"])
    bodies = [body.format(k, at, 0.03 * k, data.draw(ways), box.format(half)) for k, (at, half) in enumerate(rows)]
    base = f'<body name="base"><geom type="box" size=".1 .1 .01"/>{"".join(bodies)}</body>'
    put(folder, {"c.xml": f"<mujoco><worldbody>{base}</worldbody></mujoco>"})
    mesh = load(folder / "c.xml")
    proposed = {pair.bodies for pair in propose_pairs(mesh)}
    ready, _ = exclude_pairs(mesh, [":".join(pair) for pair in proposed])
    written = save(ready, folder / "out" / "c.xml").path
    assert contacts(written) == set()
    again = load(written).asset
    assert again and {frozenset(pair) for pair in again.mechanism.apart} == {frozenset(pair) for pair in proposed}
