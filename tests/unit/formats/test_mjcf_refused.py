"""MJCF that MuJoCo refuses: read for their collision geometry, or one message about the authored line."""

import os
import re
from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import save
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.symbolic import Asset
from tests.mjcf_engines import TETRAHEDRON, model, put, read

SOUND = '<geom name="a" size="1"/><body name="b" pos="1 0 0"><geom type="mesh" mesh="m"/></body>'
MESH = f'<asset><mesh name="m" vertex="{TETRAHEDRON}"/></asset>'
NAMES = ["world/a", "b/geom0"]
FLAT = '<asset><mesh name="flat" vertex="0 0 0 1 0 0 0 1 0 1 1 0" face="0 1 2 1 3 2"/></asset>'

REFUSED = {
    "a colour that is none": (SOUND + '<site rgba="red"/>', MESH, "bad format in attribute 'rgba'"),
    "inertia of no body": (
        SOUND + '<body name="i"><inertial mass="1" pos="0 0 0" diaginertia="1 1 9"/><joint/></body>',
        MESH,
        "inertia must satisfy A + B >= C",
    ),
    "inertia below zero": (
        SOUND + '<body><inertial mass="1" pos="0 0 0" fullinertia="0 0 0 0 0 0"/><joint/></body>',
        MESH,
        "inertia must have positive eigenvalues",
    ),
    "a material without its texture": (SOUND, MESH + '<asset><material name="k" texture="t"/></asset>', "not found in"),
    "an option of an older version": (SOUND, MESH + '<option collision="all"/>', "unrecognized attribute"),
    "a flat visual mesh": (
        '<geom name="f" type="mesh" mesh="flat" contype="0" conaffinity="0"/>' + SOUND,
        MESH + FLAT,
        "mesh volume is too small",
    ),
    "more memory than there is": (SOUND, MESH + '<size memory="900T"/>', "allocate"),
    "a motor for a joint that is not there": (
        SOUND,
        MESH + '<actuator><motor joint="x"/></actuator>',
        "unknown transmission target 'x'",
    ),
}


@pytest.mark.parametrize("why", REFUSED)
def test_what_collisions_do_not_need_is_left_out(why: str, tmp_path: Path) -> None:
    inside, before, message = REFUSED[why]
    asset = read(put(tmp_path, {"main.xml": model(inside, before)}))
    assert [geom.name for geom in asset.geoms] == NAMES
    assert asset.geoms[1].shape.volume == pytest.approx(1)
    (note,) = asset.notes
    assert note.startswith("MuJoCo refuses this file: ") and note.endswith("; read for its collision geometry only")
    assert message in note
    assert isinstance(asset.document, MjcfDocument) and message in asset.document.refusal


def test_the_place_of_the_fault_is_told(tmp_path: Path) -> None:
    text = '<mujoco>\n<worldbody>\n<include file="a.xml"/></worldbody></mujoco>'
    asset = read(put(tmp_path, {"main.xml": text, "a.xml": "<x>\n<geom size='1'/>\n\n<region/></x>"}))
    assert "unrecognized element (element 'region') (a.xml:4); read" in asset.notes[0]


def test_geoms_keep_their_numbers_when_visual_ones_before_them_are_left_out(tmp_path: Path) -> None:
    lost = '<geom type="mesh" mesh="v" contype="0" conaffinity="0"/>'
    before = MESH + '<asset><mesh name="v" file="v.obj"/></asset>'
    inside = f'{lost}<geom size="1"/>{lost}<body name="b">{lost}<geom size="2" mass="3"/></body>'
    asset = read(put(tmp_path, {"main.xml": model(inside, before)}))
    assert [geom.name for geom in asset.geoms] == ["world/geom1", "b/geom1"]
    assert not asset.visuals
    assert asset.mechanism.inertials[0].mass == pytest.approx(3)


def test_the_masses_and_joints_of_a_refused_file_are_kept_where_they_can_be(tmp_path: Path) -> None:
    inertial = '<inertial pos="1 0 0" mass="2" diaginertia="3 4 5"/>'
    inside = f'<region/><body name="b"><joint name="j" range="0 90"/>{inertial}</body>'
    asset = read(put(tmp_path, {"main.xml": model(inside)}))
    (told,) = asset.mechanism.inertials
    assert (told.mass, told.centre.tolist()) == (2, [1, 0, 0])
    assert asset.mechanism.joints[0].limits == pytest.approx((0, 1.5707963))


