from __future__ import annotations

import json
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from tests.gltf_files import SceneFile, Tree, chunk, glb_of, tree_of
from tests.soups import box, together


def scene_of_a_box() -> SceneFile:
    scene = SceneFile()
    scene.node("box", box())
    return scene


def edited(change: Callable[[Tree], object]) -> bytes:
    """A GLB of a box, its JSON changed."""
    scene = scene_of_a_box()
    tree = tree_of(scene.glb())
    change(tree)
    return glb_of(tree, scene.data)


def message(data: bytes, folder: Path, name: str = "a.glb") -> str:
    (folder / name).write_bytes(data)
    with pytest.raises(AssetError) as error:
        read(folder / name)
    assert name in str(error.value)
    return str(error.value)


def cyclic(tree: Tree) -> None:
    tree["nodes"] += [{"children": [2]}, {"children": [1]}]
    tree["scenes"][0]["nodes"] = [1]


def deep(tree: Tree) -> None:
    tree["nodes"] = [{"children": [k + 1]} for k in range(5000)] + tree["nodes"]
    tree["scenes"][0]["nodes"] = [0]


BROKEN: dict[str, tuple[Callable[[Tree], object], str]] = {
    "cycle": (cyclic, "node 1 is its own ancestor"),
    "itself": (lambda t: t["nodes"][0].update(children=[0]), "node 0 is its own ancestor"),
    "two parents": (
        lambda t: (t["nodes"].append({"children": [0]}), t["scenes"][0].update(nodes=[0, 1])),
        "node 0 is a child of two nodes",
    ),
    "child": (lambda t: t["nodes"][0].update(children=[7]), "there is no 7 in its 'nodes'"),
    "negative": (lambda t: t["nodes"][0].update(mesh=-1), "there is no -1 in its 'meshes'"),
    "text": (lambda t: t["nodes"][0].update(mesh="0"), "there is no '0' in its 'meshes'"),
    "scene": (lambda t: t.update(scene=3), "there is no 3 in its 'scenes'"),
    "no list": (lambda t: t.update(nodes={}), "its 'nodes' are no array"),
    "no object": (lambda t: t.update(nodes=[5]), "0 of its 'nodes' is no object"),
    "matrix": (lambda t: t["nodes"][0].update(matrix=[1, 2]), "its 'matrix' should be 16 finite numbers"),
    "rotation": (lambda t: t["nodes"][0].update(rotation=[0, 0, 0, 0]), "a rotation of all zeros"),
    "huge": (lambda t: t["nodes"][0].update(scale=[1e999, 1, 1]), "Infinity is no number of JSON"),
    "overflow": (
        lambda t: (
            t["nodes"].append({"children": [0], "scale": [1e300] * 3}),
            t["nodes"][0].update(rotation=[1e300, 0, 0, 0], scale=[1e300] * 3),
            t["scenes"][0].update(nodes=[1]),
        ),
        "the place of node 0 is not finite",
    ),
    "far": (lambda t: t["nodes"][0].update(scale=["a", 1, 1]), "this glTF file is damaged"),
    "view": (lambda t: t["bufferViews"][0].update(byteLength=10**6), "buffer view 0 goes beyond its buffer"),
    "offset": (lambda t: t["bufferViews"][0].update(byteOffset=-4), "buffer view 0 goes beyond its buffer"),
    "count": (lambda t: t["accessors"][0].update(count=10**9), "an accessor goes beyond buffer view 0"),
    "stride": (lambda t: t["bufferViews"][0].update(byteStride=-4), "an accessor goes beyond buffer view 0"),
    "type": (lambda t: t["accessors"][0].update(componentType=1), "an accessor of 8 'VEC3' of type 1"),
    "flat": (lambda t: t["accessors"][0].update(type="VEC2"), "the positions of a mesh are no points"),
    "index": (lambda t: t["accessors"][0].update(count=4), "a face names a vertex that is not there"),
    "lost": (lambda t: t["accessors"][0].pop("bufferView"), "the values of accessor 0"),
    "missing": (lambda t: t["bufferViews"][0].pop("byteLength"), "'byteLength' is missing in it"),
    "sparse": (
        lambda t: (
            t["accessors"][0].update(bufferView=None, count=10**15, sparse={}) or t["accessors"][0].pop("bufferView")
        ),
        "this glTF file is damaged",
    ),
    "version": (lambda t: t.update(asset={"version": "1.0"}), "it is glTF 1.0, only glTF 2 is read"),
    "nothing": (lambda t: t.update(scenes=[{}]), "there is no mesh and no collider in its scene"),
    "lines": (lambda t: t["meshes"][0]["primitives"][0].update(mode=1), "there is no mesh and no collider"),
    "meshopt": (
        lambda t: t["buffers"][0].update(extensions={"EXT_meshopt_compression": {"fallback": True}}),
        "its meshes are compressed by EXT_meshopt_compression, which is not read",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_what_is_wrong_with_a_scene_is_said(tmp_path: Path, case: str) -> None:
    change, expected = BROKEN[case]
    assert expected in message(edited(change), tmp_path)


def test_ten_thousand_nodes_in_a_chain_are_no_trouble(tmp_path: Path) -> None:
    (tmp_path / "a.glb").write_bytes(edited(deep))
    tree = tree_of((tmp_path / "a.glb").read_bytes())
    assert tree["nodes"][-1]["name"] == "box"
    tree["nodes"][4999]["children"] = [5000]
    (tmp_path / "a.glb").write_bytes(glb_of(tree, scene_of_a_box().data))
    assert read(tmp_path / "a.glb").geoms[0].name == "box"


def test_a_coordinate_that_is_not_finite_is_said(tmp_path: Path) -> None:
    scene = SceneFile()
    points, faces = box()
    points[3, 1] = np.nan
    scene.tree["meshes"] = [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]
    scene.accessor(points.astype("<f4"), min=[0, 0, 0], max=[1, 1, 1])
    scene.accessor(faces.astype("<u2").reshape(-1, 1))
    scene.node("box", mesh=0)
    assert "a coordinate is not a finite number" in message(scene.glb(), tmp_path)


@pytest.mark.parametrize("length", [3, 11, 15, 19, 200, -1])
def test_a_glb_that_is_cut_short_is_said(tmp_path: Path, length: int) -> None:
    assert "this glTF file is damaged" in message(scene_of_a_box().glb()[:length], tmp_path)


def test_a_glb_of_another_version_is_said(tmp_path: Path) -> None:
    data = scene_of_a_box().glb()
    assert "only version 2 is read" in message(data[:4] + struct.pack("<I", 1) + data[8:], tmp_path)


def test_what_is_no_json_is_said(tmp_path: Path) -> None:
    for data in (b"[1]", b"{", b'{"nodes": [NaN]}', b"[" * 10**5):
        assert "this glTF file is damaged" in message(data, tmp_path, "a.gltf")


def test_buffers_are_missed_by_name_and_cut_ones_told(tmp_path: Path) -> None:
    scene = scene_of_a_box()
    text = scene.gltf("the%20box.bin")
    assert "its buffer the%20box.bin is not there" in message(text, tmp_path, "a.gltf")
    (tmp_path / "the box.bin").write_bytes(scene.data[:-5])
    assert "a buffer is cut short" in message(text, tmp_path, "a.gltf")
    (tmp_path / "the box.bin").write_bytes(scene.data)
    assert read(tmp_path / "a.gltf").geoms[0].name == "box"
    assert "its buffer . cannot be read" in message(scene.gltf("."), tmp_path, "b.gltf")


@pytest.mark.parametrize("uri", ["data:application/octet-stream;base64", "data:;base64,AAA*", "data:,abc"])
def test_data_that_is_damaged_is_said(tmp_path: Path, uri: str) -> None:
    assert "this glTF file is damaged" in message(scene_of_a_box().gltf(uri), tmp_path, "a.gltf")


def test_a_glb_without_its_chunk_is_said(tmp_path: Path) -> None:
    tree = tree_of(scene_of_a_box().glb())
    assert "buffer 0 has neither a uri nor a binary chunk" in message(glb_of(tree, b""), tmp_path)


def test_chunks_of_other_kinds_bytes_behind_and_odd_lengths_are_read_past(tmp_path: Path) -> None:
    scene = scene_of_a_box()
    tree = tree_of(scene.glb())
    text = json.dumps(tree).encode() + b"\0"  # some exporters fill up with zeros
    text += b" " * (len(text) % 2 == 0)  # an odd length
    body = chunk(b"JSON", text) + chunk(b"ACME", b"abc") + chunk(b"BIN\0", scene.data)
    data = struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body + b"rest"
    (tmp_path / "a.glb").write_bytes(data.replace(b"\0 ", b"  "))
    assert read(tmp_path / "a.glb").geoms[0].name == "box"


def test_a_picture_beside_a_glb_that_is_filled_up_with_zeros_goes_along(tmp_path: Path) -> None:
    scene = scene_of_a_box()
    scene.tree["images"] = [{"uri": "wood.png"}]
    (tmp_path / "wood.png").write_bytes(b"")
    text = json.dumps(tree_of(scene.glb())).encode()
    body = chunk(b"JSON", text + b"\0" * (-len(text) % 4 or 4)) + chunk(b"BIN\0", scene.data)
    (tmp_path / "a.glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)
    saved = save(read(tmp_path / "a.glb"), tmp_path / "out" / "a.glb")
    assert sorted(path.name for path in saved.path.parent.iterdir()) == ["a.glb", "wood.png"]


@pytest.mark.parametrize("suffix", [".glb", ".gltf", ".urdf", ".xml", ".sdf", ".obj", ".stl", ".ply", ""])
def test_half_a_character_in_a_name_becomes_a_question_mark(tmp_path: Path, suffix: str) -> None:
    scene = SceneFile()
    scene.node("leg\ud800", together(box(), box((3, 0, 0))), extras={"note": "\ud83e\udd14"})
    scene.node("b", box((6, 0, 0)))
    scene.tree["images"] = [{"uri": "\udfff.png"}]
    scene.tree["materials"] = [{"name": "\udc00", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}]
    asset = read(scene.write(tmp_path / "a.glb"))
    assert [geom.name for geom in asset.geoms] == ["leg?#0", "leg?#1", "b"]
    assert asset.missing == ("?.png",)
    saved = save(asset.with_geoms(asset.geoms[1:]), tmp_path / "out" / f"a{suffix}")
    assert "\n".join(saved.notes).isascii()
    assert len(read(saved.path).geoms) == 2


def test_a_mark_of_byte_order_is_read_past(tmp_path: Path) -> None:
    (tmp_path / "a.gltf").write_bytes(b"\xef\xbb\xbf" + scene_of_a_box().gltf())
    assert read(tmp_path / "a.gltf").geoms[0].name == "box"


def test_damage_in_what_is_not_read_comes_to_light_when_it_would_be_lost(tmp_path: Path) -> None:
    (tmp_path / "a.glb").write_bytes(edited(lambda t: t.update(animations=5)))
    asset = read(tmp_path / "a.glb")
    assert len(asset.geoms) == 1
    save(asset, tmp_path / "out.glb")
    assert (tmp_path / "out.glb").read_bytes() == (tmp_path / "a.glb").read_bytes()
    with pytest.raises(AssetError, match="its 'animations' are no array"):
        save(asset, tmp_path / "a.urdf")
