"""Reading triangles of mesh files of every kind."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import AssetError
from meshforge.formats import RawSurface, read_triangles, split_into_pieces
from meshforge.formats.mesh_reader import parse_surfaces
from meshforge.geometry import Floats
from tests.examples import examples
from tests.mesh_files import KINDS, dae, glb, gltf, gltf_tree, ply, stl_ascii, stl_binary, wrl
from tests.soups import Soup, box, together

Write = Callable[[Soup], bytes]
PAIR = together(box(), box((3, 0, 0)))


def surfaces(path: Path, data: bytes) -> list[RawSurface]:
    path.write_bytes(data)
    return read_triangles(path)


def bounds(found: list[RawSurface]) -> list[list[float]]:
    points = np.concatenate([s.vertices[np.unique(s.faces)] for s in found])
    return [points.min(axis=0).round(6).tolist(), points.max(axis=0).round(6).tolist()]


def corners(found: list[RawSurface]) -> Floats:
    return np.concatenate([s.vertices[s.faces] for s in found])


@pytest.mark.parametrize(("suffix", "write"), KINDS.values(), ids=KINDS.keys())
def test_every_kind_of_file_gives_the_same_triangles(tmp_path: Path, suffix: str, write: Write) -> None:
    found = surfaces(tmp_path / f"a{suffix}", write(PAIR))
    assert np.array_equal(corners(found), PAIR[0][PAIR[1]])
    assert [round(p.shape.volume, 6) for p in split_into_pieces(found, name="a") if p.shape] == [1, 1]


@pytest.mark.parametrize(("suffix", "write"), KINDS.values(), ids=KINDS.keys())
@examples(25)
@given(data=st.data())
def test_a_damaged_file_is_read_or_refused_by_name_never_more(suffix: str, write: Write, data: st.DataObject) -> None:
    whole = write(box())
    cut = data.draw(st.integers(0, len(whole)))
    noise = data.draw(st.binary(max_size=6))
    broken = whole[:cut] + noise + (whole[cut + len(noise) :] if data.draw(st.booleans()) else b"")
    try:
        found = parse_surfaces(broken, Path(f"broken{suffix}"))
    except AssetError as error:
        assert f"broken{suffix}" in str(error)
    else:
        assert all(np.isfinite(s.vertices[s.faces]).all() for s in found)


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("a.stl", b"", "the file is empty"),
        ("a.stl", stl_binary(PAIR)[:-1], "cut short: it says 24 triangles and holds 23"),
        ("a.stl", stl_binary(box((np.nan, 0, 0))), "not a finite number"),
        ("a.stl", b"solid nothing\nendsolid nothing\n", "there is no triangle"),
        ("a.stl", stl_ascii(box())[:300], "cut short"),
        ("a.stl", stl_ascii(box()).replace(b"vertex 0.0 0.0 1.0", b"vertex 0.0 0.0 one"), "three numbers, here is"),
        ("a.stl", stl_ascii(box()).replace(b"vertex 0.0 0.0 1.0", b""), "a.stl:2: a facet needs three vertices"),
        ("a.ply", b"ply\nformat ascii 1.0\nend_header\n", "no vertices"),
        ("a.ply", ply(box()).replace(b"vertex 8", b"vertex 10000000"), "10000000 rows of vertex are not all there"),
        ("a.ply", ply(box(), "binary_little_endian")[:-1], "12 rows of face are not all there"),
        ("a.ply", ply(box()).replace(b"3 0 1 3", b"3 0 1 9"), "face 0 names vertices 0, 1, 9, where"),
        ("a.ply", ply(box()).replace(b"uchar int", b"uchar word"), "a.ply:9: this line of the header makes no sense"),
        ("a.ply", ply(box()).replace(b"vertex 8", b"vertex -8"), "a.ply:4: this line of the header makes no sense"),
        ("a.ply", b"hello", "this is no PLY file"),
        ("a.wrl", b"#VRML V1.0 ascii\n", "this is no VRML 2.0 file"),
        ("a.wrl", wrl(box())[:-30], "cut short"),
        ("a.wrl", wrl(box()).replace(b"IndexedFaceSet", b"Sphere"), "shapes of kind Sphere are not read"),
        ("a.dae", b"<COLLADA/>", "there is no triangle"),
        ("a.dae", dae(box())[:-20], "this Collada file cannot be read"),
        ("a.dae", b'<!DOCTYPE x [<!ENTITY a "b">]>' + dae(box()), "it declares XML entities"),
        ("a.glb", glb(box())[:200], "this glTF file is damaged"),
        ("a.gltf", b"{}", "there is no triangle"),
        ("a.gltf", gltf(box()).replace(b'"count": 8', b'"count": 80'), "an accessor goes beyond"),
        ("a.step", b"ISO-10303-21;", ".step is no mesh file that MeshForge reads"),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, name: str, data: bytes, message: str) -> None:
    with pytest.raises(AssetError) as error:
        surfaces(tmp_path / name, data)
    assert message in str(error.value)
    assert name in str(error.value)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match=r"gone\.stl: cannot be read: No such file"):
        read_triangles(tmp_path / "gone.stl")


def test_a_binary_stl_may_begin_like_a_text(tmp_path: Path) -> None:
    assert len(surfaces(tmp_path / "a.stl", stl_binary(box(), b"solid by some tool"))[0].faces) == 12


def test_bytes_behind_the_last_triangle_are_read_past(tmp_path: Path) -> None:
    assert len(surfaces(tmp_path / "a.stl", stl_binary(box()) + b"color table")[0].faces) == 12


def test_solids_of_an_stl_have_names_where_there_are_several(tmp_path: Path) -> None:
    both = stl_ascii(box(), "left leg") + stl_ascii(box((3, 0, 0)), "right leg")
    assert [s.name for s in surfaces(tmp_path / "a.stl", both)] == ["left leg", "right leg"]
    assert [s.name for s in surfaces(tmp_path / "a.stl", stl_ascii(box()))] == [None]


def test_transforms_of_collada_nodes_are_applied_units_and_axes_are_not(tmp_path: Path) -> None:
    node = "<translate>5 0 0</translate><scale>1 1 -2</scale>"
    found = surfaces(tmp_path / "a.dae", dae(box(), unit=0.01, node=node))
    assert bounds(found) == [[5, 0, -2], [6, 1, 0]]
    assert [(s.name, s.unit) for s in found] == [("part", 0.01)]


def test_a_collada_geometry_may_stand_in_several_nodes(tmp_path: Path) -> None:
    twice = dae(box()).replace(
        b"</node>", b'<node><translate>3 0 0</translate><instance_geometry url="#g"/></node></node>'
    )
    assert bounds(surfaces(tmp_path / "a.dae", twice)) == [[0, 0, 0], [4, 1, 1]]


def test_transforms_of_gltf_nodes_are_applied(tmp_path: Path) -> None:
    half = np.sqrt(0.5)
    turned = gltf(box(), translation=[5, 0, 0], rotation=[0, 0, half, half], scale=[1, 2, 3])
    assert bounds(surfaces(tmp_path / "a.gltf", turned)) == [[3, 0, 0], [5, 1, 3]]
    matrix = [1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 5, 0, 0, 1]
    assert bounds(surfaces(tmp_path / "b.glb", glb(box(), matrix=matrix))) == [[5, 0, 0], [6, 2, 3]]


def test_strips_and_fans_of_gltf_are_cut_into_triangles(tmp_path: Path) -> None:
    quad = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]]), np.array([[0, 1, 2, 3]])
    tree, _ = gltf_tree(quad)
    assert tree["meshes"] == [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]
    strip = gltf(quad).replace(b'"indices": 1', b'"indices": 1, "mode": 5')
    fan = gltf(quad).replace(b'"indices": 1', b'"indices": 1, "mode": 6')
    assert surfaces(tmp_path / "a.gltf", strip)[0].faces.tolist() == [[0, 1, 2], [3, 2, 1]]
    assert surfaces(tmp_path / "b.gltf", fan)[0].faces.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_a_gltf_buffer_may_lie_beside_it_and_is_missed_by_name(tmp_path: Path) -> None:
    tree, buffer = gltf_tree(box())
    text = json.dumps({**tree, "buffers": [{"byteLength": len(buffer), "uri": "the%20box.bin"}]}).encode()
    with pytest.raises(AssetError, match=r"its buffer the%20box\.bin is not there"):
        surfaces(tmp_path / "a.gltf", text)
    (tmp_path / "the box.bin").write_bytes(buffer)
    assert len(surfaces(tmp_path / "a.gltf", text)[0].faces) == 12


@pytest.mark.parametrize("extension", ["KHR_meshopt_compression", "EXT_meshopt_compression"])
def test_gltf_compressed_by_meshopt_is_refused(tmp_path: Path, extension: str) -> None:
    tree, _ = gltf_tree(box())
    with pytest.raises(AssetError, match=f"compressed by {extension}"):
        surfaces(tmp_path / "a.gltf", json.dumps({**tree, "extensionsRequired": [extension]}).encode())


def test_gltf_positions_that_are_nowhere_are_never_read_as_zeros(tmp_path: Path) -> None:
    tree, _ = gltf_tree(box())
    tree["accessors"] = [{"componentType": 5126, "count": 8, "type": "VEC3"}]
    with pytest.raises(AssetError, match="geometry of a mesh, are not in it"):
        surfaces(tmp_path / "a.gltf", json.dumps(tree).encode())


def test_transforms_and_names_of_vrml_are_applied(tmp_path: Path) -> None:
    inner = wrl(box()).partition(b"Group {")[2].rpartition(b"}")[0]
    turn = b"translation 5 0 0 center 1 0 0 rotation 0 0 1 3.14159265358979 scale 2 1 1"
    found = surfaces(tmp_path / "a.wrl", b"#VRML V2.0 utf8\nDEF leg Transform { " + turn + inner + b"}")
    assert bounds(found) == [[6, -1, 0], [8, 0, 1]]
    assert [s.name for s in found] == ["leg"]


def test_a_vrml_node_may_be_used_again(tmp_path: Path) -> None:
    again = b"Transform { translation 3 0 0 children Shape { geometry IndexedFaceSet { coord USE co coordIndex ["
    again += b" ".join(b"%d %d %d -1" % tuple(face) for face in box()[1].tolist()) + b"] } } }"
    assert bounds(surfaces(tmp_path / "a.wrl", wrl(box()) + again)) == [[0, 0, 0], [4, 1, 1]]


def test_polygons_of_ply_and_vrml_are_cut_into_fans(tmp_path: Path) -> None:
    quad = b"ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    quad += b"element face 1\nproperty list uchar uint vertex_index\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3"
    assert surfaces(tmp_path / "a.ply", quad)[0].faces.tolist() == [[0, 1, 2], [0, 2, 3]]
