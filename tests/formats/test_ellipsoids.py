"""An ellipsoid that an edit makes is written as one in the formats that have it, and read as one by MuJoCo."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from lxml import etree

from meshforge.formats import read, save
from meshforge.geometry import Ellipsoid, Floats, Pose
from meshforge.symbolic import Asset, Geom

PLACE = Pose([[0, 0, 1], [1, 0, 0], [0, 1, 0]], [0.1, 0.2, 0.3])
RADII = np.array([0.1, 0.2, 0.3])
MJCF = '<mujoco><worldbody><body name="b"><geom name="g" type="box" size="1 1 1"/></body></worldbody></mujoco>'
SDF = """<sdf version="{}"><model name="m"><link name="b"><collision name="g"><geometry><box><size>1 1 1</size></box>
</geometry></collision></link></model></sdf>"""


def edited(path: Path, text: str) -> Asset:
    """An asset whose one box is an ellipsoid now."""
    path.write_text(text)
    asset = read(path)
    return asset.with_geoms([Geom("b/g~1", "b", Ellipsoid(PLACE, RADII), parent="b/g")])


def engine_ellipsoid(path: Path) -> tuple[Floats, Floats]:
    """Radii and centre of the one ellipsoid that MuJoCo finds."""
    model = mujoco.MjModel.from_xml_path(str(path))
    assert [int(kind) for kind in model.geom_type] == [mujoco.mjtGeom.mjGEOM_ELLIPSOID]
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    np.testing.assert_allclose(np.abs(data.geom_xmat[0].reshape(3, 3)), np.abs(PLACE.rotation), atol=1e-12)
    return model.geom_size[0], data.geom_xpos[0]


@pytest.mark.parametrize("source", ["edit", "convert"])
def test_mujoco_finds_an_ellipsoid(tmp_path: Path, source: str) -> None:
    asset = edited(tmp_path / "a.xml", MJCF) if source == "edit" else edited(tmp_path / "a.sdf", SDF.format("1.9"))
    saved = save(asset, tmp_path / "out" / "a.xml")
    radii, centre = engine_ellipsoid(saved.path)
    np.testing.assert_allclose(radii, RADII)
    np.testing.assert_allclose(centre, PLACE.translation)
    assert not any("written as" in note for note in saved.notes) and not list(tmp_path.glob("out/*.obj"))


@pytest.mark.parametrize("source", ["edit", "convert"])
def test_an_sdf_has_an_ellipsoid_from_1_8_on(tmp_path: Path, source: str) -> None:
    asset = edited(tmp_path / "a.sdf", SDF.format("1.8")) if source == "edit" else edited(tmp_path / "a.xml", MJCF)
    saved = save(asset, tmp_path / "out" / "a.sdf")
    (found,) = etree.parse(saved.path).getroot().findall(".//collision/geometry/ellipsoid/radii")
    assert [float(word) for word in str(found.text).split()] == RADII.tolist()
    (geom,) = read(saved.path).geoms
    assert isinstance(geom.shape, Ellipsoid)
    np.testing.assert_allclose(geom.shape.pose.translation, PLACE.translation, atol=1e-12)


def test_an_older_sdf_and_a_urdf_get_a_hull_and_a_note(tmp_path: Path) -> None:
    older = save(edited(tmp_path / "a.sdf", SDF.format("1.7")), tmp_path / "out" / "a.sdf")
    assert any("ellipsoid" in note and "hull" in note for note in older.notes)
    urdf = save(edited(tmp_path / "a.xml", MJCF), tmp_path / "out" / "a.urdf")
    assert any("1 ellipsoid" in note and "written as triangles" in note for note in urdf.notes)
