"""Every real SDF: opened as a user would expect, written back byte for byte, edited and read again."""

from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.common import AssetError
from tests.asset_bounds import bounds_of
from tests.corpus_path import corpus
from tests.sdf_sample import read, write
from tests.urdf_sample import assert_reads_back, put, without

# hulls and opaque pieces of files whose counts are known from their text
KNOWN = {
    "scenes_robots/pybullet_data/kiva_shelf/model.sdf": (21, 0),
    "tables_desks/osrf-gazebo_models/table/model.sdf": (5, 0),
    "doors_cabinets/drake-models-manipulation_station/cupboard.sdf": (10, 0),
    "chairs/aws-small-house/aws_robomaker_residential_ChairA_01/model.sdf": (8, 0),
    "soap_bottles/drake-models-ycb/006_mustard_bottle.sdf": (9, 0),
}
REFUSED = {
    "scenes_robots/turtlebot3_simulations/models/turtlebot3_house/model.sdf": (
        "trash_can.dae' of collision 'first_2015_trash_can::link/collision' is not there (and 1 more like it)"
    ),
}
WORLDS = {"scenes_robots/pybullet_data/kiva_shelf/model.sdf"}


@pytest.mark.slow
def test_every_real_file_is_read_or_refused_for_its_own_fault(tmp_path: Path) -> None:
    root = corpus()
    paths = sorted(root.rglob("*.sdf"))
    assert len(paths) >= 45
    for path in paths:
        key = path.relative_to(root).as_posix()
        if key in REFUSED:
            with pytest.raises(AssetError) as error:
                read(path)
            assert REFUSED[key] in str(error.value)
            continue
        asset = read(path)
        if key in KNOWN:
            assert (len(asset.geoms), len(asset.non_convex)) == KNOWN[key], key
        assert write(asset, path.name).main == path.read_bytes(), key
        if key not in WORLDS:
            edit = without(asset, *(geom.name for geom in asset.geoms[::3]))
            assert_reads_back(edit, read(put(write(edit, path.name), tmp_path / key)))


def test_a_chair_whose_meshes_are_in_centimetres_is_as_tall_as_a_chair() -> None:
    asset = read(corpus("chairs", "aws-small-house", "aws_robomaker_residential_ChairA_01", "model.sdf"))
    assert 0.7 < bounds_of(asset).size[2] < 1.2
