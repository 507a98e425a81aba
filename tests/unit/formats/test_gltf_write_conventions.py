"""Edits of glTF files in the conventions of Unreal, of Godot and of the physics extensions."""

from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Pose, Shape, Sphere, convex_hull, is_same_shape
from meshforge.symbolic import Geom
from tests.gltf_edited import Edited, brick, names, three_legs
from tests.gltf_files import KHR, SHAPES, SceneFile
from tests.soups import angle, box

# Unreal


def crate() -> SceneFile:
    return SceneFile.of(("crate", angle()), ("UCX_crate_01", box()), ("UBX_crate_02", box((2, 0, 0))))


def test_hulls_made_for_unreal_have_its_names_and_numbers(tmp_path: Path) -> None:
    case = Edited(crate(), tmp_path)
    shapes: list[Shape] = [
        convex_hull(box((5, 0, 0))[0]),
        Box(Pose.of_translation([7, 0, 0]), np.full(3, 0.5)),
        Sphere(Pose.of_translation([9, 0, 0]), 0.5),
        Capsule(Pose.of_translation([11, 0, 0]), 0.5, 0.5),
        Cylinder(Pose.of_translation([13, 0, 0]), 0.5, 0.5),
    ]
    made = [Geom(f"UCX_crate_01~{k}", "body", shape, "UCX_crate_01") for k, shape in enumerate(shapes, 1)]
    after = case.edit(gone=["UCX_crate_01"], made=made)
    assert case.saved.names == {
        "UCX_crate_01~1": "UCX_crate_03",
        "UCX_crate_01~2": "UBX_crate_04",
        "UCX_crate_01~3": "USP_crate_05",
        "UCX_crate_01~4": "UCP_crate_06",
        "UCX_crate_01~5": "UCX_crate_07",
    }
    kinds = {geom.name: geom.shape.kind for geom in after.geoms}
    assert [kinds[name] for name in case.saved.names.values()] == ["polytope", "box", "sphere", "capsule", "polytope"]
    assert "1 cylinder written as hull meshes: Unreal has no cylinder" in case.saved.notes
    assert "crate" not in kinds and len(after.visuals) == 1


# Godot


def test_collision_told_by_the_name_of_a_mesh_goes_from_one_node_only(tmp_path: Path) -> None:
    scene = SceneFile()
    mesh = scene.mesh(box(), name="box-col")
    scene.node("left", mesh=mesh)
    scene.node("right", mesh=mesh, translation=[3, 0, 0])
    case = Edited(scene, tmp_path)
    assert names(case.before) == ["box-col", "box-col@2"]
    after = case.edit(gone=["box-col@2"])
    assert names(after) == ["box-col"]
    assert len(after.visuals) == 2
    assert case.trees[1]["meshes"][1]["name"] == "box"


def test_hulls_made_for_godot_are_convex_and_not_seen(tmp_path: Path) -> None:
    case = Edited(SceneFile.of(("chair-col", box())), tmp_path)
    after = case.edit(gone=["chair-col"], made=[brick((3, 0, 0), "chair-col~1", "chair-col")])
    assert case.saved.names == {"chair-col~1": "chair~1-convcolonly"}
    assert names(after) == ["chair~1-convcolonly"]
    assert [len(surface.faces) for surface in after.visuals] == [12]


# physics extensions


def jar() -> SceneFile:
    """A moving jar with a mesh that is seen, a lid beside it, and a material of contact."""
    scene = SceneFile()
    wall = scene.collider("wall", {"type": "box"}, mesh=scene.mesh(angle()))
    own = scene.tree["nodes"][wall]["extensions"][KHR]["collider"]
    own |= {"physicsMaterial": 0, "collisionFilter": 0, "extras": {"mind": "this"}}
    base = scene.collider("base", {"type": "sphere"}, translation=[0, -2, 0])
    scene.node("jar", children=[wall, base], extensions={KHR: {"motion": {"mass": 2}}}, translation=[0, 5, 0])
    scene.collider("floor", {"type": "box", "box": {"size": [9, 1, 9]}})
    materials = {"physicsMaterials": [{"staticFriction": 0.5}], "collisionFilters": [{"collisionSystems": ["a"]}]}
    scene.tree["extensions"][KHR] = materials
    return scene


def test_a_collider_goes_and_the_mesh_of_its_node_stays(tmp_path: Path) -> None:
    case = Edited(jar(), tmp_path)
    after = case.edit(gone=["jar/wall"])
    assert names(after) == ["jar/base", "body/floor"]
    assert len(after.visuals) == 1
    before, tree = case.trees
    del before["nodes"][0]["extensions"]
    assert tree == before


