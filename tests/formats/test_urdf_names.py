"""Names that MeshForge makes up do not repeat in a URDF: MuJoCo wants names unique in the file."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from lxml import etree

from meshforge.formats import read, save
from meshforge.geometry import Box, Pose
from meshforge.symbolic import Geom

BODY = """<body name="{0}" pos="0 0 {1}"><geom type="box" size=".1 .1 .1" mass="1" contype="0" conaffinity="0"/>
<geom type="box" size=".1 .1 .1" mass="1"/>{2}</body>"""


def tower(folder: Path, names: str) -> Path:
    """An MJCF of bodies in each other, each with a geom to look at and one that collides, both without a name."""
    inside = ""
    for name in reversed(names):
        inside = BODY.format(name, 1, inside and f'{inside}<joint name="j{name}"/>')
    path = folder / "tower.xml"
    path.write_text(f"<mujoco><worldbody>{inside}</worldbody></mujoco>")
    return path


def warned(path: Path) -> list[str]:
    """What MuJoCo says about names as it loads a file."""
    said: list[str] = []
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(said.append)
    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    finally:
        mujoco.set_mju_user_warning(before)
    assert model.ngeom
    return [text for text in said if "duplicate" in text]


def written(path: Path) -> list[str]:
    return [name for e in etree.parse(path).iter("collision") if (name := e.get("name"))]


@pytest.mark.parametrize("source", ["mjcf", "sdf", "usd"])
def test_made_up_names_do_not_repeat_from_link_to_link(tmp_path: Path, source: str) -> None:
    path = tower(tmp_path, "abc")
    if source != "mjcf":
        path = save(read(path), tmp_path / "mid" / ("t.sdf" if source == "sdf" else "t.usda")).path
    saved = save(read(path), tmp_path / "out" / "t.urdf")
    assert len(set(written(saved.path))) == len(written(saved.path))
    assert warned(saved.path) == []
    after = {geom.name for geom in read(saved.path).geoms}
    assert after == {saved.names.get(geom.name, geom.name) for geom in read(path).geoms}


LINK = '<link name="{}">{}{}</link>'
COLLISION = "<collision{}><geometry><box size='1 1 {}'/></geometry></collision>"


def test_an_edit_does_not_repeat_a_made_up_name_and_keeps_those_of_the_author(tmp_path: Path) -> None:
    links = "".join(LINK.format(n, COLLISION.format("", 1), COLLISION.format("", 2)) for n in "abc")
    named = LINK.format("d", COLLISION.format(' name="pin"', 1), COLLISION.format(' name="geom1"', 2))
    joints = "".join(f'<joint name="j{n}" type="fixed"><parent link="a"/><child link="{n}"/></joint>' for n in "bcd")
    path = tmp_path / "a.urdf"
    path.write_text(f'<robot name="r">{links}{named}{joints}</robot>')
    asset = read(path)
    kept = [geom for geom in asset.geoms if geom.name.endswith("geom1") or geom.body == "d"]
    made = [Geom(f"{n}/geom0~1", n, Box(Pose.identity(), np.ones(3)), parent=f"{n}/geom0") for n in "abc"]
    saved = save(asset.with_geoms([*kept, *made]), tmp_path / "out" / "a.urdf")
    names = written(saved.path)
    assert len(set(names)) == len(names) and {"pin", "geom1"} <= set(names)
    assert warned(saved.path) == []
    after = {geom.name for geom in read(saved.path).geoms}
    assert after == {saved.names.get(geom.name, geom.name) for geom in (*kept, *made)} and len(after) == 8
