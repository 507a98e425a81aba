"""What is seen stays: glTF scenes in which nothing is marked as collision, edited through the command line and read by
trimesh, and by hand where the bytes count."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from meshforge.formats import labels_beside, read
from meshforge.language import Program
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh, read_labels, transfer_labels
from tests.engine_rules import godot_word, unreal_target
from tests.gltf_files import KHR, buffer_of, tree_of
from tests.gltf_validation import errors
from tests.loop.command import meshforge_here as meshforge

PROGRAM = "Is(leg) => Replace(box)\n"
SEEN = ("nodes", "meshes", "accessors", "bufferViews", "materials", "textures", "images", "samplers")


def scene() -> trimesh.Scene:
    """A textured ring, which is no hull, above a ball and a leg, each under another transform."""
    made, rng = trimesh.Scene(), np.random.default_rng(0)
    ring = trimesh.creation.torus(0.5, 0.15, major_sections=12, minor_sections=8)
    picture = Image.fromarray(rng.integers(0, 255, (4, 4, 3), dtype=np.uint8))
    ring.visual = trimesh.visual.TextureVisuals(uv=rng.random((len(ring.vertices), 2)), image=picture)  # type: ignore[no-untyped-call]
    made.add_geometry(ring, node_name="ring", geom_name="ring", transform=_place(0, 0, 2))
    turned = trimesh.transformations.rotation_matrix(0.3, [1, 2, 3])  # type: ignore[no-untyped-call]
    turned[:3, :3] *= 2
    made.add_geometry(trimesh.creation.icosphere(1, 0.3), node_name="ball", geom_name="ball", transform=turned)
    stretched = _place(-1, 0, 0) @ np.diag([1, 2, 3, 1.0])
    leg = trimesh.creation.cylinder(0.2, 1, sections=12)
    made.add_geometry(leg, node_name="leg", geom_name="leg", transform=stretched)
    return made


def _place(x: float, y: float, z: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.asarray(trimesh.transformations.translation_matrix([x, y, z]))  # type: ignore[no-untyped-call]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with the scene as GLB and as text, labels, and a program."""
    for place in (tmp_path / "in", tmp_path / "in" / "text"):
        place.mkdir()
        (place / "scene.labels.json").write_text('{"hulls": {"leg": "leg", "ball": "ball"}}')
    scene().export(tmp_path / "in" / "scene.glb")  # type: ignore[no-untyped-call]
    for name, data in trimesh.exchange.gltf.export_gltf(scene()).items():  # type: ignore[no-untyped-call]
        (tmp_path / "in" / "text" / name.replace("model.gltf", "scene.gltf")).write_bytes(data)
    (tmp_path / "p.mf").write_text(PROGRAM)
    return tmp_path


def assert_seen_alike(source: Path, out: Path) -> None:
    """What trimesh shows is the same, and so is all that the file says of it, number by number and byte by byte."""
    before, after = trimesh.load_scene(source, process=False), trimesh.load_scene(out, process=False)
    for node in before.graph.nodes_geometry:
        (place, name), (same, other) = before.graph[node], after.graph[node]
        np.testing.assert_array_equal(place, same)
        old, new = before.geometry[name], after.geometry[other]
        np.testing.assert_array_equal(old.vertices, new.vertices)
        np.testing.assert_array_equal(old.faces, new.faces)
        assert old.visual.kind == new.visual.kind
        if old.visual.kind == "texture":
            np.testing.assert_array_equal(old.visual.uv, new.visual.uv)
            assert old.visual.material.baseColorTexture.tobytes() == new.visual.material.baseColorTexture.tobytes()
    then, now = tree_of(source.read_bytes()), tree_of(out.read_bytes())
    for key in SEEN:
        assert now.get(key, [])[: len(then.get(key, []))] == then.get(key, []), key
    if source.suffix == ".glb":
        assert buffer_of(out).startswith(buffer_of(source))
    for buffer in then["buffers"]:
        if "uri" in buffer:
            assert (out.parent / buffer["uri"]).read_bytes() == (source.parent / buffer["uri"]).read_bytes()


def colliders(path: Path) -> dict[str, dict[str, Any]]:
    """The geometry of each collider, by the name of its node; none of these nodes is seen."""
    found = [node for node in tree_of(path.read_bytes())["nodes"] if KHR in node.get("extensions", {})]
    assert not any("mesh" in node for node in found)
    return {node["name"]: node["extensions"][KHR]["collider"]["geometry"] for node in found}


