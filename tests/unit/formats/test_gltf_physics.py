from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Sphere
from meshforge.symbolic import Asset, FeatureKind
from tests.gltf_files import KHR, SceneFile, Tree
from tests.soups import angle, box, together


def asset_of(scene: SceneFile, folder: Path) -> Asset:
    return read(scene.write(folder / "a.glb"))


def omi(scene: SceneFile, name: str, shape: Tree, **rest: object) -> int:
    """A node with a shape of OMI_physics_shape."""
    shapes = scene.tree.setdefault("extensions", {}).setdefault("OMI_physics_shape", {}).setdefault("shapes", [])
    shapes.append(shape)
    collider = {"collider": {"shape": len(shapes) - 1}}
    return scene.node(name, None, extensions={"OMI_physics_body": collider}, **rest)


@pytest.fixture
def scene() -> SceneFile:
    return SceneFile()


def test_implicit_shapes_are_native_ones_about_y(scene: SceneFile, tmp_path: Path) -> None:
    scene.collider("box", {"type": "box", "box": {"size": [2, 4, 6]}}, translation=[1, 0, 0])
    scene.collider("ball", {"type": "sphere", "sphere": {"radius": 3}})
    scene.collider("can", {"type": "cylinder", "cylinder": {"radiusTop": 1, "radiusBottom": 1, "height": 4}})
    scene.collider("pill", {"type": "capsule", "capsule": {"radiusTop": 1, "radiusBottom": 1, "height": 4}})
    asset = asset_of(scene, tmp_path)
    brick, ball, can, pill = (geom.shape for geom in asset.geoms)
    assert isinstance(brick, Box) and brick.half.tolist() == [1, 2, 3] and brick.centroid.tolist() == [1, 0, 0]
    assert isinstance(ball, Sphere) and ball.radius == 3
    assert isinstance(can, Cylinder) and can.aabb.size.tolist() == [2, 4, 2]
    assert isinstance(pill, Capsule) and pill.aabb.size.tolist() == [2, 6, 2]
    assert [geom.name for geom in asset.geoms] == ["box", "ball", "can", "pill"]
    assert "KHR_physics_rigid_bodies" in asset.notes[0]


def test_sizes_that_are_left_out_are_those_of_the_specification(scene: SceneFile, tmp_path: Path) -> None:
    for kind in ("box", "sphere", "cylinder", "capsule"):
        scene.collider(kind, {"type": kind})
    sizes = [geom.shape.aabb.size.tolist() for geom in asset_of(scene, tmp_path).geoms]
    assert sizes == [[1, 1, 1], [1, 1, 1], [0.5, 0.5, 0.5], [0.5, 1, 0.5]]


def test_the_scale_of_a_node_applies_to_its_shape(scene: SceneFile, tmp_path: Path) -> None:
    scene.collider("egg", {"type": "sphere", "sphere": {"radius": 1}}, scale=[1, 2, 1])
    scene.collider("big", {"type": "sphere", "sphere": {"radius": 1}}, scale=[3, 3, 3])
    egg, big = (geom.shape for geom in asset_of(scene, tmp_path).geoms)
    assert isinstance(egg, Ellipsoid) and egg.aabb.size.tolist() == [2, 4, 2]
    assert isinstance(big, Sphere) and big.radius == pytest.approx(3)


@pytest.mark.parametrize(
    ("kind", "top", "volume"),
    [("cylinder", 1.0, np.pi / 3 * 4 * (4 + 2 + 1)), ("cylinder", 0.0, np.pi / 3 * 4 * 4), ("capsule", 1.0, 48.0)],
)
def test_tapered_shapes_are_hulls_and_told(tmp_path: Path, kind: str, top: float, volume: float) -> None:
    scene = SceneFile()
    scene.collider("cone", {"type": kind, kind: {"radiusTop": top, "radiusBottom": 2, "height": 4}})
    asset = asset_of(scene, tmp_path)
    shape = asset.geoms[0].shape
    assert shape.kind == "polytope"
    assert shape.volume == pytest.approx(volume, rel=0.1)
    assert shape.centroid[1] < 0  # the thick end is down
    assert any("'cone' is tapered" in note for note in asset.notes)


