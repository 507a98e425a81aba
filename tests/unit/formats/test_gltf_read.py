import pickle
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import load, read, read_triangles, save
from meshforge.geometry import Capsule, Pose, Shape, Sphere
from meshforge.symbolic import Asset
from tests.gltf_edited import names
from tests.gltf_files import KHR, SceneFile, glb_of, tree_of
from tests.soups import Soup, angle, box, together, turned

HALF = float(np.sqrt(0.5))


def asset_of(scene: SceneFile, folder: Path, suffix: str = ".glb") -> Asset:
    return read(scene.write(folder / f"a{suffix}"))


def bounds(shape: Shape | None) -> list[list[float]]:
    assert shape is not None
    return [np.round(side, 6).tolist() for side in (shape.aabb.min, shape.aabb.max)]


def shape_of(asset: Asset, name: str) -> Shape:
    return next(geom.shape for geom in asset.geoms if geom.name == name)


def two_boxes() -> Soup:
    return together(box(), box((2, 0, 0)))


# all meshes as collision


def test_without_any_mark_each_convex_piece_of_each_node_is_a_hull(tmp_path: Path) -> None:
    asset = asset_of(SceneFile.of(("legs", two_boxes()), ("top", box((0, 0, 5))), ("corner", angle())), tmp_path)
    assert names(asset) == ["legs#0", "legs#1", "top"]
    assert [(o.name, o.reason[:10]) for o in asset.non_convex] == [("corner", "not convex")]
    assert [body.name for body in asset.bodies] == ["body"]
    assert not len(asset.visuals)
    assert not asset.notes
    assert load(tmp_path / "a.glb").hulls[0].name == "legs#0"
    assert names(pickle.loads(pickle.dumps(asset))) == names(asset)


