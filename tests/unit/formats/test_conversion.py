"""Every pair of formats: what is written in one and converted to another has the same hulls there."""

import itertools
from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import convert, labels_beside, read, save
from meshforge.geometry import Floats
from meshforge.symbolic import Asset, SymbolicMesh, read_labels, transfer_labels
from tests.asset_bounds import bounds_of
from tests.conversion_samples import SAMPLES
from tests.gltf_files import KHR, SceneFile
from tests.soups import box

PLAIN = (".obj", ".stl", ".ply", "")
SUFFIXES = (*PLAIN, ".urdf", ".xml", ".sdf", ".glb", ".usda", ".usdz")
PAIRS = [pair for pair in itertools.product(SUFFIXES, SUFFIXES) if pair[0] != pair[1]]
UP = {".urdf": "z", ".xml": "z", ".sdf": "z", ".glb": "y", ".usda": "z", ".usdz": "z"}
TURNS = {("y", "z"): [[1, 0, 0], [0, 0, -1], [0, 1, 0]], ("z", "y"): [[1, 0, 0], [0, 0, 1], [0, -1, 0]]}
SINGLE = 3e-6  # share of the diagonal: STL, glTF and MuJoCo's meshes are in single precision


def turn(source: str, target: str) -> Floats:
    """What takes coordinates of a format to those of another, where one of them has Y for up."""
    return np.array(TURNS.get((UP.get(source, ""), UP.get(target, "")), np.eye(3)), dtype=float)


def assert_same_hulls(
    before: Asset, after: Asset, names: dict[str, str], linear: Floats, hulled: tuple[str, ...] = ()
) -> None:
    """The hulls of two assets have the same places and sizes; hulled: those that an engine makes besides."""
    assert set(hulled) <= {geom.name for geom in after.geoms} and (
        not hulled or len(hulled) == sum(piece.surface is not None for piece in before.non_convex)
    )
    by_name = {geom.name: geom.shape for geom in after.geoms if geom.name not in hulled}
    assert len(by_name) == len(before.geoms)
    slack = SINGLE * bounds_of(before).diagonal
    for geom in before.geoms:
        now = by_name[names.get(geom.name, geom.name)]
        was = (geom.shape if now.kind == geom.shape.kind else geom.shape.tessellate()).transform(linear, np.zeros(3))
        np.testing.assert_allclose(now.aabb.min, was.aabb.min, atol=slack, err_msg=geom.name)
        np.testing.assert_allclose(now.aabb.max, was.aabb.max, atol=slack, err_msg=geom.name)
        assert now.volume == pytest.approx(was.volume, rel=1e-3)


def written(sample: str, suffix: str, folder: Path) -> Path:
    return save(SAMPLES[sample](), folder / "first" / f"thing{suffix}").path


@pytest.mark.parametrize("sample", SAMPLES)
@pytest.mark.parametrize(("source", "target"), PAIRS)
def test_every_pair_of_formats_keeps_the_hulls(source: str, target: str, sample: str, tmp_path: Path) -> None:
    before = read(written(sample, source, tmp_path))
    saved = save(before, tmp_path / "second" / f"thing{target}")
    after = read(saved.path)
    assert_same_hulls(before, after, dict(saved.names), turn(source, target), saved.hulled)
    if target not in PLAIN:
        bodies = {geom.name: geom.body for geom in after.geoms}
        assert {bodies[saved.names.get(g.name, g.name)] for g in before.geoms} == {g.body for g in before.geoms}


@pytest.mark.parametrize("target", [".urdf", ".xml", ".sdf"])
def test_native_shapes_stay_native_where_the_format_has_them(target: str, tmp_path: Path) -> None:
    asset = SAMPLES["primitives"]()
    after = read(save(asset, tmp_path / f"thing{target}").path)
    kinds = {geom.name: geom.shape.kind for geom in after.geoms}
    kept = {"box", "sphere", "cylinder"} | ({"capsule", "ellipsoid"} if target != ".urdf" else set())
    assert kinds == {g.name: g.shape.kind if g.shape.kind in kept else "polytope" for g in asset.geoms}


@pytest.mark.parametrize("target", [suffix for suffix in SUFFIXES if suffix != ".xml"])
def test_opaque_pieces_with_a_surface_come_back_as_such(target: str, tmp_path: Path) -> None:
    asset = SAMPLES["opaque"]()
    after = read(save(asset, tmp_path / f"thing{target}").path)
    assert [piece.reason for piece in after.non_convex if piece.surface] == ["not convex: fills 71% of its convex hull"]
    assert len(after.geoms) == 1


@pytest.mark.parametrize("target", [".urdf", ".xml", ".sdf", ".glb"])
def test_what_is_seen_of_a_scene_around_a_moving_body_is_no_part_of_it(target: str, tmp_path: Path) -> None:
    scene = SceneFile()
    scene.node("floor", box((-5, -1, -5), (10, 1, 10)))
    ball = scene.collider("skin", {"type": "sphere", "sphere": {"radius": 0.5}})
    scene.node("ball", children=[ball], extensions={KHR: {"motion": {"mass": 1}}}, translation=[0, 3, 0])
    before = read(scene.write(tmp_path / "scene.gltf"))
    assert [body.name for body in before.bodies] == ["body", "ball"]
    after = read(save(before, tmp_path / "out" / f"scene{target}").path)
    assert [geom.body for geom in after.geoms] == ["ball"]
    assert [surface.body for surface in after.visuals if surface.body == "ball"] == []
    assert len(after.visuals) == 1


@pytest.mark.parametrize("sample", SAMPLES)
@pytest.mark.parametrize("target", SUFFIXES)
def test_labels_beside_a_converted_file_are_those_of_its_hulls(target: str, sample: str, tmp_path: Path) -> None:
    mesh = SymbolicMesh.of(SAMPLES[sample]())
    out = tmp_path / f"thing{target}"
    convert(mesh.with_labels({hull.name: "leg" for hull in mesh.hulls}), out)
    followed = transfer_labels(read_labels(labels_beside(out)), SymbolicMesh.of(read(out)))
    assert (followed.changed, followed.renamed, followed.gone) == ((), (), ())
    assert len(followed.mesh.labels) == len(mesh.hulls)