@pytest.mark.parametrize("name", ["scene.glb", "text/scene.gltf"])
def test_an_edit_leaves_what_is_seen_and_marks_its_hulls_beside_it(folder: Path, name: str) -> None:
    told = meshforge("apply", "p.mf", "in", "--out", "out", "--workers", "2", cwd=folder).out
    assert told.count("note: nothing was marked as collision: what is seen stays, and the hulls are beside it") == 2
    source, out = folder / "in" / name, folder / "out" / name
    assert_seen_alike(source, out)
    assert len(trimesh.load_scene(out, process=False).graph.nodes_geometry) == 3  # the ring is still there
    assert {hull: "convexHull" in g or "shape" in g for hull, g in colliders(out).items()} == {
        "ball": True,
        "leg": True,
        "ring": False,
    }
    after = read(out)
    assert sorted(geom.name for geom in after.geoms) == ["ball", "leg"] and len(after.visuals) == 3
    assert json.loads(out.with_name("scene.labels.json").read_text())["hulls"].keys() == {"ball", "leg"}
    assert errors([out]) == errors([source])


def test_a_hull_that_no_edit_touched_is_the_one_that_was_read(folder: Path) -> None:
    meshforge("apply", "p.mf", "in/scene.glb", "--out", "out", cwd=folder)
    old = {geom.name: geom.shape for geom in read(folder / "in" / "scene.glb").geoms}
    new = {geom.name: geom.shape for geom in read(folder / "out" / "scene.glb").geoms}
    np.testing.assert_allclose(sorted(new["ball"].vertices.tolist()), sorted(old["ball"].vertices.tolist()), rtol=1e-12)


def test_a_second_run_reads_the_marked_hulls_and_does_not_double_them(folder: Path) -> None:
    meshforge("apply", "p.mf", "in/scene.glb", "--out", "out", cwd=folder)
    first = folder / "out" / "scene.glb"
    meshforge("convert", "out/scene.glb", "copy.glb", "--collision", "beside", cwd=folder)
    assert (folder / "copy.glb").read_bytes() == first.read_bytes()
    told = meshforge("apply", "p.mf", "out/scene.glb", "--out", "again", cwd=folder).out
    assert "beside" not in told
    assert sorted(colliders(folder / "again" / "scene.glb")) == ["ball", "leg", "ring"]
    assert_seen_alike(folder / "in" / "scene.glb", folder / "again" / "scene.glb")


def test_every_asset_of_a_run_is_marked_whether_the_program_changed_it_or_not(folder: Path) -> None:
    (folder / "nothing.mf").write_text("labels door, ball, leg\n\nIs(door) => Delete\n")
    (line,) = meshforge("apply", "nothing.mf", "in/scene.glb", "--out", "out", "--json", cwd=folder).lines
    assert line["status"] == "unchanged"
    assert sorted(colliders(folder / "out" / "scene.glb")) == ["ball", "leg", "ring"]
    assert_seen_alike(folder / "in" / "scene.glb", folder / "out" / "scene.glb")


def test_replace_puts_hulls_in_the_place_of_what_is_seen(folder: Path) -> None:
    told = meshforge("apply", "p.mf", "in/scene.glb", "--out", "out", "--collision", "replace", cwd=folder).out
    assert "note: nothing was marked as collision: the hulls are in the place of what was seen" in told
    shown = trimesh.load_scene(folder / "out" / "scene.glb").graph.nodes_geometry
    assert sorted(shown) == ["ball", "leg_1", "ring"]
    assert "extensionsUsed" not in tree_of((folder / "out" / "scene.glb").read_bytes())


def test_unreal_finds_the_hulls_beside_the_meshes_that_they_are_of(folder: Path) -> None:
    meshforge("apply", "p.mf", "in/scene.glb", "--out", "out", "--names", "unreal", cwd=folder)
    out = folder / "out" / "scene.glb"
    assert_seen_alike(folder / "in" / "scene.glb", out)
    tree = tree_of(out.read_bytes())
    made = [node["name"] for node in tree["nodes"] if node.get("name", "").startswith("U")]
    assert made == ["UCX_ball_00", "UBX_leg_00"]
    assert {name: unreal_target(name, {"ball", "leg", "ring"}) for name in made} == {made[0]: "ball", made[1]: "leg"}
    leg = next(node for node in tree["nodes"] if node.get("name") == "leg")
    assert next(node for node in tree["nodes"] if node.get("name") == made[1])["matrix"] == leg["matrix"]
    assert len(read(out).visuals) == 3


def test_meshes_that_unreal_cannot_tell_apart_are_named(folder: Path) -> None:
    source = folder / "in" / "text" / "scene.gltf"
    tree = json.loads(source.read_bytes())
    for node in tree["nodes"]:
        if node["name"] == "ball":
            node["mesh"] = next(other["mesh"] for other in tree["nodes"] if other["name"] == "leg")
    source.write_text(json.dumps(tree))
    told = meshforge("apply", "p.mf", "in/text", "--out", "out", "--names", "unreal", cwd=folder).out
    assert "Unreal finds the mesh of a hull by its name: rename those that have none, or share one (leg)" in told


