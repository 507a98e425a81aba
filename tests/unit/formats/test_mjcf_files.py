"""The files of an MJCF: includes, meshes and what else it refers to, encodings, fragments."""

import struct
import zlib
from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import read as read_any
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.symbolic import Asset
from tests.mjcf_engines import assert_as_in_mujoco, model, put, read

OBJ = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
MESHED = '<geom type="mesh" mesh="t"/>'
Files = dict[str, str | bytes]


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


PNG = b"".join(
    [
        b"\x89PNG\r\n\x1a\n",
        _chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 0, 0, 0, 0)),  # two by two pixels of grey
        _chunk(b"IDAT", zlib.compress(b"\0\x10\x20\0\x30\x40")),
        _chunk(b"IEND", b""),
    ]
)


def names(asset: Asset, folder: Path) -> list[str]:
    return [path.relative_to(folder).as_posix() for path in asset.files]


def test_includes_stand_in_one_another_wherever_mujoco_finds_them(tmp_path: Path) -> None:
    files: Files = {
        "main.xml": model('<include file="a/one.xml"/><geom size="4"/>', '<include file="a/assets.xml"/>'),
        "a/assets.xml": '<any><asset><mesh file="t.obj"/></asset></any>',
        "a/one.xml": '<x><body name="q"><geom size="1"/><include file="two.xml"/></body></x>',
        "a/two.xml": f'<y>\n\n<geom size="2"/>{MESHED}<include file="b/three.xml"/></y>',
        "a/b/three.xml": '<z><geom size="3"/></z>',
        "a/t.obj": OBJ,
    }
    path = put(tmp_path, files)
    asset = read(path)
    assert_as_in_mujoco(asset, path)
    assert [geom.name for geom in asset.geoms] == ["world/geom0", "q/geom0", "q/geom1", "q/geom2", "q/geom3"]
    assert names(asset, tmp_path) == ["a/assets.xml", "a/one.xml", "a/two.xml", "a/b/three.xml", "a/t.obj"]
    assert not asset.missing
    document = asset.document
    assert isinstance(document, MjcfDocument)
    assert [source.place for source in document.sources] == ["main.xml", *names(asset, tmp_path)[:4]]
    assert [source.reference for source in document.sources[1:]] == [
        "a/assets.xml",
        "a/one.xml",
        "two.xml",
        "b/three.xml",
    ]


def test_the_main_files_folder_comes_before_that_of_the_including_file(tmp_path: Path) -> None:
    files: Files = {
        "main.xml": model('<include file="a/one.xml"/>'),
        "a/one.xml": '<x><include file="two.xml"/></x>',
        "two.xml": '<x><geom name="main" size="1"/></x>',
        "a/two.xml": '<x><geom name="beside" size="1"/></x>',
    }
    path = put(tmp_path, files)
    assert_as_in_mujoco(read(path), path)
    assert [geom.name for geom in read(path).geoms] == ["world/main"]


@pytest.mark.parametrize(
    ("compiler", "reference", "place"),
    [
        ("", "t.obj", "t.obj"),
        ("", "t.obj", "sub/t.obj"),
        ("", "zz\\\\t.obj", "zz/t.obj"),
        ('meshdir="m"', "t.obj", "m/t.obj"),
        ('meshdir="m"', "t.obj", "sub/t.obj"),
        ('assetdir="m"', "t.obj", "m/t.obj"),
        ('meshdir="m" assetdir="n"', "t.obj", "m/t.obj"),
        ('strippath="true"', "/home/me/t.obj", "t.obj"),
        ('strippath="true" meshdir="m"', "zz/t.obj", "m/t.obj"),
    ],
)
def test_mesh_files_are_where_mujoco_finds_them(compiler: str, reference: str, place: str, tmp_path: Path) -> None:
    files: Files = {
        "main.xml": model(MESHED, f'<compiler {compiler}/><include file="sub/assets.xml"/>'),
        "sub/assets.xml": f'<x><asset><mesh name="t" file="{reference}"/></asset></x>'.replace("\\\\", "\\"),
        place: OBJ,
    }
    path = put(tmp_path, files)
    asset = read(path)
    assert_as_in_mujoco(asset, path)
    assert names(asset, tmp_path) == ["sub/assets.xml", place]
    assert len(asset.visuals) == 1 and not asset.missing and not asset.notes


def test_every_referenced_file_is_told_with_its_companions(tmp_path: Path) -> None:
    before = (
        '<compiler texturedir="tex"/><asset><mesh name="t" file="t.obj"/><texture name="w" type="2d" file="wood.png"/>'
        '<hfield name="h" file="hills.png" size="1 1 1 1"/><model name="s" file="sub/s.xml"/></asset>'
    )
    files: Files = {
        "main.xml": model(MESHED + '<geom type="hfield" hfield="h"/><attach model="s" body="q" prefix="p"/>', before),
        "t.obj": "mtllib t.mtl\n" + OBJ,
        "t.mtl": "newmtl a\n",
        "tex/wood.png": PNG,
        "hills.png": PNG,
        "sub/s.xml": model(f'<body name="q">{MESHED}</body>', '<include file="i.xml"/>'),
        "sub/i.xml": '<x><asset><mesh file="t.obj"/></asset></x>',
        "sub/t.obj": OBJ,
    }
    asset = read(put(tmp_path, files))
    assert set(names(asset, tmp_path)) == set(files) - {"main.xml"}
    assert not asset.missing


def test_a_fragment_names_what_includes_it_directly_or_by_another(tmp_path: Path) -> None:
    files: Files = {
        "main.xml": model('<include file="parts/deep/one.xml"/>'),
        "parts/deep/one.xml": '<mujocoinclude><include file="parts/two.xml"/></mujocoinclude>',
        "parts/two.xml": '<mujocoinclude><geom size="1"/></mujocoinclude>',
        "parts/unused.xml": "<mujocoinclude/>",
        "parts/body.xml": "<body/>",
    }
    main = put(tmp_path, files)
    for part in ("parts/deep/one.xml", "parts/two.xml"):
        with pytest.raises(AssetError, match="is a part of a model") as error:
            read(tmp_path / part)
        assert error.value.remedy == f"Open {main}, which includes it."
    with pytest.raises(AssetError, match="none was found in its folder or the 3 above"):
        read(tmp_path / "parts/unused.xml")
    with pytest.raises(AssetError, match="is no MJCF: its root element is <body>, not <mujoco>"):
        read(tmp_path / "parts/body.xml")


def test_a_urdf_and_a_compiled_model_are_called_what_they_are(tmp_path: Path) -> None:
    path = put(tmp_path, {"main.xml": "<robot/>", "model.mjb": b"\0\1"})
    with pytest.raises(AssetError, match=r"It is a URDF: name it \.urdf\."):
        read(path)
    with pytest.raises(AssetError, match="compiled for one version of MuJoCo: open the XML"):
        read_any(tmp_path / "model.mjb")