def test_planes_and_shapes_without_volume_are_opaque(scene: SceneFile, tmp_path: Path) -> None:
    scene.collider("floor", {"type": "plane"}, translation=[0, 1, 0])
    scene.collider("thin", {"type": "box", "box": {"size": [1, 0, 1]}})
    scene.collider("odd", {"type": "torus"})
    asset = asset_of(scene, tmp_path)
    assert not asset.geoms
    floor, thin, odd = asset.non_convex
    assert floor.plane is not None
    assert floor.plane.rotation[:, 2].tolist() == [0, 1, 0] and floor.plane.translation.tolist() == [0, 1, 0]
    assert thin.reason == "a box without volume: 1, 0, 1 m"
    assert odd.reason == "a shape of type 'torus' is not known"


@pytest.mark.parametrize("form", ["node", "mesh"])
def test_meshes_collide_as_their_hull_or_as_they_are(scene: SceneFile, tmp_path: Path, form: str) -> None:
    hull, pieces, corner = scene.mesh(angle()), scene.mesh(together(box(), box((2, 0, 0)))), scene.mesh(angle())
    scene.uses(KHR)
    for name, mesh, convex in (("hull", hull, True), ("pieces", pieces, False), ("corner", corner, False)):
        value = scene.node(f"{name} mesh", mesh=mesh) if form == "node" else mesh
        collider = {"geometry": {form: value, "convexHull": convex}}
        scene.node(name, extensions={KHR: {"collider": collider}}, scale=[2, 1, 1])
    scene.tree["scenes"] = [{"nodes": [k for k, n in enumerate(scene.tree["nodes"]) if "mesh" not in n]}]
    asset = asset_of(scene, tmp_path)
    assert [geom.name for geom in asset.geoms] == ["hull", "pieces#0", "pieces#1"]
    assert asset.geoms[1].shape.volume == pytest.approx(2)
    assert [piece.name for piece in asset.non_convex] == ["corner"]


def test_nodes_in_motion_are_bodies_and_what_is_below_belongs_to_the_nearest(scene: SceneFile, tmp_path: Path) -> None:
    brick = {"type": "box"}
    lid = scene.collider("lid", brick, translation=[0, 1, 0])
    scene.tree["nodes"][lid]["extensions"][KHR]["motion"] = {}
    wall = scene.collider("wall", brick)
    group = scene.node("group", children=[wall, lid])
    scene.node(
        "jar", children=[group], extensions={KHR: {"motion": {"mass": 2}}}, translation=[5, 0, 0], scale=[2, 2, 2]
    )
    scene.collider("floor", brick)
    asset = asset_of(scene, tmp_path)
    assert {geom.name: geom.body for geom in asset.geoms} == {"body/floor": "body", "jar/wall": "jar", "lid/lid": "lid"}
    poses = asset.body_poses
    assert list(poses) == ["body", "jar", "lid"]
    assert poses["jar"].translation.tolist() == [5, 0, 0] and np.allclose(poses["jar"].rotation, np.eye(3))
    assert poses["lid"].translation.tolist() == [5, 2, 0]


def test_masses_are_not_read_and_that_is_said(scene: SceneFile, tmp_path: Path) -> None:
    for name, motion in {"khr": {"mass": 1}, "free": {}}.items():
        child = scene.collider(f"{name} box", {"type": "box"})
        scene.node(name, children=[child], extensions={KHR: {"motion": motion}})
    scene.node("omi", extensions={"OMI_physics_body": {"motion": {"type": "dynamic", "mass": 6}}})
    scene.node("older", extensions={"OMI_physics_body": {"type": "rigid", "mass": 6}})
    asset = asset_of(scene, tmp_path)
    assert "not read: 3 masses; in checks the hulls have the density of water" in asset.notes
    assert not asset.mechanism.inertials
    lost = save(asset, tmp_path / "m.urdf").report.lost
    assert [str(loss) for loss in lost if loss.kind is FeatureKind.MASSES] == [
        "3 masses (khr, omi, older) are left out: masses of a glTF are not read"
    ]


