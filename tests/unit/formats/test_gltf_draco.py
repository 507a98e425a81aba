from pathlib import Path

import DracoPy
import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import read, read_triangles, save
from tests.gltf_files import SceneFile
from tests.gltf_validation import errors
from tests.soups import Soup, box, together

NAME = "KHR_draco_mesh_compression"


def packed(soup: Soup, bits: int = 0, damage: bool = False) -> SceneFile:
    """A scene of one primitive that Draco compressed, with texture coordinates, and a plain node beside."""
    scene = SceneFile()
    data = DracoPy.encode(
        soup[0].astype(np.float32),
        soup[1].astype(np.uint32),
        quantization_bits=bits,
        preserve_order=True,
        tex_coord=soup[0][:, :2],
    )
    mesh = DracoPy.decode(data)
    numbers = {attribute["attribute_type"]: attribute["unique_id"] for attribute in mesh.attributes}
    view = scene.view(data[: len(data) // 2] if damage else data)
    count = len(mesh.points)
    scene.tree["accessors"] = [
        {"componentType": 5126, "count": count, "type": "VEC3", "min": [0, 0, 0], "max": [9, 1, 1]},
        {"componentType": 5126, "count": count, "type": "VEC2"},
        {"componentType": 5123, "count": mesh.faces.size, "type": "SCALAR"},
    ]
    attributes = {"POSITION": numbers[0], "TEXCOORD_0": numbers[3]}
    part = {
        "attributes": {"POSITION": 0, "TEXCOORD_0": 1},
        "indices": 2,
        "extensions": {NAME: {"bufferView": view, "attributes": attributes}},
    }
    scene.node("packed", mesh=scene.mesh(part))
    scene.node("plain", box((0, 0, 5)))
    scene.uses(NAME)
    scene.tree["extensionsRequired"] = [NAME]
    return scene


@pytest.mark.parametrize("bits", [0, 12])
def test_what_draco_compressed_is_read(tmp_path: Path, bits: int) -> None:
    path = packed(together(box(), box((8, 0, 0))), bits).write(tmp_path / "a.glb")
    asset = read(path)
    assert [geom.name for geom in asset.geoms] == ["packed#0", "packed#1", "plain"]
    for geom, x in zip(asset.geoms, (0, 8), strict=False):
        np.testing.assert_allclose(geom.shape.aabb.min, [x, 0, 0], atol=0.005)
        assert geom.shape.volume == pytest.approx(1, rel=0.01)
    assert [len(surface.faces) for surface in read_triangles(path)] == [24, 12]


def test_a_part_of_what_draco_compressed_cannot_go_and_hulls_beside_it_are_written_plainly(tmp_path: Path) -> None:
    path = packed(together(box(), box((8, 0, 0)))).write(tmp_path / "a.glb")
    asset = read(path)
    fewer = asset.with_geoms(g for g in asset.geoms if g.name != "packed#0")
    with pytest.raises(AssetError, match=f"taken out of a mesh that {NAME} compresses"):
        save(fewer, tmp_path / "out.glb", collision="replace")
    saved = save(fewer, tmp_path / "out.glb")
    after = read(saved.path)
    assert [geom.name for geom in after.geoms] == ["packed#1", "plain"]
    np.testing.assert_allclose(after.geoms[0].shape.aabb.min, [8, 0, 0])
    assert errors([saved.path])[0] <= errors([path])[0]


def test_damaged_draco_data_is_said(tmp_path: Path) -> None:
    path = packed(box(), damage=True).write(tmp_path / "a.glb")
    with pytest.raises(AssetError, match=r"a\.glb: this glTF file is damaged: its Draco data is damaged"):
        read(path)


def test_an_attribute_that_draco_does_not_have_is_said(tmp_path: Path) -> None:
    scene = packed(box())
    scene.tree["meshes"][0]["primitives"][0]["extensions"][NAME]["attributes"]["POSITION"] = 77
    with pytest.raises(AssetError, match="its Draco data has no POSITION"):
        read(scene.write(tmp_path / "a.glb"))
