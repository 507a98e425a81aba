"""STL, PLY, VRML: edits keep the rest of the file, and say how hulls are counted anew."""

import pickle
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from meshforge.formats.meshfile.ply import parse_ply
from meshforge.formats.plain.stl import StlFormat
from meshforge.geometry import Capsule, Pose, convex_hull
from meshforge.symbolic import Asset, Geom, NonConvexPiece, Surface
from tests.mesh_files import KINDS, ply, stl_ascii, stl_binary, wrl
from tests.soups import Soup, box, together

Write = Callable[[Soup], bytes]
LEGS = together(box(), box((3, 0, 0)), box((6, 0, 0), (1, 1, 2)))
PLAIN = {kind: KINDS[kind] for kind in KINDS if kind not in ("collada", "gltf", "glb")}


def put(folder: Path, suffix: str, data: bytes) -> Path:
    path = folder / f"a{suffix}"
    path.write_bytes(data)
    return path


def without(asset: Asset, *names: str, add: Sequence[Geom] = ()) -> Asset:
    return asset.with_geoms([*(g for g in asset.geoms if g.name not in names), *add])


def volumes(asset: Asset) -> dict[str, float]:
    return {g.name: round(g.shape.volume, 6) for g in asset.geoms}


def hull(name: str, parent: str | None = "geom0#0") -> Geom:
    return Geom(name, "body", convex_hull(box((0, 5, 0), (0.5, 0.5, 0.5))[0]), parent)


@pytest.mark.parametrize(("suffix", "write"), PLAIN.values(), ids=PLAIN.keys())
def test_an_unedited_file_is_written_byte_for_byte(tmp_path: Path, suffix: str, write: Write) -> None:
    source = put(tmp_path, suffix, write(LEGS))
    asset = pickle.loads(pickle.dumps(read(source)))
    saved = save(asset, tmp_path / f"b{suffix}")
    assert saved.path.read_bytes() == source.read_bytes()
    assert (saved.files, saved.notes, saved.names) == ((tmp_path / f"b{suffix}",), (), {})


@pytest.mark.parametrize(("suffix", "write"), PLAIN.values(), ids=PLAIN.keys())
def test_hulls_without_names_are_counted_in_file_order(tmp_path: Path, suffix: str, write: Write) -> None:
    assert volumes(read(put(tmp_path, suffix, write(LEGS)))) == {"geom0#0": 1, "geom0#1": 1, "geom0#2": 2}
    assert volumes(read(put(tmp_path, suffix, write(box())))) == {"geom0": 1}


def test_a_binary_stl_keeps_title_records_and_attributes(tmp_path: Path) -> None:
    data = stl_binary(LEGS, b"made by hand")
    asset = read(put(tmp_path, ".stl", data))
    save(without(asset, "geom0#1"), tmp_path / "b.stl")
    kept = data[84 : 84 + 12 * 50] + data[84 + 24 * 50 :]
    assert (tmp_path / "b.stl").read_bytes() == data[:80] + (24).to_bytes(4, "little") + kept


def test_solids_of_an_ascii_stl_keep_their_names_and_made_hulls_get_theirs(tmp_path: Path) -> None:
    asset = read(put(tmp_path, ".stl", stl_ascii(box(), "left") + stl_ascii(box((3, 0, 0)), "right")))
    assert volumes(asset) == {"left": 1, "right": 1}
    saved = save(without(asset, add=[hull("left~1", "left")]), tmp_path / "b.stl")
    assert volumes(read(saved.path)) == {"left": 1, "right": 1, "left~1": 0.125}
    assert saved.names == {}


WORDS = ("facet", "a", "my facet x", "endfacet", "facet normal 0 0 0", "endsolid facet endfacet", "d")


@pytest.mark.parametrize("gone", WORDS)
def test_names_of_solids_may_hold_the_words_of_the_format(tmp_path: Path, gone: str) -> None:
    solids = {name: stl_ascii(box((3 * k, 0, 0)), name) for k, name in enumerate(WORDS)}
    asset = read(put(tmp_path, ".stl", b"".join(solids.values())))
    assert {g.name: g.shape.aabb.min[0] for g in asset.geoms} == {name: 3 * k for k, name in enumerate(WORDS)}
    saved = save(without(asset, gone), tmp_path / "b.stl")
    assert saved.names == {}
    left = {name: 3 * k for k, name in enumerate(WORDS) if name != gone}
    assert {g.name: g.shape.aabb.min[0] for g in read(saved.path).geoms} == left


def test_an_ascii_stl_of_one_solid_stays_one(tmp_path: Path) -> None:
    asset = read(put(tmp_path, ".stl", stl_ascii(LEGS, "my facet x")))
    saved = save(without(asset, "geom0#2", add=[hull("geom0#2~1")]), tmp_path / "b.stl")
    assert saved.path.read_bytes().splitlines()[:2] == [b"solid my facet x", b"facet normal -1.0 0.0 0.0"]
    assert volumes(read(saved.path)) == {"geom0#0": 1, "geom0#1": 1, "geom0#2": 0.125}