@pytest.mark.parametrize("names", ["godot", "unity"])
def test_godot_and_unity_find_the_hulls_beside_what_is_seen(folder: Path, names: str) -> None:
    meshforge("convert", "in/text/scene.gltf", "out/scene.gltf", "--names", names, cwd=folder)
    out = folder / "out" / "scene.gltf"
    assert_seen_alike(folder / "in" / "text" / "scene.gltf", out)
    nodes = tree_of(out.read_bytes())["nodes"]
    if names == "godot":
        words = {node["name"]: godot_word(node["name"]) for node in nodes}
        assert {name: word for name, word in words.items() if word} == {
            "ball-convcolonly": "convcolonly",
            "leg-convcolonly": "convcolonly",
            "ring-colonly": "colonly",
        }
    else:
        (group,) = [node for node in nodes if node["name"] == "scene_colliders"]
        assert len(group["children"]) == 3
    assert len(read(out).geoms) == 2 and len(read(out).visuals) == 3
    assert errors([out]) == errors([folder / "in" / "text" / "scene.gltf"])


def test_a_hull_moves_with_the_animated_node_that_it_comes_from(folder: Path) -> None:
    source = folder / "in" / "text" / "scene.gltf"
    tree = json.loads(source.read_bytes())
    leg = next(k for k, node in enumerate(tree["nodes"]) if node["name"] == "leg")
    del tree["nodes"][leg]["matrix"]
    times = next(k for k, accessor in enumerate(tree["accessors"]) if accessor["type"] == "VEC3")
    sampler = {"input": times, "output": times}
    tree["animations"] = [
        {"samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": leg, "path": "scale"}}]}
    ]
    source.write_text(json.dumps(tree))
    meshforge("apply", "p.mf", "in/text/scene.gltf", "--out", "out", cwd=folder)
    nodes = tree_of((folder / "out" / "scene.gltf").read_bytes())["nodes"]
    assert [nodes[k]["name"] for k in nodes[leg]["children"]] == ["leg"]


def test_convert_copies_an_unmarked_file_unless_marks_are_asked_for(folder: Path) -> None:
    meshforge("convert", "in/scene.glb", "copy.glb", cwd=folder)
    assert (folder / "copy.glb").read_bytes() == (folder / "in" / "scene.glb").read_bytes()
    meshforge("convert", "in/scene.glb", "marked.glb", "--names", "khr", cwd=folder)
    assert sorted(colliders(folder / "marked.glb")) == ["ball", "leg", "ring"]
    meshforge("convert", "in", "all", "--to", ".glb", "--collision", "beside", cwd=folder)
    assert sorted(colliders(folder / "all" / "text" / "scene.glb")) == ["ball", "leg", "ring"]


def test_a_project_goes_by_the_option_and_writes_again_what_it_changes(folder: Path) -> None:
    project = Project.create(folder / "project", [folder / "in" / "scene.glb"], vocabulary=["leg", "ball"])
    meshforge("label", "project", "--with", "file", cwd=folder)
    project.accept(Program.parse(PROGRAM))
    dry = meshforge("apply", "project", "--dry-run", cwd=folder).out
    assert "what is seen stays, and the hulls are beside it" in dry and not list((folder / "project").rglob("*.glb"))
    out = folder / "project" / "edited" / "scene.glb"
    said = [[], [], ["--collision", "replace"], ["--collision", "replace"], ["--names", "godot"]]
    states = [meshforge("apply", "project", "--json", *words, cwd=folder).lines[0]["status"] for words in said]
    assert states == ["edited", "skipped", "edited", "skipped", "edited"]
    assert_seen_alike(folder / "in" / "scene.glb", out)
    assert "leg-convcolonly" in {node["name"] for node in tree_of(out.read_bytes())["nodes"]}


def test_marks_that_a_format_cannot_have_are_one_error_before_anything_is_written(folder: Path) -> None:
    told = meshforge("apply", "p.mf", "in", "--out", "out", "--names", "usd", cwd=folder, code=2).err
    assert "in/scene.glb: glTF files cannot be marked by UsdPhysics" in told and told.count("error") == 1
    assert not (folder / "out").exists()


def test_labels_beside_the_result_are_those_of_its_hulls_as_they_read_back(folder: Path) -> None:
    (folder / "p.mf").write_text("Is(ball) => Replace(cylinder, tight)\nIs(leg) => Replace(cylinder)\n")
    assert meshforge("apply", "p.mf", "in", "--out", "out", "--workers", "1", cwd=folder).code == 0
    told = meshforge("convert", "out/scene.glb", "urdf/scene.urdf", cwd=folder)
    assert "changed since they were labelled" not in told.out + told.err
    for path in (folder / "out" / "scene.glb", folder / "urdf" / "scene.urdf"):
        followed = transfer_labels(read_labels(labels_beside(path)), SymbolicMesh.of(read(path)))
        assert followed.changed == () and len(followed.mesh.labels) == 2
