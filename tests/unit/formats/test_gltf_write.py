import json
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from tests.gltf_edited import Edited, brick, names, three_legs
from tests.gltf_files import SceneFile, Tree, chunk, glb_of, tree_of
from tests.gltf_validation import errors
from tests.soups import Soup, angle, box, together


def table() -> SceneFile:
    """A top and legs in one mesh each, a material, and things that no edit touches."""
    scene = SceneFile()
    scene.tree |= {
        "extras": {"made by": "hand", "precise": 1.50},
        "extensionsUsed": ["ACME_unknown"],
        "extensions": {"ACME_unknown": {"nodes": [0]}},
        "materials": [{"name": "wood", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0, 1]}}],
    }
    legs = scene.mesh(scene.primitive(three_legs(), material=0), name="legs mesh")
    scene.node("legs", mesh=legs, translation=[0, 0, 1], extras={"height": 1.0})
    scene.node("top", box((0, 0, 5)))
    return scene


def test_a_removed_hull_takes_its_node_out_of_the_scene_and_no_number_changes(tmp_path: Path) -> None:
    case = Edited(table(), tmp_path)
    assert names(case.edit(gone=["top"])) == ["legs#0", "legs#1", "legs#2"]
    before, after = case.trees
    before["scenes"][0]["nodes"].remove(1)
    del before["nodes"][1]["mesh"]
    assert after == before
    assert [node["name"] for node in after["nodes"]] == ["legs", "top"]


