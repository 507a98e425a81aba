"""Capsules in a URDF: `<capsule>` where the file has one or it is asked for, else a hull and a note that says how."""

from __future__ import annotations

import warnings
from pathlib import Path

import mujoco
import numpy as np
import pybullet
import pytest
import yourdfpy
from lxml import etree

from meshforge.formats import read, save
from meshforge.geometry import Capsule, Pose
from meshforge.project import Project
from meshforge.symbolic import Asset, Geom
from tests.conversion_samples import SAMPLES
from tests.loop.command import meshforge_here as meshforge

BOX = "<collision><geometry><box size='1 1 1'/></geometry></collision>"
PILL = "<collision name='pill'><geometry><capsule radius='.1' length='.6'/></geometry></collision>"
ROBOT = """<robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>{}</link></robot>"""
READERS = ("--urdf-capsules", "MuJoCo 4", "Bullet", "yourdfpy 0.0.60")
PLACE = Pose([[0, 0, 1], [1, 0, 0], [0, 1, 0]], [0.1, 0.2, 0.3])


def edited(folder: Path, inside: str) -> Asset:
    """A URDF with a capsule that an edit made."""
    path = folder / "a.urdf"
    path.write_text(ROBOT.format(inside))
    asset = read(path)
    made = Geom("base/geom0~1", "base", Capsule(PLACE, 0.2, 0.5), parent=asset.geoms[0].name)
    return asset.with_geoms([*asset.geoms, made])


def capsules(path: Path) -> list[dict[str, str]]:
    return [{str(k): str(v) for k, v in e.attrib.items()} for e in etree.parse(path).iter("capsule")]


def test_without_the_flag_a_hull_stands_for_it_and_the_note_says_how(tmp_path: Path) -> None:
    saved = save(edited(tmp_path, BOX), tmp_path / "out" / "a.urdf")
    assert capsules(saved.path) == []
    (note,) = [note for note in saved.notes if "geom0~1" in note]
    assert all(word in note for word in READERS) and "written as a hull" in note
    assert yourdfpy.URDF.load(str(saved.path)).link_map["base"]


@pytest.mark.parametrize(("inside", "asked"), [(BOX, True), (PILL, False)])
def test_it_is_native_where_asked_for_or_where_the_file_has_one(tmp_path: Path, inside: str, asked: bool) -> None:
    saved = save(edited(tmp_path, inside), tmp_path / "out" / "a.urdf", urdf_capsules=asked)
    assert {"radius": "0.2", "length": "1"} in capsules(saved.path)
    assert not any("hull" in note for note in saved.notes)
    model = mujoco.MjModel.from_xml_path(str(saved.path))
    (geom,) = [k for k in range(model.ngeom) if model.geom_type[k] == mujoco.mjtGeom.mjGEOM_CAPSULE][-1:]
    np.testing.assert_allclose(model.geom_size[geom, :2], [0.2, 0.5])
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(saved.path), physicsClientId=client)
        shapes = pybullet.getCollisionShapeData(body, -1, physicsClientId=client)
    finally:
        pybullet.disconnect(client)
    (pill,) = [s for s in shapes if s[2] == pybullet.GEOM_CAPSULE][-1:]
    np.testing.assert_allclose(pill[3][:2], [1.0, 0.2])
    after = next(geom.shape for geom in read(saved.path).geoms if geom.name == "base/geom0~1")
    assert isinstance(after, Capsule) and np.allclose(after.pose.translation, PLACE.translation)


def test_yourdfpy_refuses_it_as_the_note_says(tmp_path: Path) -> None:
    saved = save(edited(tmp_path, BOX), tmp_path / "out" / "a.urdf", urdf_capsules=True)
    with warnings.catch_warnings(), pytest.raises(ValueError, match="Unknown tag"):
        warnings.simplefilter("ignore")
        yourdfpy.URDF.load(str(saved.path))


def test_a_conversion_has_the_flag_and_its_report_says_how(tmp_path: Path) -> None:
    save(SAMPLES["primitives"](), tmp_path / "a.xml")
    told = meshforge("convert", "a.xml", "hulls/a.urdf", cwd=tmp_path)
    assert all(word in told.err for word in READERS) and capsules(tmp_path / "hulls" / "a.urdf") == []
    told = meshforge("convert", "a.xml", "native/a.urdf", "--urdf-capsules", cwd=tmp_path)
    assert len(capsules(tmp_path / "native" / "a.urdf")) == 1 and "--urdf-capsules" not in told.err
    assert "1 capsule" in told.err
    told = meshforge("convert", "a.xml", "many", "--to", ".urdf", "--urdf-capsules", cwd=tmp_path)
    assert told.code == 0 and len(capsules(tmp_path / "many" / "a.urdf")) == 1


PROGRAM = "labels bar\n\nAll => Replace(capsule, native)\n"


def test_apply_has_the_flag_and_a_project_the_setting(tmp_path: Path) -> None:
    (tmp_path / "a.urdf").write_text(ROBOT.format(BOX))
    (tmp_path / "p.mf").write_text(PROGRAM)
    assert meshforge("apply", "p.mf", "a.urdf", "--out", "hulls", cwd=tmp_path).code == 0
    assert capsules(tmp_path / "hulls" / "a.urdf") == []
    assert meshforge("apply", "p.mf", "a.urdf", "--out", "native", "--urdf-capsules", cwd=tmp_path).code == 0
    assert len(capsules(tmp_path / "native" / "a.urdf")) == 1
    meshforge("new", "project", "a.urdf", "--vocabulary", "bar", cwd=tmp_path)
    (tmp_path / "project" / "program.mf").write_text(PROGRAM)
    settings = tmp_path / "project" / "meshforge.toml"
    settings.write_text(f"urdf_capsules = true\n{settings.read_text()}")
    assert meshforge("apply", "project", "--accept-outliers", cwd=tmp_path).code == 0
    (out,) = (tmp_path / "project" / "edited").rglob("*.urdf")
    assert len(capsules(out)) == 1
    out.unlink()
    list(Project.open(tmp_path / "project").apply())
    assert len(capsules(out)) == 1
