"""Every real MJCF: the hulls that MuJoCo compiles, or of a refused one those that it holds, or what to open instead."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from meshforge.common import AssetError
from tests.corpus_path import corpus
from tests.mjcf_engines import assert_as_in_mujoco, read

# hulls of files that MuJoCo refuses, counted in their text, and its reason
REFUSED = {
    "doors_cabinets/robocasa/cabinets/cabinet_hinge.xml": (5, "mass and inertia of moving bodies"),
    "doors_cabinets/robocasa/cabinets/cabinet_housing.xml": (0, "inertia must have positive eigenvalues"),
    "doors_cabinets/robocasa/cabinets/cabinet_panels/full_window.xml": (5, "texture 'plywood_2d' not found"),
    "doors_cabinets/robocasa/cabinets/cabinet_panels/full_window_orig.xml": (5, "texture 'plywood_2d' not found"),
    "doors_cabinets/robocasa/cabinets/cabinet_single.xml": (5, "mass and inertia of moving bodies"),
    "weird/15_unknown_element_region.xml": (17, "unrecognized element"),
    "weird/16_bad_rgba.xml": (0, "bad format in attribute 'rgba'"),
}


@pytest.fixture(scope="module")
def files() -> dict[str, Path]:
    root = corpus()
    found = {path.relative_to(root).as_posix(): path for path in sorted(root.rglob("*.xml"))}
    return {key: path for key, path in found.items() if b"<mujoco" in path.read_bytes()}


def is_fragment(path: Path) -> bool:
    return b"<mujocoinclude" in path.read_bytes()


@pytest.mark.slow
def test_models_that_mujoco_compiles_have_its_collision_geoms(files: dict[str, Path]) -> None:
    models = {key: path for key, path in files.items() if not is_fragment(path) and key not in REFUSED}
    assert len(models) >= 72
    for key, path in models.items():
        asset = read(path)
        assert not asset.notes and not asset.missing, key
        assert_as_in_mujoco(asset, path)


@pytest.mark.parametrize("key", REFUSED)
def test_models_that_mujoco_refuses_are_read_for_their_collision_geometry(key: str, files: dict[str, Path]) -> None:
    count, reason = REFUSED[key]
    with pytest.raises(ValueError, match=r"(?i)error"):
        mujoco.MjModel.from_xml_path(str(files[key]))
    asset = read(files[key])
    assert len(asset.geoms) == count
    assert reason in asset.notes[0] and f"{files[key].name}:" in asset.notes[0]


def test_fragments_are_refused_with_the_file_to_open(files: dict[str, Path]) -> None:
    fragments = {key: path for key, path in files.items() if is_fragment(path)}
    assert len(fragments) >= 45
    alone = []
    for key, path in fragments.items():
        with pytest.raises(AssetError, match="part of a model") as error:
            read(path)
        assert error.value.where is not None and error.value.where.startswith(f"{path}:")
        if "none was found" in str(error.value):
            alone.append(key)
        else:
            assert ".xml, which include" in str(error.value)
    assert alone == [f"doors_cabinets/furniture_sim/microwave/microwave_body{k}.xml" for k in (1, 2, 3)]


def test_kettles_lie_in_several_files(files: dict[str, Path]) -> None:
    asset = read(files["kettles_teapots/furniture_sim/kettle.xml"])
    names = [path.name for path in asset.files]
    assert next(name for name in names if name.endswith(".xml")) == "kettle_asset.xml"
    assert {"kettle.stl", "kettlehandle.stl", "metal0.png"} <= set(names)
    assert all(path.is_file() for path in asset.files)
    assert len(asset.geoms) == 41


def test_visual_meshes_lie_where_the_model_shows_them(files: dict[str, Path]) -> None:
    path = files["scenes_robots/robodesk/assets/desk.xml"]
    asset = read(path)
    compiled = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(compiled)
    mujoco.mj_kinematics(compiled, data)
    shown = np.concatenate([surface.vertices for surface in asset.visuals if surface.body == "panda0_link0"])
    k = int(compiled.body_geomadr[compiled.body("panda0_link0").id])
    mesh = int(compiled.geom_dataid[k])
    first, count = compiled.mesh_vertadr[mesh], compiled.mesh_vertnum[mesh]
    points = compiled.mesh_vert[first : first + count] @ data.geom_xmat[k].reshape(3, 3).T + data.geom_xpos[k]
    np.testing.assert_allclose(shown.min(axis=0), points.min(axis=0), atol=1e-6)
    np.testing.assert_allclose(shown.max(axis=0), points.max(axis=0), atol=1e-6)