@pytest.mark.parametrize("order", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_a_ply_keeps_colours_and_other_properties(tmp_path: Path, order: str) -> None:
    asset = read(put(tmp_path, ".ply", ply(LEGS, order, extra=True)))
    saved = save(without(asset, "geom0#0", add=[hull("geom0~1")]), tmp_path / "b.ply")
    before, after = (parse_ply(path.read_bytes(), "a.ply") for path in (asset.path, saved.path))
    assert after.is_text == (order == "ascii")
    for old, new in zip(before.elements, after.elements, strict=True):
        start, count = (8, 16) if old.name == "vertex" else (12, 24)
        for name in new.values.keys() - {"vertex_indices"}:
            kept = np.asarray(old.values[name])[start:]
            assert np.array_equal(np.asarray(new.values[name])[:count], kept), name
    assert {"red", "quality"} & after.elements[0].values.keys()
    assert len(read(saved.path).geoms) == 3


def test_rows_of_a_ply_that_count_on_vertices_stop_an_edit(tmp_path: Path) -> None:
    edges = b"element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header"
    data = ply(LEGS).replace(b"end_header", edges) + b"0 1\n"
    asset = read(put(tmp_path, ".ply", data))
    assert save(asset, tmp_path / "b.ply").path.read_bytes() == data
    with pytest.raises(AssetError, match="it has rows of edge, which an edit would lose"):
        save(without(asset, "geom0#0"), tmp_path / "c.ply")


def test_an_element_twice_in_a_ply_stops_an_edit(tmp_path: Path) -> None:
    again = b"element vertex 1\nproperty float x\nend_header"
    asset = read(put(tmp_path, ".ply", ply(LEGS).replace(b"end_header", again) + b"7\n"))
    with pytest.raises(AssetError, match="it has rows of vertex"):
        save(without(asset, "geom0#0"), tmp_path / "c.ply")


def test_exact_duplicates_stay_apart_in_an_stl(tmp_path: Path) -> None:
    asset = read(put(tmp_path, ".stl", stl_binary(LEGS)))
    twin = Geom("geom0#0~1", "body", asset.geoms[0].shape, "geom0#0")
    assert len(read(save(without(asset, add=[twin]), tmp_path / "b.stl").path).geoms) == 4


def test_hulls_that_an_stl_cannot_hold_apart_are_refused_not_fused(tmp_path: Path) -> None:
    open_box = (box()[0], box()[1][2:])
    asset = read(put(tmp_path, ".stl", stl_binary(together(open_box, box((3, 0, 0))))))
    twin = Geom("geom0#0~1", "body", asset.geoms[0].shape, "geom0#0")
    with pytest.raises(AssetError, match="cannot be told apart") as error:
        save(without(asset, add=[twin]), tmp_path / "b.stl")
    assert "Write an OBJ" in str(error.value)
    assert not (tmp_path / "b.stl").exists()


@pytest.mark.parametrize(("old", "new"), [("6.0", "6.5"), ("0.25", "0.375")], ids=["stays", "made"])
def test_corners_a_writer_moves_are_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, old: str, new: str) -> None:
    edited = StlFormat.apply_edit
    moved = (f"vertex {old} ".encode(), f"vertex {new} ".encode())
    monkeypatch.setattr(StlFormat, "apply_edit", lambda *given: edited(*given).replace(*moved))
    asset = read(put(tmp_path, ".stl", stl_ascii(LEGS)))
    made = Geom("geom0#0~1", "body", convex_hull(box((0.25, 5, 0))[0]), "geom0#0")
    with pytest.raises(AssetError, match=rf"would have the vertex {float(old):g} .* elsewhere"):
        save(without(asset, "geom0#1", add=[made]), tmp_path / "b.stl")


def test_vrml_is_read_only_and_says_what_to_write(tmp_path: Path) -> None:
    asset = read(put(tmp_path, ".wrl", wrl(LEGS)))
    with pytest.raises(AssetError, match=r"Write an \.obj"):
        save(without(asset, "geom0#0"), tmp_path / "b.wrl")
    save(without(asset, "geom0#0"), tmp_path / "b.obj")
    assert volumes(read(tmp_path / "b.obj")) == {"geom0#1": 1, "geom0#2": 2}


def test_shapes_of_vrml_are_hulls_of_their_own(tmp_path: Path) -> None:
    data = wrl(box()) + wrl(box((1, 0, 0))).replace(b"#VRML V2.0 utf8", b"DEF lid").replace(b"DEF co", b"")
    assert volumes(read(put(tmp_path, ".wrl", data))) == {"geom0": 1, "lid": 1}


@pytest.mark.parametrize("suffix", [".obj", ".stl", ".ply"])
def test_other_formats_are_converted_with_what_is_opaque(tmp_path: Path, suffix: str) -> None:
    sheet = Surface(np.array([[0, 0, 9], [1, 0, 9], [1, 1, 9.0]]), np.array([[0, 1, 2]]))
    asset = replace(
        read(put(tmp_path, ".wrl", wrl(LEGS))),
        non_convex=(
            NonConvexPiece("sheet", "body", "flat", sheet),
            NonConvexPiece("floor", "body", "an endless plane"),
        ),
    )
    capsule = Geom("pin", "body", Capsule(Pose.of_translation([0, 8, 0]), 0.5, 1.0))
    saved = save(asset.with_geoms([*asset.geoms, capsule]), tmp_path / f"b{suffix}")
    back = read(saved.path)
    assert len(back.geoms) == 4
    assert [o.reason for o in back.non_convex] == ["flat"]
    assert [n for n in saved.notes if "capsule" in n or "floor" in n] == [
        f"1 capsule (pin) is written as triangles: {suffix[1:].upper()} has no capsules",
        "1 piece without a surface (floor) is left out: an endless plane",
    ]


def test_nothing_is_not_written(tmp_path: Path) -> None:
    asset = read(put(tmp_path, ".wrl", wrl(LEGS)))
    with pytest.raises(AssetError, match="there is no hull to write"):
        save(asset.with_geoms([]), tmp_path / "b.obj")
