"""Every real URDF and SDF: read or refused as the table says, written back byte for byte, edited and read again."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest

from meshforge.common import AssetError
from script.corpus_rows import row
from script.corpus_table import TABLE, differences, parse, table
from tests import sdf_sample, urdf_sample
from tests.asset_bounds import bounds_of
from tests.corpus_path import corpus
from tests.urdf_sample import assert_reads_back, put, read, without

WORLDS = {"scenes_robots/pybullet_data/kiva_shelf/model.sdf"}


@pytest.mark.slow
@pytest.mark.parametrize(("suffix", "home", "least"), [(".urdf", urdf_sample, 35), (".sdf", sdf_sample, 45)])
def test_real_files_are_read_or_refused_for_faults(tmp_path: Path, suffix: str, home: ModuleType, least: int) -> None:
    root, committed = corpus(), parse(TABLE.read_text(encoding="utf-8"))
    paths = {path.relative_to(root).as_posix(): path for path in sorted(root.rglob(f"*{suffix}"))}
    assert len(paths) >= least
    now = parse(table(row((str(root), key)) for key in paths))
    assert differences({key: committed[key] for key in paths}, now) == []
    for key, path in paths.items():
        try:
            asset = home.read(path)
        except AssetError:
            continue
        assert home.write(asset, path.name).main == path.read_bytes(), key
        if key in WORLDS:
            continue
        edit = without(asset, *(geom.name for geom in asset.geoms[::3]))
        output = home.write(edit, path.name)  # a name that nobody gave is left out where another element has it
        edit = replace(edit, geoms=tuple(replace(g, name=output.names.get(g.name, g.name)) for g in edit.geoms))
        assert_reads_back(edit, home.read(put(output, tmp_path / key)))


def test_one_cabinet_in_two_encodings_has_the_same_hulls() -> None:
    folder = ("doors_cabinets", "IsaacGymEnvs", "sektion_cabinet_model", "urdf")
    one, many = (read(corpus(*folder, name)) for name in ("sektion_cabinet.urdf", "sektion_cabinet_2.urdf"))
    for link in ("sektion", "drawer_top", "drawer_bottom"):
        own, other = ([g.shape.volume for g in a.geoms if g.body == link] for a in (one, many))
        assert len(own) == len(other) == 7
        if link != "sektion":  # its numbered files hold another decomposition than its whole file
            assert own == pytest.approx(other, rel=1e-4)
    assert {n: p.translation.tolist() for n, p in one.body_poses.items()} == {
        n: p.translation.tolist() for n, p in many.body_poses.items()
    }


def test_a_chair_whose_meshes_are_in_centimetres_is_as_tall_as_a_chair() -> None:
    asset = sdf_sample.read(corpus("chairs", "aws-small-house", "aws_robomaker_residential_ChairA_01", "model.sdf"))
    assert 0.7 < bounds_of(asset).size[2] < 1.2