def test_made_colliders_are_native_shapes_with_all_else_of_their_parent(tmp_path: Path) -> None:
    case = Edited(jar(), tmp_path)
    turn = Pose.from_rpy([1, 2, 3], [0.3, 0.2, 0.1])
    shapes: list[Shape] = [
        Box(turn, np.array([0.5, 1, 2])),
        Sphere(turn, 0.25),
        Cylinder(turn, 0.5, 1.5),
        Capsule(turn, 0.5, 1.5),
        convex_hull(angle()[0]),
        Ellipsoid(turn, np.array([0.5, 1, 2])),
    ]
    made = [Geom(f"jar/wall~{k}", "jar", shape, "jar/wall") for k, shape in enumerate(shapes, 1)]
    after = case.edit(gone=["jar/wall"], made=made)
    back = {geom.name: geom.shape for geom in after.geoms}
    assert not case.saved.names
    assert {geom.body for geom in after.geoms if "~" in geom.name} == {"jar"}
    for geom in made[:4]:
        assert is_same_shape(back[geom.name], geom.shape, 1e-9)
    assert back["jar/wall~5"].volume == pytest.approx(shapes[4].volume, rel=1e-5)
    assert back["jar/wall~6"].kind == "polytope"
    assert "1 ellipsoid written as hull meshes: the extension has no ellipsoid" in case.saved.notes
    for node in case.trees[1]["nodes"]:
        if "~" in node.get("name", "") and "extensions" in node:
            collider = node["extensions"][KHR]["collider"]
            assert {k: v for k, v in collider.items() if k != "geometry"} == {
                "physicsMaterial": 0,
                "collisionFilter": 0,
                "extras": {"mind": "this"},
            }


def test_a_made_hull_on_a_body_that_is_itself_a_collider_goes_below_it(tmp_path: Path) -> None:
    scene = SceneFile()
    crate = scene.collider("crate", {"type": "box"}, translation=[4, 0, 0])
    scene.tree["nodes"][crate]["extensions"][KHR]["motion"] = {}
    case = Edited(scene, tmp_path)
    after = case.edit(gone=["crate/crate"], made=[brick((3, 0, 0), "crate/crate~1", "crate/crate", "crate")])
    assert [(geom.name, geom.body) for geom in after.geoms] == [("crate/crate~1", "crate")]
    assert case.trees[1]["nodes"][crate]["extensions"][KHR] == {"motion": {}}


def test_pieces_of_a_collider_become_colliders_of_their_own(tmp_path: Path) -> None:
    scene = SceneFile()
    mesh = scene.mesh(three_legs())
    scene.uses(KHR)
    scene.node("legs", extensions={KHR: {"collider": {"geometry": {"mesh": mesh}, "physicsMaterial": 0}}}, mesh=mesh)
    scene.tree["extensions"] = {KHR: {"physicsMaterials": [{}]}}
    case = Edited(scene, tmp_path)
    after = case.edit(gone=["legs#1"])
    assert names(after) == ["legs#0", "legs#2"]
    assert [len(surface.faces) for surface in after.visuals] == [36]
    child = case.trees[1]["nodes"][case.trees[1]["nodes"][0]["children"][0]]
    assert child["extensions"][KHR]["collider"]["physicsMaterial"] == 0


def test_the_extensions_of_omi_are_written_in_their_own_form(tmp_path: Path) -> None:
    scene = SceneFile()
    shape = {"type": "box", "box": {"size": [1, 1, 1]}}
    scene.tree["extensions"] = {"OMI_physics_shape": {"shapes": [shape]}}
    own = {"OMI_physics_body": {"collider": {"shape": 0}}}
    scene.node("box", extensions=own)
    scene.node("other", extensions=own, translation=[3, 0, 0])
    scene.uses("OMI_physics_shape", *own)
    made = [
        Geom("box~1", "body", Capsule(Pose.of_translation([0, 5, 0]), 0.5, 1.0), "box"),
        Geom("box~2", "body", Cylinder(Pose.of_translation([0, 9, 0]), 0.5, 1.0), "box"),
        Geom("box~3", "body", convex_hull(angle()[0]), "box"),
    ]
    case = Edited(scene, tmp_path)
    after = case.edit(gone=["box"], made=made)
    back = {geom.name: geom.shape for geom in after.geoms}
    assert is_same_shape(back["box~1"], made[0].shape, 1e-9) and is_same_shape(back["box~2"], made[1].shape, 1e-9)
    assert back["box~3"].volume == pytest.approx(made[2].shape.volume, rel=1e-5)


def test_a_hull_on_a_body_that_is_not_there_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match="is on 'nowhere', which is no body of the file"):
        Edited(jar(), tmp_path).edit(made=[brick((0, 0, 0), "x", None, "nowhere")])


def test_shapes_extension_is_told_as_used_when_the_first_shape_is_made(tmp_path: Path) -> None:
    scene = SceneFile()
    scene.uses(KHR)
    scene.node("hull", extensions={KHR: {"collider": {"geometry": {"mesh": scene.mesh(box()), "convexHull": True}}}})
    case = Edited(scene, tmp_path)
    case.edit(made=[Geom("hull~1", "body", Sphere(Pose.of_translation([5, 0, 0]), 1.0), "hull")])
    assert case.trees[1]["extensionsUsed"] == [KHR, SHAPES]
