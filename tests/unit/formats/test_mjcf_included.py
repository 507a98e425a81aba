"""Edited MJCF where more than the geoms depends on them: files that become empty, folders, flexible bodies, numbers."""

from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats.mjcf import edit
from meshforge.formats.mjcf.document import read_tree
from meshforge.geometry import Box, Pose
from tests.mjcf_engines import model, put, read
from tests.mjcf_models import Pair, compiled, hull, replaced, write

BOX = Box(Pose.of_translation([0.3, -0.2, 0.7]), np.array([0.1, 0.2, 0.3]))
SMALL = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
LARGE = SMALL.replace("0 0 3", "0 0 9")
INCLUDING = '<body name="b"><freejoint/><geom name="g" size=".1"/><include file="c.xml"/></body>'
INCLUDED = '<mujocoinclude>\n  <!-- note -->\n  <geom name="h" type="box" size=".1 .1 .1"/>\n</mujocoinclude>\n'
Files = dict[str, str]


def check(folder: Path, files: Files, removed: list[str], *made: str) -> Path:
    """Write the model without some hulls, with a box in the place of others; MuJoCo finds all else as it was."""
    asset = read(put(folder / "in", dict(files)))
    boxes = [hull(asset, name, BOX) for name in made]
    path, _ = write(replaced(asset, [*removed, *made], *boxes), folder / "out")
    Pair(compiled(asset.path), compiled(path)).assert_same(removed=[*removed, *made], made=boxes)
    assert not read_tree(path).faults
    return path


def test_an_included_file_that_loses_all_it_held_can_still_be_included(tmp_path: Path) -> None:
    path = check(tmp_path, {"main.xml": model(INCLUDING), "c.xml": INCLUDED}, ["b/h"])
    assert (path.parent / "c.xml").read_text() == "<mujocoinclude><frame/>\n  <!-- note -->\n</mujocoinclude>\n"
    again = read(path)
    assert [geom.name for geom in again.geoms] == ["b/g"]
    assert not again.notes


def test_an_include_in_an_include_may_become_empty(tmp_path: Path) -> None:
    middle = '<mujocoinclude><include file="d.xml"/></mujocoinclude>'
    check(tmp_path, {"main.xml": model(INCLUDING), "c.xml": middle, "d.xml": INCLUDED}, ["b/h"])


def test_an_ignored_mass_may_be_all_that_a_file_held(tmp_path: Path) -> None:
    mass = '<mujocoinclude><inertial pos="0 0 0" mass="9" diaginertia="1 1 1"/></mujocoinclude>'
    before = '<compiler inertiafromgeom="true"/>'
    check(tmp_path, {"main.xml": model(INCLUDING, before), "c.xml": mass}, [], "b/g")


@pytest.mark.parametrize("touched", ["nothing", "b/g", "b/h"])
def test_of_several_compilers_each_counts_in_its_turn(touched: str, tmp_path: Path) -> None:
    text = '<compiler meshdir="a"/><compiler assetdir="b"/><asset><mesh name="m" file="m.obj"/></asset>'
    body = '<body name="b"><geom name="g" type="mesh" mesh="m"/><geom name="h" size=".2"/></body>'
    files = {"main.xml": model(body, text), "a/m.obj": SMALL, "b/m.obj": LARGE}
    path = check(tmp_path, files, [], *([] if touched == "nothing" else [touched]))
    assert (path.parent / "b/m.obj").read_text() == LARGE
    assert not (path.parent / "a").exists()


def test_flexible_bodies_are_no_matter_to_an_edit(tmp_path: Path) -> None:
    body = '<body name="c"><freejoint/><geom name="z" size=".2" pos="3 0 0"/><geom name="y" size=".1"/></body>'
    cloth = (
        '<flexcomp name="f" type="grid" count="3 3 1" spacing=".1 .1 .1" radius=".01" mass="1" dim="2" pos="0 0 2">'
        '<edge equality="true"/><pin id="0"/></flexcomp>'
    )
    check(tmp_path, {"main.xml": model(body + cloth)}, ["c/z"])


def test_the_geom_with_most_numbers_of_the_users_may_go(tmp_path: Path) -> None:
    body = '<body name="b"><geom name="g" size=".1" user="1 2 3"/><geom name="h" size=".2" user="4"/>{}</body>'
    asset = read(put(tmp_path / "in", {"main.xml": model(body.format('<geom name="i" size=".3"/>'))}))
    path, _ = write(replaced(asset, ["b/g"]), tmp_path / "out")
    assert compiled(path).geom_user.tolist() == [[4], [0]]


def test_what_mujoco_refuses_of_includes_after_an_edit_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    as_it_is = edit.MjcfEdit.build_texts
    monkeypatch.setattr(edit.MjcfEdit, "build_texts", lambda own: [as_it_is(own)[0], b"<mujocoinclude/>"])
    asset = read(put(tmp_path / "in", {"main.xml": model(INCLUDING), "c.xml": INCLUDED}))
    with pytest.raises(AssetError, match=r"of the edited file: the included file 'c.xml' is empty"):
        write(replaced(asset, ["b/h"]), tmp_path / "out")


def test_pairs_of_geoms_that_are_not_there_do_not_hide_the_rest(tmp_path: Path) -> None:
    body = '<body name="b"><geom name="g" size=".1"/></body>'
    text = model(body).replace("</mujoco>", '<contact><pair geom1="g" geom2="nope"/></contact></mujoco>')
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    assert [geom.name for geom in asset.geoms] == ["b/g"]
    assert "nope" in asset.notes[0]
