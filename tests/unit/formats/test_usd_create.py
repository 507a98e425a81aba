"""Stages made of assets of other formats: checked by USD's own validators, told to engines by its own reader."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdSemantics

from meshforge.formats import load, read, save
from meshforge.formats.usd.stage import BODY
from meshforge.geometry import Box, Capsule, Cylinder, Sphere
from meshforge.labels.names.label_by_names import match_names, names_of_mesh
from meshforge.samples import family_of, write_family
from meshforge.symbolic import FeatureKind, Label, SymbolicMesh
from tests.conversion_samples import SAMPLES
from tests.usd_stages import CUP, complaints, physics_shapes, stage, written

KINDS = (".usda", ".usdc", ".usd", ".usdz")


@pytest.mark.parametrize("suffix", KINDS)
@pytest.mark.parametrize("sample", SAMPLES)
def test_a_made_stage_holds_the_asset_and_is_valid(tmp_path: Path, sample: str, suffix: str) -> None:
    asset = SAMPLES[sample]()
    out = save(asset, tmp_path / f"a{suffix}")
    assert complaints(out.path) == []
    after = read(out.path)
    assert {geom.name for geom in after.geoms} == {out.names.get(geom.name, geom.name) for geom in asset.geoms}
    by_name = {geom.name: geom for geom in after.geoms}
    for geom in asset.geoms:
        made = by_name[out.names.get(geom.name, geom.name)]
        kind = "polytope" if geom.shape.kind == "ellipsoid" else geom.shape.kind
        assert (made.body, made.shape.kind) == (geom.body, kind)
        wanted = geom.shape.tessellate() if geom.shape.kind == "ellipsoid" else geom.shape
        assert np.allclose(made.shape.aabb.min, wanted.aabb.min, atol=1e-6)
        assert np.allclose(made.shape.aabb.max, wanted.aabb.max, atol=1e-6)
    assert len(after.non_convex) == len(asset.non_convex) and after.up == "z"


def test_the_same_asset_makes_the_same_bytes(tmp_path: Path) -> None:
    for suffix in KINDS:
        one, other = (save(SAMPLES["doors"](), tmp_path / k / f"a{suffix}").path.read_bytes() for k in "ab")
        assert one == other


def test_engines_are_told_the_same_shapes(tmp_path: Path) -> None:
    asset = SAMPLES["primitives"]()
    told = physics_shapes(save(asset, tmp_path / "a.usdc").path)
    assert len(told) == len(asset.geoms)
    for geom in asset.geoms:
        shape = told[f"/a/{geom.name}"]
        match geom.shape:
            case Box():
                assert np.allclose(shape.halfExtents, geom.shape.half)
            case Sphere():
                assert np.isclose(shape.radius, geom.shape.radius)
            case Cylinder() | Capsule():
                assert np.allclose([shape.radius, shape.halfHeight], [geom.shape.radius, geom.shape.half_length])
            case _:
                assert str(shape.approximation) == "convexHull"
        assert str(shape.rigidBody) == "/a/all"


def test_masses_come_back_and_joints_are_named(tmp_path: Path) -> None:
    before = SAMPLES["doors"]().mechanism
    saved = save(SAMPLES["doors"](), tmp_path / "a.usda")
    after = read(saved.path).mechanism
    assert len(after.inertials) == len(before.inertials) and not after.joints
    (lost,) = [loss.names for loss in saved.report.lost if loss.kind is FeatureKind.JOINTS]
    assert set(lost) == {joint.name for joint in before.joints if joint.kind != "fixed"}
    for weight, other in zip(before.inertials, after.inertials, strict=True):
        assert np.isclose(other.mass, weight.mass) and np.allclose(other.centre, weight.centre, atol=1e-5)
        assert np.allclose(other.inertia, weight.inertia, atol=1e-6)


def test_a_plane_stands_fast_outside_of_bodies(tmp_path: Path) -> None:
    after = read(save(SAMPLES["opaque"](), tmp_path / "a.usda").path)
    (plane,) = [piece for piece in after.non_convex if piece.plane is not None]
    assert plane.body == BODY and plane.plane is not None and np.allclose(plane.plane.translation, [0, 0, -1])


def test_a_hull_that_is_drawn_goes_for_good(tmp_path: Path) -> None:
    asset = read(save(SAMPLES["crowd"](), tmp_path / "a.usda").path)
    out = save(asset.with_geoms(asset.geoms[1:]), tmp_path / "out" / "a.usda")
    assert Counter(g.body for g in read(out.path).geoms) == {"left": 1, "right": 2, "base": 1}
    assert '"part"' not in out.path.read_text().split('def Xform "right"')[0]


def test_a_stage_with_y_up_stands_upright_in_other_formats(tmp_path: Path) -> None:
    tall = stage(
        'def Cylinder "World" ( prepend apiSchemas = ["PhysicsCollisionAPI"] )\n{\nuniform token axis = "Y"\n}', up="Y"
    )
    saved = save(read(written(tmp_path, tall)), tmp_path / "out" / "a.urdf")
    (geom,) = read(saved.path).geoms
    assert isinstance(geom.shape, Cylinder) and np.allclose(np.abs(geom.shape.pose.rotation[:, 2]), [0, 0, 1])
    assert "stand upright" in saved.notes[0]


def test_labels_of_hulls_come_back_as_mentions_and_what_is_shown_has_those_of_its_body(tmp_path: Path) -> None:
    write_family(family_of("cups"), tmp_path)
    mesh = load(tmp_path / "mug" / "model.urdf")
    out = save(mesh, tmp_path / "mug.usda")
    found = {one.hull: match_names(one, ("handle", "wall", "base")) for one in names_of_mesh(load(out.path))}
    assert {name: one and one.label for name, one in found.items()} == {
        out.names.get(hull.name, hull.name): hull.label for hull in mesh.hulls
    }
    stage = Usd.Stage.Open(str(out.path))
    (shown,) = [prim for prim in stage.Traverse() if prim.GetName() == "visual"]
    assert [*UsdSemantics.LabelsAPI(shown, "class").GetLabelsAttr().Get()] == ["base", "wall", "handle"]
    bare = SymbolicMesh.of(read(tmp_path / "mug" / "model.urdf"))
    assert b"emantics" not in save(bare, tmp_path / "bare.usda").path.read_bytes()


def test_an_edit_in_place_labels_what_it_makes_and_nothing_else(tmp_path: Path) -> None:
    mesh = SymbolicMesh.of(read(written(tmp_path, CUP)))
    assert mesh.asset
    side = mesh.hulls[0]
    made = replace(side, name=f"{side.name}~1", parent=side.name).with_label(Label("wall"))
    out = save(
        mesh.with_hulls([made, *(hull.with_label(Label("grip")) for hull in mesh.hulls[1:])]),
        tmp_path / "out" / "a.usda",
    )
    labels = [geom.mentions[:1] for geom in read(out.path).geoms]
    assert labels.count((("label", "wall"),)) == 1 and (("label", "grip"),) not in labels
