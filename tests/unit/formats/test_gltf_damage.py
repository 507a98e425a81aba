import json
import struct
from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from tests.gltf_files import SceneFile, chunk, glb_of, tree_of
from tests.soups import box, together


def test_chunks_of_other_kinds_bytes_behind_and_odd_lengths_are_read_past(tmp_path: Path) -> None:
    scene = SceneFile.of(("box", box()))
    tree = tree_of(scene.glb())
    text = json.dumps(tree).encode() + b"\0"  # some exporters fill up with zeros
    text += b" " * (len(text) % 2 == 0)  # an odd length
    body = chunk(b"JSON", text) + chunk(b"ACME", b"abc") + chunk(b"BIN\0", scene.data)
    data = struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body + b"rest"
    (tmp_path / "a.glb").write_bytes(data.replace(b"\0 ", b"  "))
    assert read(tmp_path / "a.glb").geoms[0].name == "box"


def test_a_picture_beside_a_glb_that_is_filled_up_with_zeros_goes_along(tmp_path: Path) -> None:
    scene = SceneFile.of(("box", box()))
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


def test_damage_in_what_is_not_read_comes_to_light_when_it_would_be_lost(tmp_path: Path) -> None:
    scene = SceneFile.of(("box", box()))
    (tmp_path / "a.glb").write_bytes(glb_of(tree_of(scene.glb()) | {"animations": 5}, scene.data))
    asset = read(tmp_path / "a.glb")
    assert len(asset.geoms) == 1
    save(asset, tmp_path / "out.glb")
    assert (tmp_path / "out.glb").read_bytes() == (tmp_path / "a.glb").read_bytes()
    with pytest.raises(AssetError, match="its 'animations' are no array"):
        save(asset, tmp_path / "a.urdf")
