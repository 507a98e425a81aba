"""Written URDFs as engines read them: an unedited one is equal, an edited one differs in its collisions only."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from meshforge.geometry import Box, Ellipsoid
from meshforge.symbolic import Asset
from tests.corpus_path import corpus
from tests.urdf_engines import MASSES, assert_mujoco_agrees, bullet, mujoco_model, yourdf
from tests.urdf_sample import ball_within, exchange_hulls, put, read, sample, write

CUPS = ["blue_cup", "green_cup", "orange_cup", "yellow_cup", "mug"]
BOTTLES = ["soap_dish", "magic_clean", "shampoo"]
FLAT = [
    *(f"cups_mugs/pybullet-URDF-models/{name}/model.urdf" for name in CUPS),
    *(f"soap_bottles/pybullet-URDF-models/{name}/model.urdf" for name in BOTTLES),
    "kettles_teapots/pybullet-URDF-models/pitcher/model.urdf",
    "cups_mugs/pybullet-planning/cup.urdf",
    "tables_desks/pybullet-planning/table_collision/table.urdf",
    "doors_cabinets/pybullet-planning/door.urdf",
    "scenes_robots/pybullet_data/teddy_vhacd.urdf",
    "scenes_robots/pybullet_data/tray/tray.urdf",
    "scenes_robots/pybullet_data/quadruped/minitaur.urdf",
]
PACKAGES = [
    "doors_cabinets/IsaacGymEnvs/sektion_cabinet_model/urdf/sektion_cabinet.urdf",
    "doors_cabinets/IsaacGymEnvs/sektion_cabinet_model/urdf/sektion_cabinet_2.urdf",
    "scenes_robots/IsaacGymEnvs-trifinger/robot_properties_fingers/urdf/edu/trifingeredu.urdf",
]


@pytest.fixture
def asset(request: pytest.FixtureRequest, tmp_path: Path) -> Asset:
    """The sample, or a real asset with stand-ins for the visual meshes that the corpus leaves out."""
    if request.param == "sample":
        return read(sample(tmp_path / "in"))
    path = corpus(*request.param.split("/"))
    found = read(path)
    if not found.missing:
        return found
    folder = tmp_path / "in"
    shutil.copytree(path.parent, folder)
    folder.chmod(0o755)
    for name in found.missing:
        (folder / name).write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    return read(folder / path.name)


def edited(asset: Asset) -> Asset:
    return exchange_hulls(asset, Box, ball_within, Ellipsoid)


each_flat = pytest.mark.parametrize("asset", ["sample", *FLAT], indirect=True)
each = pytest.mark.parametrize("asset", ["sample", *FLAT, *PACKAGES], indirect=True)


@each
def test_pybullet_sees_no_difference_in_an_unedited_file(asset: Asset, tmp_path: Path) -> None:
    again = put(write(asset, asset.path.name), tmp_path / "out" / asset.path.name)
    assert again.read_bytes() == asset.path.read_bytes()
    assert repr(bullet(again)) == repr(bullet(asset.path))


@each
def test_pybullet_finds_masses_contacts_joints_and_visuals_of_an_edit_as_before(asset: Asset, tmp_path: Path) -> None:
    edit = edited(asset)
    before = bullet(asset.path)
    after = bullet(put(write(edit), tmp_path / "out" / "edited.urdf"))
    shown = asset.path.name != "sektion_cabinet_2.urdf"  # a link has no visual there: PyBullet shows its collisions
    for what in ("dynamics", "joints", "states", *(["visuals"] if shown else [])):
        assert after[what] == before[what], what
    assert after["shapes"] != before["shapes"]


@each_flat
def test_mujoco_finds_each_hull_of_an_edit_in_its_place_and_the_masses_as_before(asset: Asset, tmp_path: Path) -> None:
    edit = edited(asset)
    path = put(write(edit), tmp_path / "out" / "edited.urdf")
    before, after = mujoco_model(asset.path), mujoco_model(path)
    for field in MASSES:
        np.testing.assert_array_equal(getattr(after, field), getattr(before, field), err_msg=field)
    assert after.ngeom == len(edit.geoms) + len(edit.non_convex)
    assert_mujoco_agrees(path)


@pytest.mark.parametrize("asset", ["sample", FLAT[0], FLAT[4], FLAT[10], PACKAGES[0], PACKAGES[2]], indirect=True)
def test_yourdfpy_reads_the_same_tree_and_every_hull(asset: Asset, tmp_path: Path) -> None:
    edit = edited(asset)
    robot = yourdf(put(write(edit), tmp_path / "out" / "edited.urdf"))
    for body in edit.bodies:
        found = robot.get_transform(body.name, collision_geometry=True)
        np.testing.assert_allclose(found[:3, :3], body.pose.rotation, atol=1e-9)
        np.testing.assert_allclose(found[:3, 3], body.pose.translation, atol=1e-9)
    assert sum(len(link.collisions) for link in robot.robot.links) == len(edit.geoms) + len(edit.non_convex)
