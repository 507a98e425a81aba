"""Every real plain mesh file: counted as a user would, written back byte for byte, edited and read again."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from meshforge.geometry import convex_hull
from meshforge.symbolic import Asset, Geom
from tests.corpus_path import corpus
from tests.mesh_engines import bounds

# hulls and opaque pieces of files whose counts are told by their `o` lines, shapes or documentation
KNOWN = {
    "cups_mugs/pybullet-URDF-models/mug/collision.obj": (62, 0),
    "cups_mugs/pybullet-URDF-models/green_cup/collision.obj": (46, 0),
    "kettles_teapots/pybullet-URDF-models/pitcher/collision.obj": (16, 0),
    "kettles_teapots/CoACD/python/out.obj": (88, 0),
    "kettles_teapots/CoACD/examples/results/Kettle_out.wrl": (98, 0),
    "soap_bottles/CoACD/results/Bottle_out.wrl": (115, 0),
    "soap_bottles/pybullet-URDF-models/soap_dish/collision.obj": (44, 0),
    "scenes_robots/pybullet_data/teddy2_VHACD_CHs.obj": (15, 0),
    "scenes_robots/pybullet-planning/dinnerware/pan_tefal-collision01.obj": (1, 0),
    "doors_cabinets/IsaacGymEnvs/sektion_cabinet_model/meshes/sektion_convexdecomposition.obj": (7, 0),
    "doors_cabinets/IsaacGymEnvs/sektion_cabinet_model/meshes/drawer_convexdecomposition.wrl": (7, 0),
    "weird/02_flat_pieces_collision.obj": (14, 0),
    "weird/04_many_groups_one_component.obj": (0, 1),
    "weird/05_kettle_doublesided.obj": (0, 6),
}


@pytest.mark.parametrize("name", KNOWN)
def test_real_files_have_the_hulls_they_should(name: str) -> None:
    asset = read(corpus(*name.split("/")))
    assert (len(asset.geoms), len(asset.non_convex)) == KNOWN[name]


def test_hulls_of_real_files_are_named_after_their_objects() -> None:
    asset = read(corpus("weird", "02_flat_pieces_collision.obj"))
    assert [g.name for g in asset.geoms] == [f"convex_{k}" for k in range(14)]
    assert read(corpus("kettles_teapots", "CoACD", "python", "out.obj")).geoms[87].name == "geom0#87"


def test_a_file_without_faces_is_refused() -> None:
    with pytest.raises(AssetError, match="there is no triangle in this file"):
        read(corpus("weird", "18_face_in_group_name.obj"))


def _sample(root: Path) -> list[Path]:
    """Files of every kind, one in six, small ones, always the same."""
    paths = [p for p in sorted(root.rglob("*")) if p.suffix.lower() in (".obj", ".stl", ".wrl")]
    return [p for p in paths if p.stat().st_size < 200_000 and not p.name.startswith("18_face")][::6]


@pytest.mark.slow
def test_unedited_real_files_are_written_byte_for_byte(tmp_path: Path) -> None:
    sample = _sample(corpus())
    assert Counter(p.suffix.lower() for p in sample).keys() == {".obj", ".stl", ".wrl"}
    for path in sample:
        saved = save(read(path), tmp_path / path.name, overwrite=True)
        assert saved.path.read_bytes() == path.read_bytes(), path.name


@pytest.mark.slow
def test_edited_real_files_hold_what_the_edit_left(tmp_path: Path) -> None:
    edits = 0
    for path in _sample(corpus()):
        if path.suffix == ".wrl":
            continue
        asset = read(path)
        if asset.geoms:
            _assert_edit_reads_back(asset, tmp_path / path.name)
            edits += 1
    assert edits > 50


def _assert_edit_reads_back(asset: Asset, out: Path) -> None:
    gone, *kept = asset.geoms
    made = Geom(f"{gone.name}~1", "body", convex_hull(gone.shape.vertices + np.array([7, 0, 0])), gone.name)
    edit = asset.with_geoms([*kept, made])
    saved = save(edit, out, overwrite=True)
    back = {g.name: g for g in read(out).geoms}
    assert len(back) == len(edit.geoms), out.name
    assert bool(saved.names) <= (out.suffix.lower() != ".obj"), out.name
    for geom in edit.geoms:
        found = back[saved.names.get(geom.name, geom.name)].shape
        np.testing.assert_allclose(found.aabb.corners, geom.shape.aabb.corners, atol=1e-6, err_msg=out.name)
    points = [g.shape.vertices for g in edit.geoms] + [o.surface.vertices for o in asset.non_convex if o.surface]
    low, high = (f([f(p, axis=0) for p in points], axis=0) for f in (np.min, np.max))
    np.testing.assert_allclose(bounds(out), [low, high], atol=1e-5, err_msg=out.name)


def test_a_folder_of_real_hulls_is_one_asset(tmp_path: Path) -> None:
    asset = read(corpus("cups_mugs", "dexmv-sim", "collision", "025_mug", "v1"))
    assert (len(asset.geoms), len(asset.non_convex)) == (16, 0)
    saved = save(asset.with_geoms(asset.geoms[1:]), tmp_path / "mug")
    assert len(saved.files) == 15
    assert [g.name for g in read(tmp_path / "mug").geoms] == [g.name for g in asset.geoms[1:]]