def test_a_second_fault_behind_the_first_is_told_too(tmp_path: Path) -> None:
    path = put(tmp_path, {"main.xml": model('<region/>\n<geom name="g"/>')})
    with pytest.raises(AssetError) as error:
        read(path)
    assert "unrecognized element" in error.value.problem
    assert error.value.remedy is not None
    first, _, rest = error.value.remedy.partition(": ")
    assert first == "Once that is fixed, the next problem is"
    assert rest.startswith(f"{path}:2: MuJoCo refuses this file: size 0 must")


@pytest.mark.parametrize(
    ("inside", "before", "message"),
    [
        ('<replicate count="101"><replicate count="100"><geom/></replicate></replicate>', "", "<replicate> makes more"),
        ('<flexcomp type="grid" count="1000 1000 2" spacing="1 1 1"/>', "", "this <flexcomp> is too large to be made"),
        ("", '<asset><hfield name="h" nrow="10000" ncol="10000" size="1 1 1 1"/></asset>', 'nrow="10000" ncol="10000"'),
        ("", '<asset><mesh name="m" builtin="supertorus" params="99999 1 1 1"/></asset>', "this <mesh> is too large"),
        ("", '<asset><texture name="t" builtin="flat" width="90000" height="90000"/></asset>', "this <texture> is too"),
        ("", '<asset><hfield name="h" nrow="inf" ncol="2" size="1 1 1 1"/></asset>', "this <hfield> is too large"),
    ],
)  # fmt: skip
def test_numbers_that_would_crash_mujoco_are_refused(inside: str, before: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(AssetError, match=re.escape(message)):
        read(put(tmp_path, {"main.xml": model(inside, before)}))


def test_nothing_is_printed_or_written_where_one_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    path = put(tmp_path / "assets", {"main.xml": model('<body name="b" pos="nan 0 0"/><geom size="1"/>')})
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    with pytest.raises(AssetError, match="not of finite numbers"):
        read(path)
    assert not os.listdir(tmp_path / "here") and os.listdir(tmp_path / "assets") == ["main.xml"]  # noqa: PTH208
    assert capfd.readouterr() == ("", "")


def test_settings_of_mujoco_are_as_before_after_a_reading(tmp_path: Path) -> None:
    import mujoco

    heard: list[str] = []
    mujoco.set_mju_user_warning(heard.append)
    before = mujoco.MjLogConfig.get().logto_file
    try:
        asset: Asset = read(put(tmp_path, {"main.xml": model('<geom size="1" friction="nan"/>')}))
        assert asset.notes == ("MuJoCo warns: XML contains a 'NaN'. Please check it carefully.",)
        assert not heard and mujoco.MjLogConfig.get().logto_file == before
        mujoco.MjSpec.from_string(model('<geom size="1" friction="nan"/>'))
        assert heard
    finally:
        mujoco.set_mju_user_warning(None)


BODY = """<worldbody><body name="top">
<geom class="t" size=".5 .3 .02"/><geom pos="2 0 0" size=".1 .1 .1"/></body></worldbody>"""


@pytest.mark.parametrize(
    ("defaults", "kinds", "groups"),
    [
        ('<default><geom condim="1"/></default><default class="t"><geom type="box"/></default>', "box sphere", "0 0"),
        ('<default class="t"><geom type="box"/></default>', "box box", "0 0"),
        ('<default class="t"><geom type="box"/><default class="u"/></default>', "box box", "0 0"),
        (
            '<default><default class="t"><geom type="box"/></default></default>'
            '<default><default class="t"><geom group="4"/></default></default>',
            "box sphere",
            "4 0",
        ),
        (
            '<default><geom type="box"/></default><default class="t"/><default class="t"><geom group="4"/></default>',
            "box box",
            "4 0",
        ),
        ('<default><default><geom group="1"/></default><default class="t"/></default>', "sphere sphere", "0 0"),
    ],
)
def test_defaults_only_older_versions_take_are_read(tmp_path: Path, defaults: str, kinds: str, groups: str) -> None:
    path = tmp_path / "a.xml"
    path.write_text(f"<mujoco>{defaults}{BODY}</mujoco>")
    asset = read(path)
    assert " ".join(geom.shape.kind for geom in asset.geoms) == kinds
    assert " ".join(dict(geom.contact)["group"] for geom in asset.geoms) == groups
    (note,) = [note for note in asset.notes if "MuJoCo refuses this file" in note]
    assert "class" in note and note.endswith("read for its collision geometry only")
    after = read(save(asset.with_geoms(asset.geoms[:1]), tmp_path / "out" / "a.xml").path)
    assert [geom.shape.kind for geom in after.geoms] == [asset.geoms[0].shape.kind]