def test_triggers_are_told_and_not_read(scene: SceneFile, tmp_path: Path) -> None:
    scene.collider("box", {"type": "box"})
    scene.node("door", extensions={KHR: {"trigger": {"geometry": {"shape": 0}}}})
    asset = asset_of(scene, tmp_path)
    assert [geom.name for geom in asset.geoms] == ["box"]
    assert any(note.startswith("1 trigger detect") for note in asset.notes)


def test_meshes_of_a_file_with_colliders_are_what_is_seen(scene: SceneFile, tmp_path: Path) -> None:
    body = scene.collider("box", {"type": "box"}, mesh=scene.mesh(angle()))
    scene.tree["nodes"][body]["extensions"][KHR]["motion"] = {}
    scene.node("UCX_seen_all_the_same", box())
    asset = asset_of(scene, tmp_path)
    assert [(len(surface.faces), surface.body) for surface in asset.visuals] == [(20, "box"), (12, None)]


def test_shapes_of_omi_have_other_sizes_where_these_are_left_out(scene: SceneFile, tmp_path: Path) -> None:
    for kind in ("box", "sphere", "cylinder", "capsule"):
        omi(scene, kind, {"type": kind})
    omi(scene, "hull", {"type": "convex", "convex": {"mesh": scene.mesh(angle())}})
    omi(scene, "none", {"type": "trimesh", "trimesh": {}})
    asset = asset_of(scene, tmp_path)
    assert [geom.shape.aabb.size.tolist() for geom in asset.geoms] == [
        [1, 1, 1],
        [1, 1, 1],
        [1, 2, 1],
        [1, 2, 1],
        [3, 3, 1],
    ]
    assert [(o.name, o.reason) for o in asset.non_convex] == [("none", "its collider names no mesh")]


def test_a_capsule_of_one_radius_tells_its_whole_height_one_of_two_that_of_its_straight_part(tmp_path: Path) -> None:
    scene = SceneFile()
    omi(scene, "old", {"type": "capsule", "capsule": {"radius": 1, "height": 6}})
    omi(scene, "new", {"type": "capsule", "capsule": {"radiusTop": 1, "radiusBottom": 1, "height": 6}})
    omi(scene, "ball", {"type": "capsule", "capsule": {"radius": 1, "height": 2}})
    shapes = [geom.shape for geom in asset_of(scene, tmp_path).geoms]
    assert [shape.aabb.size.tolist() for shape in shapes] == [[2, 6, 2], [2, 8, 2], [2, 2, 2]]
    assert [shape.kind for shape in shapes] == ["capsule", "capsule", "sphere"]


def test_bodies_of_omi_are_told_by_motion_or_by_type(scene: SceneFile, tmp_path: Path) -> None:
    inside = [omi(scene, name, {"type": "box"}) for name in ("a", "b")]
    scene.node("new", extensions={"OMI_physics_body": {"motion": {"type": "dynamic"}}}, children=inside[:1])
    scene.node("old", extensions={"OMI_physics_body": {"type": "rigid"}}, children=inside[1:])
    assert [geom.name for geom in asset_of(scene, tmp_path).geoms] == ["new/a", "old/b"]


@pytest.mark.parametrize(
    ("draft", "standard"), [("OMI_collider", "OMI_physics_shape"), ("KHR_collision_shapes", "KHR_implicit_shapes")]
)
def test_drafts_of_the_extensions_are_refused_with_their_names_now(tmp_path: Path, draft: str, standard: str) -> None:
    scene = SceneFile.of(("box", box()))
    scene.uses(draft)
    with pytest.raises(AssetError) as caught:
        asset_of(scene, tmp_path)
    assert caught.value.message == (
        f"{tmp_path / 'a.glb'}: its colliders are those of {draft}, a draft of {standard}, which is not read\n"
        f"  Export it with {standard}."
    )