@pytest.mark.parametrize("what", ["animation", "joint", "camera", "extension"])
def test_a_node_that_something_else_hangs_on_stays_in_the_scene_empty(tmp_path: Path, what: str) -> None:
    scene = SceneFile.of(("door", box()), ("frame", box((2, 0, 0))))
    match what:
        case "animation":
            times = scene.accessor(np.array([[0.0], [1.0]], "<f4"), min=[0.0], max=[1.0])
            turns = scene.accessor(np.array([[0, 0, 0, 1], [0, 0, 1, 0]], "<f4"))
            channel = {"sampler": 0, "target": {"node": 0, "path": "rotation"}}
            scene.tree["animations"] = [{"channels": [channel], "samplers": [{"input": times, "output": turns}]}]
        case "joint":
            scene.tree["skins"] = [{"joints": [0]}]
        case "camera":
            scene.tree["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]
            scene.tree["nodes"][0]["camera"] = 0
        case _:
            scene.uses("ACME_note")
            scene.tree["nodes"][0]["extensions"] = {"ACME_note": {"text": "mind the door"}}
    case = Edited(scene, tmp_path)
    case.edit(gone=["door"])
    before, after = case.trees
    del before["nodes"][0]["mesh"]
    assert after == before


def test_a_made_hull_moves_with_the_animated_node_that_it_comes_from(tmp_path: Path) -> None:
    scene = SceneFile()
    scene.node("door", box(), translation=[0, 2, 0], scale=[2, 2, 2])
    times = scene.accessor(np.array([[0.0], [1.0]], "<f4"), min=[0.0], max=[1.0])
    places = scene.accessor(np.array([[0, 0, 0], [0, 0, 1]], "<f4"))
    channel = {"sampler": 0, "target": {"node": 0, "path": "translation"}}
    scene.tree["animations"] = [{"channels": [channel], "samplers": [{"input": times, "output": places}]}]
    case = Edited(scene, tmp_path)
    after = case.edit(gone=["door"], made=[brick((7, 8, 9), "door~1", "door")])
    assert after.geoms[0].shape.aabb.min.tolist() == pytest.approx([7, 8, 9], abs=1e-6)
    assert case.trees[1]["nodes"][0]["children"] == [1]


def test_a_mesh_whose_morphs_are_animated_is_not_taken_away(tmp_path: Path) -> None:
    scene = SceneFile()
    part = scene.primitive(box())
    part["targets"] = [{"POSITION": scene.accessor(np.ones((8, 3), "<f4"))}]
    scene.node("face", mesh=scene.mesh(part))
    scene.node("box", box((5, 0, 0)))
    times = scene.accessor(np.array([[0.0], [1.0]], "<f4"), min=[0.0], max=[1.0])
    weights = scene.accessor(np.array([[0.0], [1.0]], "<f4"))
    channel = {"sampler": 0, "target": {"node": 0, "path": "weights"}}
    scene.tree["animations"] = [{"channels": [channel], "samplers": [{"input": times, "output": weights}]}]
    with pytest.raises(AssetError, match="an animation drives the morph weights of node 'face'"):
        Edited(scene, tmp_path).edit(gone=["face"])


def test_pieces_that_keep_their_names_stay_in_their_node(tmp_path: Path) -> None:
    case = Edited(table(), tmp_path)
    assert names(case.edit(gone=["legs#2"])) == ["legs#0", "legs#1", "top"]
    before, after = case.trees
    part = after["meshes"][0]["primitives"][0]
    assert part["attributes"] == before["meshes"][0]["primitives"][0]["attributes"]
    assert part["material"] == 0 and part["indices"] == len(before["accessors"])
    assert len(after["meshes"]) == len(before["meshes"])
    assert after["nodes"] == before["nodes"]


def test_other_pieces_go_to_nodes_of_their_own_below_with_materials_and_attributes(tmp_path: Path) -> None:
    case = Edited(table(), tmp_path)
    assert names(case.edit(gone=["legs#1"])) == ["legs#0", "legs#2", "top"]
    before, after = case.trees
    legs = after["nodes"][0]
    assert "mesh" not in legs and legs["extras"] == {"height": 1.0} and legs["translation"] == [0, 0, 1]
    for child in legs["children"]:
        part = after["meshes"][after["nodes"][child]["mesh"]]["primitives"][0]
        assert part["attributes"] == before["meshes"][0]["primitives"][0]["attributes"]
        assert part["material"] == 0
    assert not case.saved.names


def with_a_line(scene: SceneFile, soup: Soup) -> int:
    line = {"attributes": {"POSITION": scene.accessor(np.array([[0, 0, 0], [9, 9, 9]], "<f4"))}, "mode": 1}
    return scene.mesh(soup, line)


def modes(tree: Tree) -> dict[str, list[int]]:
    """The modes of the primitives that each node in the scene shows."""
    waiting, found = [*tree["scenes"][0]["nodes"]], {}
    for index in waiting:
        node = tree["nodes"][index]
        waiting += node.get("children", [])
        if "mesh" in node:
            found[node["name"]] = [part.get("mode", 4) for part in tree["meshes"][node["mesh"]]["primitives"]]
    return found


def test_primitives_are_parted_each_and_points_and_lines_stay_in_their_node(tmp_path: Path) -> None:
    scene = SceneFile()
    points, faces = together(box(), box((4, 0, 0)))
    line = scene.primitive(box(), mode=1)
    del line["indices"]
    first, second, third = faces[:12], faces[12:18], faces[18:]
    scene.node("set", mesh=scene.mesh((points, first), line, (points, second), (points, third)))
    case = Edited(scene, tmp_path)
    assert names(case.edit(gone=["set#0"])) == ["set#1"]
    assert modes(case.trees[1]) == {"set": [1], "set#1": [4, 4]}


@pytest.mark.parametrize("name", ["legs", "UCX_legs", "legs-colonly", "legs-convcolonly"])
def test_points_and_lines_of_a_removed_hull_stay_in_the_scene(tmp_path: Path, name: str) -> None:
    scene = SceneFile()
    scene.node(name, mesh=with_a_line(scene, box()))
    scene.node(name.replace("legs", "top"), box((5, 0, 0)))
    case = Edited(scene, tmp_path)
    after = case.edit(gone=[name])
    assert names(after) == [name.replace("legs", "top")] and not after.non_convex
    assert modes(case.trees[1]) == {name: [1], name.replace("legs", "top"): [4]}


@pytest.mark.parametrize("name", ["legs", "legs-colonly"])
def test_points_and_lines_stay_with_the_pieces_that_are_left(tmp_path: Path, name: str) -> None:
    scene = SceneFile()
    scene.node(name, mesh=with_a_line(scene, three_legs()))
    case = Edited(scene, tmp_path)
    assert names(case.edit(gone=[f"{name}#2"])) == [f"{name}#0", f"{name}#1"]
    assert modes(case.trees[1]) == {name: [4, 1]}


def test_strips_become_lists_of_triangles_where_they_are_parted(tmp_path: Path) -> None:
    scene = SceneFile()
    strip = np.array([3, 2, 7, 6, 4, 2, 0, 3, 1, 7, 5, 4, 1, 0])  # a box in one strip
    points = np.array([[x, y, z] for z in (0.0, 1.0) for y in (0.0, 1.0) for x in (0.0, 1.0)])
    both = np.concatenate([strip, strip[-1:], strip[:1] + 8, strip + 8])
    part = scene.primitive((np.concatenate([points, points + np.array([3, 0, 0])]), both.reshape(-1, 1)), mode=5)
    scene.node("strip", mesh=scene.mesh(part))
    scene.node("box", box((9, 0, 0)))
    case = Edited(scene, tmp_path)
    hulls = names(case.before)
    assert len(hulls) >= 2
    after = case.edit(gone=hulls[1:-1])
    assert after.geoms[0].shape.volume == pytest.approx(case.before.geoms[0].shape.volume)


def test_new_geometry_of_a_text_goes_to_a_file_beside_it_and_again_to_another(tmp_path: Path) -> None:
    case = Edited(table(), tmp_path, ".gltf")
    case.edit(gone=["top"], made=[brick((1, 2, 3), "top~1", "top")])
    assert sorted(path.name for path in case.out.parent.iterdir()) == ["a--hulls.bin", "a.bin", "a.gltf"]
    assert (case.out.parent / "a.bin").read_bytes() == (tmp_path / "a.bin").read_bytes()
    first = read(case.out)
    save(first.with_geoms([*first.geoms, brick((9, 9, 9), "top~2", "top~1")]), tmp_path / "two" / "a.gltf")
    assert "a--hulls_2.bin" in {path.name for path in (tmp_path / "two").iterdir()}
    assert names(read(tmp_path / "two" / "a.gltf"))[-1] == "top~2"


def test_a_text_that_holds_its_buffer_holds_the_new_one_too(tmp_path: Path) -> None:
    (tmp_path / "b.gltf").write_bytes(table().gltf())
    asset = read(tmp_path / "b.gltf")
    saved = save(asset.with_geoms([*asset.geoms, brick((9, 0, 0), "x", None)]), tmp_path / "out" / "b.gltf")
    assert [path.name for path in saved.files] == ["b.gltf"]
    assert names(read(saved.path))[-1] == "x"


def test_numbers_blanks_and_order_of_what_is_not_edited_are_as_they_were(tmp_path: Path) -> None:
    text = table().gltf().decode().replace("1.5\n", "1.50\n").replace('"asset": {', '"asset" : \t{')
    text = text.replace("[0, 0, 1]", "[0.000, -0.0, 1e0]").replace('"made by"', '"made \\u0062y"')
    (tmp_path / "a.gltf").write_text(text)
    asset = read(tmp_path / "a.gltf")
    save(asset.with_geoms(asset.geoms[:-1]), tmp_path / "out" / "a.gltf")
    lines = (tmp_path / "out" / "a.gltf").read_text().splitlines()
    gone = [line for line in text.splitlines() if line not in lines]
    assert len(gone) <= 6
    assert any("1.50" in line for line in lines) and '"asset" : \t{' in "\n".join(lines)


def test_other_chunks_of_a_glb_and_what_lies_behind_stay(tmp_path: Path) -> None:
    scene = table()
    tree = tree_of(scene.glb())
    (tmp_path / "a.glb").write_bytes(glb_of(tree, scene.data, chunk(b"ACME", b"abcd")) + b"rest")
    asset = read(tmp_path / "a.glb")
    save(asset.with_geoms(asset.geoms[:-1]), tmp_path / "out.glb")
    assert (tmp_path / "out.glb").read_bytes().endswith(chunk(b"ACME", b"abcd") + b"rest")


def test_a_text_becomes_a_glb_and_back_with_everything_inside(tmp_path: Path) -> None:
    case = Edited(table(), tmp_path, ".gltf", "b.glb")
    save(case.before, case.out)
    assert [path.name for path in case.out.parent.iterdir()] == ["b.glb"]
    assert names(read(case.out)) == names(case.before)
    save(read(case.out), tmp_path / "back" / "c.gltf")
    assert sorted(path.name for path in (tmp_path / "back").iterdir()) == ["c.bin", "c.gltf"]
    assert errors([case.out, tmp_path / "back" / "c.gltf"]) == [{}, {}]
    inside = tree_of(case.out.read_bytes())
    back = json.loads((tmp_path / "back" / "c.gltf").read_bytes())
    assert back["buffers"][0].pop("uri") == "c.bin"
    assert back == inside


def test_an_edit_that_leaves_no_collision_is_refused(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match="the edit leaves no collision in this file"):
        Edited(SceneFile.of(("UCX_a", box()), ("a", angle())), tmp_path).edit(gone=["UCX_a"])


def test_a_buffer_that_has_changed_since_is_noticed(tmp_path: Path) -> None:
    case = Edited(table(), tmp_path, ".gltf")
    (tmp_path / "a.bin").write_bytes((tmp_path / "a.bin").read_bytes()[::-1])
    with pytest.raises(AssetError, match=r"the buffer a\.bin has changed"):
        case.edit(gone=["top"])


def test_a_made_hull_takes_the_material_of_its_parent_unless_that_needs_a_picture(tmp_path: Path) -> None:
    scene = SceneFile()
    scene.tree["materials"] = [{"name": "wood"}, {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    scene.tree |= {"textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,AAAA"}]}
    uv = scene.accessor(np.zeros((8, 2), "<f4"))
    for k in (0, 1):
        part = scene.primitive(box((3.0 * k, 0, 0)), material=k)
        part["attributes"]["TEXCOORD_0"] = uv
        scene.node(f"n{k}", mesh=scene.mesh(part))
    case = Edited(scene, tmp_path)
    case.edit(gone=["n0", "n1"], made=[brick((0, 0, 0), "n0~1", "n0"), brick((3, 0, 0), "n1~1", "n1")])
    made = [case.trees[1]["meshes"][k]["primitives"][0].get("material") for k in (2, 3)]
    assert made == [0, None]
