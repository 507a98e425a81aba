"""Files that are named for Unreal, Godot and Unity: what is seen, what collides, what is told, and edits of them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from meshforge.checks import check
from meshforge.common import AssetError, UsageError
from meshforge.formats import EngineName, MarkName, read, save
from meshforge.geometry import Box, Pose, convex_hull
from meshforge.symbolic import Geom, NonConvexPiece, Surface, SymbolicMesh
from tests.conversion_samples import SAMPLES, block, foreign, wedge
from tests.gltf_edited import names
from tests.gltf_files import SceneFile, tree_of
from tests.gltf_validation import errors
from tests.soups import angle, box, together
from tests.unit.formats.test_marked_convex import write_obj

NAMED: list[tuple[EngineName, str]] = [("unreal", ".glb"), ("unreal", ".gltf"), ("godot", ".glb"), ("unity", ".gltf")]


def made(shape: Box, parent: str) -> Geom:
    return Geom(f"{parent}~1", "body", shape, parent)


def test_groups_of_an_obj_with_names_for_unreal_are_read_as_all_others_and_that_is_said(tmp_path: Path) -> None:
    path = write_obj(tmp_path / "gate.obj", box(), "UCX_gate_00")
    asset = read(path)
    assert names(asset) == ["UCX_gate_00"]
    assert asset.notes == (
        "its groups with names for Unreal (UCX_ and the like) are read as all others: such names count in glTF",
    )


# Making files


@pytest.mark.parametrize("sample", SAMPLES)
def test_the_khronos_validator_finds_no_error_in_named_files(sample: str, tmp_path: Path) -> None:
    paths = [save(SAMPLES[sample](), tmp_path / n / f"a{suffix}", names=n).path for n, suffix in NAMED]
    assert errors(paths) == [{}] * len(paths)


def test_what_is_seen_of_a_body_is_one_mesh_of_its_colours(tmp_path: Path) -> None:
    saved = save(SAMPLES["doors"](), tmp_path / "a.glb", names="unity")
    tree = tree_of(saved.path.read_bytes())
    door = next(node for node in tree["nodes"] if node["name"] == "door")
    assert [part["material"] for part in tree["meshes"][door["mesh"]]["primitives"]] == [0]
    assert [surface.rgba for surface in read(saved.path).visuals].count((1.0, 0.25, 0.0, 1.0)) == 1


def test_where_nothing_is_seen_unreal_gets_what_collides_to_show_and_others_nothing(tmp_path: Path) -> None:
    asset = SAMPLES["crowd"]()
    saved = save(asset, tmp_path / "a.glb", names="unreal")
    assert "Unreal needs a mesh to be seen: what collides stands for it in left, right, base" in saved.notes
    shown = trimesh.load_scene(saved.path).geometry
    hulls = [geom.shape.tessellate() for geom in asset.geoms if geom.body == "left"]
    assert shown["left"].volume == pytest.approx(sum(hull.volume for hull in hulls))
    for other in ("godot", "unity"):
        assert not read(save(asset, tmp_path / other / "a.glb", names=other).path).visuals


def test_what_is_no_hull_never_becomes_one_for_unreal(tmp_path: Path) -> None:
    asset = SAMPLES["opaque"]()
    bare = save(asset, tmp_path / "bare.glb", names="unreal")
    vertices, faces = box()
    shown = replace(asset, visuals=(Surface(vertices, faces, "room"),))
    seen = save(shown, tmp_path / "seen.glb", names="unreal")
    told = {loss.kind.many: loss.instead for saved in (bare, seen) for loss in saved.report.lost}
    assert told["opaque pieces"] is None  # the body shows something of its own
    assert [loss.instead for loss in bare.report.lost if loss.kind.many == "opaque pieces"] == [
        "written to be seen alone"
    ]
    for saved in (bare, seen):
        assert names(read(saved.path)) == ["UBX_room_00"]
    walls = NonConvexPiece("walls", "body", "not convex", Surface(*angle()))
    only = foreign({"body": Pose.identity()}, [], walls)
    with pytest.raises(AssetError, match="there is no hull to write"):
        save(only, tmp_path / "only.glb", names="unreal")
    assert [piece.name for piece in read(save(only, tmp_path / "g.glb", names="godot").path).non_convex] == [
        "walls-colonly"
    ]


def test_the_one_body_of_a_file_without_bodies_is_called_after_the_file(tmp_path: Path) -> None:
    asset = foreign({"body": Pose.identity()}, [("leg", "body", wedge(0))])
    saved = save(asset, tmp_path / "old table.glb", names="unreal")
    nodes = tree_of(saved.path.read_bytes())["nodes"]
    assert [node["name"] for node in nodes] == ["old_table", "UCX_old_table_00"]


def test_hulls_beyond_the_limits_of_unity_are_errors() -> None:
    rng = np.random.default_rng(1)
    ball = rng.normal(size=(400, 3))
    large = convex_hull(ball / np.linalg.norm(ball, axis=1, keepdims=True))
    flat = convex_hull(ball[:200] / np.linalg.norm(ball[:200], axis=1, keepdims=True))  # 200 vertices, 396 faces
    asset = foreign(
        {"body": Pose.identity()}, [("ball", "body", large), ("many", "body", flat), ("leg", "body", wedge(5))]
    )
    findings = check(SymbolicMesh.of(asset), "unity")
    assert {name for finding in findings if finding.severity == "error" for name in finding.hulls} == {"ball", "many"}


# Names for Unity, read and edited


def closet() -> SceneFile:
    scene = SceneFile()
    hulls = [scene.node("side", box()), scene.node("door", box((2, 0, 0)))]
    group = scene.node("closet_colliders", children=hulls)
    scene.node("closet", angle(), children=[group], translation=[0, 0, 7])
    return scene


def test_what_lies_below_a_node_of_colliders_collides_and_the_rest_is_seen(tmp_path: Path) -> None:
    asset = read(closet().write(tmp_path / "a.gltf"))
    assert names(asset) == ["side", "door"] and len(asset.visuals) == 1
    assert asset.geoms[0].shape.aabb.min[2] == 7
    assert asset.notes[0] == "its collision is what lies below nodes called _colliders, as files for Unity have it"


def test_hulls_made_for_unity_lie_below_the_same_node(tmp_path: Path) -> None:
    asset = read(closet().write(tmp_path / "a.gltf"))
    parentless = Geom("new", "body", block(0, 5, 0))
    geoms = [asset.geoms[1], made(Box(Pose.of_translation([0, 3, 7]), np.full(3, 0.5)), "side"), parentless]
    saved = save(asset.with_geoms(geoms), tmp_path / "out" / "a.gltf")
    after = read(saved.path)
    assert sorted(names(after)) == ["door", "new", "side~1"] and len(after.visuals) == 1
    assert {g.name: g.shape.aabb.center.round(6).tolist() for g in after.geoms}["side~1"] == [0, 3, 7]
    with pytest.raises(AssetError, match="leaves no collision"):
        save(asset.with_geoms([]), tmp_path / "none.gltf")


def test_pieces_that_an_edit_puts_below_their_node_do_not_make_a_file_one_for_unity(tmp_path: Path) -> None:
    three = together(box(), box((2, 0, 0)), box((4, 0, 0)))
    scene = SceneFile.of(("top", box((0, 5, 0))), ("all_colliders", three))
    asset = read(scene.write(tmp_path / "a.gltf"))
    left = [geom for geom in asset.geoms if geom.name != "all_colliders#1"]
    after = read(save(asset.with_geoms(left), tmp_path / "out" / "a.gltf", collision="replace").path)
    assert names(after) == ["top", "all_colliders#0", "all_colliders#2"] and not after.visuals


# Errors


@pytest.mark.parametrize(
    ("place", "engine", "message"),
    [
        ("a.obj", "godot", "OBJ files cannot be named for Godot\n  Formats that can: .glb, .gltf."),
        ("a.urdf", "unreal", "URDF files cannot be named for Unreal\n  Formats that can: .glb, .gltf."),
        ("a.gltf", "usd", "glTF files cannot be marked by UsdPhysics\n  Formats that can: .usda, .usd, .usdc, .usdz."),
        ("a.usda", "unity", "USD files cannot be named for Unity\n  Formats that can: .glb, .gltf."),
        ("a", "unreal", "a folder of mesh files cannot be named for Unreal\n  Formats that can: .glb, .gltf."),
    ],
)
def test_formats_without_such_names_are_refused(place: str, engine: MarkName, message: str, tmp_path: Path) -> None:
    with pytest.raises(UsageError) as caught:
        save(SAMPLES["crowd"](), tmp_path / place, names=engine)
    assert caught.value.message == message
    assert not list(tmp_path.iterdir())