def test_that_textured_meshes_are_taken_for_collision_is_told(tmp_path: Path) -> None:
    scene = SceneFile.of(("chair", box()))
    scene.tree["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    assert "all meshes are taken for it" in asset_of(scene, tmp_path).notes[0]


def test_nodes_are_named_after_themselves_then_their_mesh_then_their_number(tmp_path: Path) -> None:
    scene = SceneFile.of((None, box()))
    scene.node(None, mesh=scene.mesh(box((2, 0, 0)), name="leg"))
    scene.node("leg", box((4, 0, 0)))
    scene.node(None, box((6, 0, 0)))
    assert names(asset_of(scene, tmp_path)) == ["geom0", "leg", "leg@2", "geom3"]


def test_transforms_are_those_of_all_nodes_above(tmp_path: Path) -> None:
    scene = SceneFile()
    inner = scene.node("inner", box(), scale=[1, 2, -3])
    turned_node = scene.node("turn", rotation=[0, 0, HALF, HALF], children=[inner])
    scene.node("outer", matrix=[2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1], children=[turned_node])
    shape = asset_of(scene, tmp_path).geoms[0].shape
    assert bounds(shape) == [[6, 0, -3], [10, 1, 0]]
    assert shape.volume == pytest.approx(12)


def test_the_default_scene_is_read_else_the_first_else_all_that_are_no_children(tmp_path: Path) -> None:
    scene = SceneFile.of(("first", box()), ("second", box((2, 0, 0))))
    scene.node("parent", children=[scene.node("child", box((4, 0, 0)))])
    two = {"scenes": [{"nodes": [0]}, {"nodes": [1]}]}
    whole = scene.tree | {"buffers": [{"byteLength": len(scene.data)}]}
    for more, expected in (({**two, "scene": 1}, ["second"]), (two, ["first"]), ({}, ["first", "second", "child"])):
        (tmp_path / "a.glb").write_bytes(glb_of({**whole, **more}, scene.data))
        asset = read(tmp_path / "a.glb")
        assert names(asset) == expected
        told = [note for note in asset.notes if "outside of the scene" in note or "of 2 scenes it is the" in note]
        assert len(told) == (2 if more else 0)


def test_quantized_and_normalized_positions_are_read_with_their_node(tmp_path: Path) -> None:
    scene = SceneFile()
    points, faces = box()
    part = {"attributes": {}, "indices": scene.accessor(faces.astype("<u2").reshape(-1, 1))}
    padded = np.zeros((8, 4), "<i2")
    padded[:, :3] = np.round(points * 32767)
    view = scene.view(padded.tobytes(), byteStride=8)
    accessor = {"bufferView": view, "componentType": 5122, "count": 8, "type": "VEC3", "normalized": True}
    scene.tree["accessors"].append(accessor)
    part["attributes"] = {"POSITION": len(scene.tree["accessors"]) - 1}
    scene.node("box", mesh=scene.mesh(part), scale=[4, 4, 4])
    scene.tree["extensionsRequired"] = ["KHR_mesh_quantization"]
    asset = asset_of(scene, tmp_path)
    assert bounds(asset.geoms[0].shape) == [[0, 0, 0], [4, 4, 4]]
    assert not asset.notes


def test_sparse_accessors_are_filled_in(tmp_path: Path) -> None:
    scene = SceneFile()
    part = scene.primitive(box())
    moved = np.array([[2.0, 1, 0], [2.0, 1, 1]], "<f4")
    scene.tree["accessors"][part["attributes"]["POSITION"]]["sparse"] = {
        "count": 2,
        "indices": {"bufferView": scene.view(np.array([6, 7], "<u1").tobytes()), "componentType": 5121},
        "values": {"bufferView": scene.view(moved.tobytes())},
    }
    scene.node("wedge", mesh=scene.mesh(part))
    assert bounds(asset_of(scene, tmp_path).geoms[0].shape) == [[0, 0, 0], [2, 1, 1]]


def test_a_mesh_that_a_skin_moves_is_not_read_and_that_is_said(tmp_path: Path) -> None:
    scene = SceneFile.of(("table", box()))
    scene.tree["skins"] = [{"joints": [scene.node("bone")]}]
    scene.node("arm", box(), skin=0)
    asset = asset_of(scene, tmp_path)
    assert [(geom.name, piece.name) for geom, piece in zip(asset.geoms, asset.non_convex, strict=True)] == [
        ("table", "arm")
    ]
    assert asset.non_convex[0].reason == "a mesh that a skin moves, which is not read"
    assert "what skins move is not read, and left as it is: 1 mesh" in asset.notes
    saved = save(asset, tmp_path / "out.glb")
    assert tree_of(saved.path.read_bytes())["nodes"][2]["skin"] == 0
    with pytest.raises(AssetError, match="node 'arm' has a mesh that a skin moves, which is not read"):
        read_triangles(asset.path)


def test_nodes_that_show_a_mesh_many_times_are_refused_with_the_remedy(tmp_path: Path) -> None:
    scene = SceneFile()
    scene.node("many", box(), extensions={"EXT_mesh_gpu_instancing": {"attributes": {}}})
    with pytest.raises(AssetError) as caught:
        asset_of(scene, tmp_path)
    assert caught.value.message == (
        f"{tmp_path / 'a.glb'}: node 'many' shows a mesh many times by EXT_mesh_gpu_instancing, which is not read\n"
        "  Give each a node: gltf-transform uninstance."
    )


def test_files_beside_it_are_found_and_missing_pictures_told(tmp_path: Path) -> None:
    scene = SceneFile.of(("box", box()))
    scene.tree["images"] = [{"uri": "a%20b.png"}, {"uri": "gone.png"}]
    (tmp_path / "a b.png").write_bytes(b"")
    asset = asset_of(scene, tmp_path, ".gltf")
    assert [path.name for path in asset.files] == ["a.bin", "a b.png"]
    assert asset.missing == ("gone.png",)


# Unreal's names


def soup_of(shape: Shape) -> Soup:
    return np.asarray(shape.vertices), np.asarray(shape.faces)


def test_unreal_names_are_hulls_boxes_spheres_and_capsules(tmp_path: Path) -> None:
    capsule, ball = Capsule(Pose.identity(), 0.5, 1.0), Sphere(Pose.identity(), 1.0)
    scene = SceneFile.of(("table", angle()), ("UCX_table_01", two_boxes()))
    scene.node("ubx_table_02", box((0, 0, 3)), rotation=[0.2, 0.1, 0, float(np.sqrt(0.95))])
    scene.node("USP_table", soup_of(ball), translation=[5, 0, 0], scale=[2, 2, 2])
    scene.node("UCP_table", soup_of(capsule))
    scene.node(None, mesh=scene.mesh(box((9, 0, 0)), name="UCX_table_03"))
    asset = asset_of(scene, tmp_path)
    assert [(g.name, g.shape.kind) for g in asset.geoms] == [
        ("UCX_table_01", "polytope"),
        ("ubx_table_02", "box"),
        ("USP_table", "sphere"),
        ("UCP_table", "capsule"),
        ("UCX_table_03", "polytope"),
    ]
    assert not asset.non_convex
    assert shape_of(asset, "UCX_table_01").volume == pytest.approx(3)  # one hull around both boxes
    sphere = shape_of(asset, "USP_table")
    assert isinstance(sphere, Sphere) and sphere.radius == pytest.approx(2, abs=1e-6)
    found = shape_of(asset, "UCP_table")
    assert isinstance(found, Capsule)
    assert (found.radius, found.half_length) == pytest.approx((0.5, 1.0), abs=1e-3)
    assert [len(surface.faces) for surface in asset.visuals] == [20]  # the table alone is seen


@pytest.mark.parametrize("prefix", ["UBX", "USP", "UCP"])
def test_a_mesh_that_is_not_what_its_unreal_name_says_is_a_hull_and_told(tmp_path: Path, prefix: str) -> None:
    scene = SceneFile()
    points, faces = box()
    points = points * np.where(points[:, 2:] > 0, [0.5, 0.5, 1], 1)
    scene.node(f"{prefix}_a", (points, faces))
    asset = asset_of(scene, tmp_path)
    assert asset.geoms[0].shape.kind == "polytope"
    assert any("is read as a hull" in note for note in asset.notes)


def test_a_cube_is_no_sphere_though_its_corners_are_all_as_far_from_the_middle(tmp_path: Path) -> None:
    assert asset_of(SceneFile.of(("USP_a", box())), tmp_path).geoms[0].shape.kind == "polytope"


def test_a_flat_ucx_is_opaque(tmp_path: Path) -> None:
    scene = SceneFile.of(("UCX_a", box()))
    points, faces = box()
    scene.node("UCX_b", (points * [1, 1, 0], faces))
    assert [o.name for o in asset_of(scene, tmp_path).non_convex] == ["UCX_b"]


# Godot's names


def test_godot_names_are_hulls_and_pieces(tmp_path: Path) -> None:
    scene = SceneFile.of(
        ("a-col", two_boxes()),
        ("b-convcol", two_boxes()),
        ("c-colonly", together(box(), turned(box((2, 0, 0))))),
        ("d-convcolonly.001", angle()),
        ("e_COL 2", angle()),
        ("f$colonly_x", box()),
        ("seen", box()),
        ("collar", box()),
    )
    scene.node(None, mesh=scene.mesh(box(), name="g-col"))
    asset = asset_of(scene, tmp_path)
    assert names(asset) == [
        "a-col#0",
        "a-col#1",
        "b-convcol",
        "c-colonly#0",
        "c-colonly#1",
        "d-convcolonly.001",
        "f$colonly_x",
        "g-col",
    ]
    assert [o.name for o in asset.non_convex] == ["e_COL 2"]
    assert len(asset.visuals) == 6  # a, b, e, seen, collar and g


def test_unreal_goes_before_godot_and_physics_before_both(tmp_path: Path) -> None:
    scene = SceneFile.of(("a-col", box()), ("UCX_a", box()))
    assert names(asset_of(scene, tmp_path)) == ["UCX_a"]
    scene.collider("ball", {"type": "sphere", "sphere": {"radius": 2}})
    assert names(asset_of(scene, tmp_path)) == ["ball"]


def test_a_node_that_is_only_the_shape_of_a_collider_is_not_said_to_be_outside_of_the_scene(tmp_path: Path) -> None:
    scene = SceneFile.of(("shape", box()), ("nowhere", box((4, 0, 0))))
    scene.node("wall", extensions={KHR: {"collider": {"geometry": {"node": 0, "convexHull": True}}}})
    scene.tree |= {"scenes": [{"nodes": [2]}], "scene": 0}
    asset = asset_of(scene, tmp_path)
    assert names(asset) == ["wall"]
    assert "1 node with a mesh outside of the scene is left as it is" in asset.notes


def test_a_name_that_is_not_utf_8_is_a_message_in_words(tmp_path: Path) -> None:
    (tmp_path / "latin.gltf").write_bytes(b'{"asset": {"version": "2.0"}, "nodes": [{"name": "\xe9"}]}')
    with pytest.raises(AssetError, match="its JSON is not UTF-8 text, from byte"):
        read(tmp_path / "latin.gltf")
