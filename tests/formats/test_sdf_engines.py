"""SDFs as engines read them: the same shapes in the same places, before an edit and after."""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from meshforge.formats import read, save
from meshforge.geometry import Box
from meshforge.symbolic import PRIMITIVE_FEATURES, Asset
from tests.asset_bounds import bounds_of
from tests.corpus_case import ROOT
from tests.corpus_path import corpus
from tests.loads.comparing import differences, shapes_of
from tests.loads.readers import READERS
from tests.urdf_sample import ball_within, exchange_hulls

CORPUS = [
    "tables_desks/osrf-gazebo_models/table/model.sdf",
    "tables_desks/drake-models-manipulation_station/amazon_table_simplified.sdf",
    "tables_desks/drake-models-manipulation_station/bin.sdf",
    "tables_desks/pybullet-planning/drake/table/extra_heavy_duty_table.sdf",
    "doors_cabinets/drake-models-manipulation_station/cupboard.sdf",
    "doors_cabinets/osrf-gazebo_models/cabinet/model.sdf",
    "scenes_robots/tmc_wrs_gazebo/wrc_tray/model.sdf",
    "scenes_robots/tmc_wrs_gazebo/wrc_frame/model.sdf",
    "scenes_robots/tmc_wrs_gazebo/wrc_container_a/model.sdf",
]
FRAMES = ["nested", "placement_frame", "pose_quaternion", "pose_in_degrees", "pose_empty"]
BULLET = [name for name in CORPUS if not name.startswith(("scenes_robots", "doors_cabinets/drake"))]
"""Those that PyBullet reads: it wants every inertia, and takes no joint with a pose of its own."""


def bullet(path: Path) -> dict[str, Any]:
    """The number of collision shapes, and the boxes around links with all shapes in them, as PyBullet reads a file."""
    import pybullet

    client = pybullet.connect(pybullet.DIRECT)
    try:
        at = {"physicsClientId": client}
        bodies = pybullet.loadSDF(str(path), **at)
        pairs = [(body, k) for body in bodies for k in range(-1, pybullet.getNumJoints(body, **at))]
        return {
            "shapes": sum(len(pybullet.getCollisionShapeData(body, k, **at)) for body, k in pairs),
            "masses": sorted(pybullet.getDynamicsInfo(body, k, **at)[0] for body, k in pairs),
            "bounds": [pybullet.getAABB(body, k, **at) for body, k in pairs],
        }
    finally:
        pybullet.disconnect(client)


def assert_drake_agrees(asset: Asset, path: Path) -> int:
    """Drake has each hull of an asset in its place, native where it is; how many there are. Skips without Drake."""
    pytest.importorskip("pydrake", reason="drake is not installed (pip install drake)")
    seen, wanted = list(READERS["drake"].shapes(path)), shapes_of(asset)
    assert differences(wanted, seen, READERS["drake"], ".sdf") == []
    kinds = [sorted(one.kind for one in shapes if one.kind in PRIMITIVE_FEATURES) for shapes in (wanted, seen)]
    assert kinds[0] == kinds[1]
    return len(seen)


@pytest.mark.parametrize("name", BULLET)
def test_pybullet_has_as_many_shapes_within_the_same_bounds(name: str, tmp_path: Path) -> None:
    asset = read(corpus(*name.split("/")))
    saved = save(exchange_hulls(asset, Box, ball_within), tmp_path / "model.sdf")
    before, after = bullet(asset.path), bullet(saved.path)
    for one, seen in ((asset, before), (read(saved.path), after)):
        assert seen["shapes"] == len(one.geoms)
        np.testing.assert_allclose(np.min([low for low, _ in seen["bounds"]], axis=0), bounds_of(one).min, atol=0.05)
        np.testing.assert_allclose(np.max([high for _, high in seen["bounds"]], axis=0), bounds_of(one).max, atol=0.05)
    assert before["masses"] == after["masses"]


@pytest.mark.parametrize("name", CORPUS)
def test_drake_has_each_shape_in_its_place_before_an_edit_and_after(name: str, tmp_path: Path) -> None:
    asset = read(corpus(*name.split("/")))
    edit = exchange_hulls(asset, Box, ball_within)
    saved = save(edit, tmp_path / asset.path.parent.name / "model.sdf")
    for one, path in ((asset, asset.path), (edit, saved.path)):
        assert assert_drake_agrees(one, path) == len(one.geoms)


def test_drake_has_every_collision_of_every_real_file_where_it_is(tmp_path: Path) -> None:
    shapes = 0
    for k, source in enumerate(sorted(corpus().rglob("*.sdf"))):
        path = tmp_path / f"{k}.sdf"
        path.write_text(_bare(source.read_text()))
        shapes += assert_drake_agrees(read(path), path)
    assert shapes > 250


def _bare(text: str) -> str:
    """A text with a ball for each mesh, of which Drake reads few kinds, and without what else Drake refuses."""
    text = re.sub(r"<(visual|static|inertial)\b.*?</\1>", "", text, flags=re.S)
    text = re.sub(r"<mesh>.*?</mesh>", "<sphere><radius>0.0123</radius></sphere>", text, flags=re.S)
    text = text.replace('<gazebo version="1.2">', '<sdf version="1.3">').replace("</gazebo>", "</sdf>")
    numbers = itertools.count()
    return re.sub(r"<collision[^>]*>", lambda _: f'<collision name="c{next(numbers)}">', text)


@pytest.mark.parametrize("name", FRAMES)
def test_drake_has_frames_where_they_are(name: str) -> None:
    path = ROOT / "sdf" / f"{name}.sdf"
    assert assert_drake_agrees(read(path), path) > 0


def test_drake_has_included_models_in_their_places(tmp_path: Path) -> None:
    part = (ROOT / "sdf" / "nested.sdf").read_text().replace('name="m"', 'name="p" placement_frame="n::a"')
    part = re.sub(r'"a"', '"pa"', part).replace("::a", "::pa").replace('name="n"', 'name="pn"').replace('"n::', '"pn::')
    (tmp_path / "part").mkdir()
    (tmp_path / "part" / "model.sdf").write_text(part)
    uri = f"<uri>model://{tmp_path.name}/part/model.sdf</uri>"
    include = f"<include>{uri}{{}}<pose relative_to='{{}}'>1 2 3 0.1 0.2 0.3</pose>{{}}</include>"
    inside = [
        '<link name="a"><pose>0 0 1 0.3 0.2 0.1</pose></link>',
        include.format("<name>q</name>", "a", "<placement_frame>pa</placement_frame>"),
        include.format("<name>r</name>", "q::pa", ""),
    ]
    path = tmp_path / "top.sdf"
    path.write_text(f'<sdf version="1.9"><model name="m">{"".join(inside)}</model></sdf>')
    assert assert_drake_agrees(read(path), path) == 6
