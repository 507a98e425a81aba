from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import Preparation, apply_preparation, cut_hull
from meshforge.common import GeometryError
from meshforge.formats import load, read, save
from meshforge.symbolic import SymbolicMesh
from tests.unit.batch.preparation.samples import write_boxes, write_stand

NONE = Preparation()


def test_a_cut_hull_becomes_two_in_its_place(tmp_path: Path) -> None:
    asset = read(write_boxes(tmp_path / "row.obj"))
    done = cut_hull(asset, NONE, "geom0#1", (1.5, 0, 0), (1, 0, 0))
    ready = apply_preparation(asset, done)
    assert [geom.name for geom in ready.geoms] == ["geom0#0", "geom0#1#0", "geom0#1#1", "geom0#2"]
    assert [geom.shape.volume for geom in ready.geoms] == pytest.approx([1, 0.5, 1.5, 1])
    assert [geom.parent for geom in ready.geoms] == [None, "geom0#1", "geom0#1", None]


def test_a_native_box_of_a_urdf_is_cut_into_meshes_with_its_attributes(tmp_path: Path) -> None:
    asset = read(write_stand(tmp_path / "in"))
    done = cut_hull(asset, NONE, "frame/foot", (0, 0, -1), (1, 1, 0))
    saved = save(SymbolicMesh.of(apply_preparation(asset, done)), tmp_path / "out/stand.urdf")
    back = {hull.name: hull.volume for hull in load(saved.path).hulls}
    assert back == {"frame/foot#0": pytest.approx(2.0), "frame/foot#1": pytest.approx(2.0)}
    assert done.steps[0].replaced[0].remark == "2 hulls"


@pytest.mark.parametrize("at", [(-1, 0, 0), (1, 0, 0), (3, 0, 0)])
def test_a_plane_beside_the_hull_is_refused_with_its_box(tmp_path: Path, at: tuple[float, float, float]) -> None:
    asset = read(write_boxes(tmp_path / "row.obj"))
    with pytest.raises(GeometryError, match=r"from \(1, 0, 0\) to \(3, 1, 1\)"):
        cut_hull(asset, NONE, "geom0#1", at, (1, 0, 0))


def test_what_is_no_hull_and_no_direction_is_refused(tmp_path: Path) -> None:
    asset = read(write_boxes(tmp_path / "row.obj"))
    with pytest.raises(GeometryError, match="Did you mean 'geom0#1'"):
        cut_hull(asset, NONE, "geom0#11", (0, 0, 0), (1, 0, 0))
    for across in ((0, 0, 0), (float("nan"), 0, 0)):
        with pytest.raises(GeometryError, match="not zero"):
            cut_hull(asset, NONE, "geom0#1", (2, 0, 0), across)


def test_vertices_of_the_hull_stay_bit_for_bit(tmp_path: Path) -> None:
    asset = read(write_boxes(tmp_path / "row.obj"))
    whole = next(geom.shape for geom in asset.geoms if geom.name == "geom0#1")
    parts = apply_preparation(asset, cut_hull(asset, NONE, "geom0#1", (2, 0.3, 0.4), (0.3, 0.2, 0.1))).geoms[1:3]
    corners = {row.tobytes() for part in parts for row in part.shape.vertices + 0.0}
    assert {row.tobytes() for row in whole.vertices + 0.0} <= corners
    assert np.isclose(sum(part.shape.volume for part in parts), whole.volume)
