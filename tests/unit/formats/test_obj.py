"""OBJ: reading its dialects, and edits that leave the rest of the text alone."""

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from meshforge.geometry import Box, Pose, Shape, convex_hull
from meshforge.symbolic import Asset, Geom
from tests.gltf_edited import names
from tests.soups import QUADS, Soup, box


def vertex_lines(soup: Soup) -> str:
    return "".join(f"v {x:g} {y:g} {z:g}\n" for x, y, z in soup[0])


def quad_lines(start: int, form: str = "{0}") -> str:
    return "".join("f " + " ".join(form.format(c + start) for c in quad) + "\n" for quad in QUADS)


def written(path: Path, text: str | bytes) -> Path:
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def two_legs(first: str = "o left leg\n", second: str = "o right leg\n") -> str:
    return (
        f"# a table\nmtllib table.mtl\n{first}{vertex_lines(box())}vn 0 0 1\nusemtl oak\n{quad_lines(1, '{0}//1')}"
        f"# the other\n{second}{vertex_lines(box((3, 0, 0)))}usemtl pine\ns off\n{quad_lines(9, '{0}//1')}"
    )


def made(name: str, parent: str, shape: Shape | None = None) -> Geom:
    return Geom(name, "body", shape or convex_hull(box((0, 5, 0), (0.1, 0.2, 0.3))[0]), parent)


def edited(path: Path, out: Path, drop: Collection[str] = (), add: tuple[Geom, ...] = ()) -> tuple[Asset, str]:
    """The asset that an edit is read back as, and the text."""
    asset = read(path)
    save(asset.with_geoms([g for g in asset.geoms if g.name not in drop] + list(add)), out)
    return read(out), out.read_bytes().decode()


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        ("o left leg\n", "o right leg\n", ["left leg", "right leg"]),
        ("g  f 1 2 3 / odd # name \n", "g v\n", ["f 1 2 3 / odd # name", "v"]),
        ("o A\ng A_mesh\n", "o B\ng B_mesh\n", ["A", "B"]),
        ("o A\ng x\n", "g y\n", ["A/x", "A/y"]),
        ("o A\n", "o A\n", ["A#0", "A#1"]),
        ("", "o A\n", ["geom0", "A"]),
        ("", "", ["geom0#0", "geom0#1"]),
        ("o\n", "g \n", ["geom0#0", "geom0#1"]),
        ("o a#1\n", "o a\n", ["a#1", "a"]),
    ],
)
def test_hulls_are_named_after_objects_and_groups(tmp_path: Path, first: str, second: str, expected: list[str]) -> None:
    assert names(read(written(tmp_path / "a.obj", two_legs(first, second)))) == expected


def test_a_deleted_hull_takes_its_faces_vertices_and_group_line_along(tmp_path: Path) -> None:
    asset, text = edited(written(tmp_path / "a.obj", two_legs()), tmp_path / "b.obj", drop={"left leg"})
    assert names(asset) == ["right leg"]
    assert text == (
        f"# a table\nmtllib table.mtl\nvn 0 0 1\nusemtl oak\n# the other\no right leg\n{vertex_lines(box((3, 0, 0)))}"
        f"usemtl pine\ns off\n{quad_lines(1, '{0}//1')}"
    )


def test_relative_numbers_stay_relative(tmp_path: Path) -> None:
    first = vertex_lines(box()) + "o a\n" + quad_lines(-8).replace(" -0", " -8")
    second = vertex_lines(box((3, 0, 0))) + "o b\n" + quad_lines(-8)
    _, text = edited(written(tmp_path / "a.obj", first + second), tmp_path / "b.obj", drop={"a"})
    assert text == second


@pytest.mark.parametrize(
    ("more", "end", "count"),
    [("f 1 16\nf -1 -16\nl 2 3\n", "f 1 11\nf -1 -11\nl 2 3\n", 11), ("l 1 16\np -16\n", "l 1 9\np -9\n", 9)],
)
def test_vertices_of_lines_points_and_two_corners_stay(tmp_path: Path, more: str, end: str, count: int) -> None:
    _, text = edited(written(tmp_path / "a.obj", two_legs() + more), tmp_path / "b.obj", drop={"left leg"})
    assert text.endswith(end) and text.count("v ") == count and "v 0 0 0\n" in text


@pytest.mark.parametrize("end", ["", "\n", "\r\n"])
def test_a_made_hull_does_not_go_on_with_a_continued_line(tmp_path: Path, end: str) -> None:
    source = written(tmp_path / "a.obj", two_legs() + f"s \\\n1 \\{end}")
    asset, _ = edited(source, tmp_path / "b.obj", add=(made("left leg~1", "left leg"),))
    assert names(asset) == ["left leg", "right leg", "left leg~1"]


def test_a_made_hull_is_an_object_of_its_own_in_full_precision(tmp_path: Path) -> None:
    new = made("left leg~1", "left leg", convex_hull(np.random.default_rng(2).normal(size=(9, 3)) / 3 + 7))
    asset, text = edited(written(tmp_path / "a.obj", two_legs()), tmp_path / "b.obj", add=(new,))
    assert text.startswith(two_legs())
    assert names(asset) == ["left leg", "right leg", "left leg~1"]
    assert set(map(tuple, asset.geoms[2].shape.vertices.tolist())) == set(map(tuple, new.shape.vertices.tolist()))


def test_a_made_primitive_is_written_as_a_mesh_and_noted(tmp_path: Path) -> None:
    from meshforge.geometry import Sphere

    asset = read(written(tmp_path / "a.obj", two_legs()))
    shapes = (Box(Pose.of_translation([0, 5, 0]), np.array([0.5, 1, 1])), Sphere(Pose.of_translation([9, 9, 9]), 1.0))
    new = [made(f"left leg~{k}", "left leg", shape) for k, shape in enumerate(shapes, start=1)]
    saved = save(asset.with_geoms([*asset.geoms, *new]), tmp_path / "b.obj")
    assert saved.notes == ("1 sphere written as hull meshes: mesh files have no primitives",)
    assert read(tmp_path / "b.obj").geoms[2].shape.volume == pytest.approx(4)


def test_a_made_hull_may_touch_a_kept_one_at_its_very_vertices(tmp_path: Path) -> None:
    new = made("left leg~1", "left leg", convex_hull(box((1, 0, 0))[0]))
    asset, _ = edited(written(tmp_path / "a.obj", two_legs()), tmp_path / "b.obj", add=(new,))
    assert [g.shape.volume for g in asset.geoms] == pytest.approx([1, 1, 1])


def test_made_vertices_have_colours_where_the_file_has_them(tmp_path: Path) -> None:
    source = written(tmp_path / "a.obj", vertex_lines(box()).replace("\n", " 0.1 0.2 0.3\n") + quad_lines(1))
    _, text = edited(source, tmp_path / "b.obj", add=(made("geom0~1", "geom0"),))
    assert {len(line.split()) for line in text.splitlines() if line.startswith("v ")} == {7}


def test_line_ends_of_windows_are_kept_and_used(tmp_path: Path) -> None:
    source = written(tmp_path / "a.obj", two_legs().replace("\n", "\r\n"))
    _, text = edited(source, tmp_path / "b.obj", {"left leg"}, (made("left leg~1", "left leg"),))
    assert text.count("\r\n") == text.count("\n") == text.count("\r")


def test_opaque_pieces_stay_as_they_are(tmp_path: Path) -> None:
    flat = "o lid\nv 0 0 9\nv 1 0 9\nv 1 1 9\nf 17 18 19\n"
    source = written(tmp_path / "a.obj", two_legs() + flat)
    asset, text = edited(source, tmp_path / "b.obj", drop={"left leg"})
    assert [(o.name, o.reason) for o in asset.non_convex] == [("lid", "flat")]
    assert text.endswith("o lid\nv 0 0 9\nv 1 0 9\nv 1 1 9\nf 9 10 11\n")


def test_an_edit_that_leaves_nothing_is_refused(tmp_path: Path) -> None:
    asset = read(written(tmp_path / "a.obj", two_legs()))
    with pytest.raises(AssetError, match="the edit leaves nothing in this file"):
        save(asset.with_geoms([]), tmp_path / "b.obj")
    assert not (tmp_path / "b.obj").exists()


def test_free_form_surfaces_are_read_past_but_not_edited(tmp_path: Path) -> None:
    asset = read(written(tmp_path / "a.obj", two_legs() + "curv 0 1 1 2 3\n"))
    save(asset, tmp_path / "b.obj")
    with pytest.raises(AssetError, match="free-form"):
        save(asset.with_geoms(asset.geoms[1:]), tmp_path / "c.obj")


@pytest.mark.parametrize("name", ["body/leg#3", "geom0", "Tischbein links", " padded ", "two\nlines", "end\\", "f 1 2"])
def test_a_new_file_reads_back_the_names_it_is_given_or_says_so(tmp_path: Path, name: str) -> None:
    asset = replace(read(written(tmp_path / "a.obj", two_legs())), format="other")
    saved = save(asset.with_geoms([replace(asset.geoms[0], name=name), asset.geoms[1]]), tmp_path / "b.obj")
    assert names(read(tmp_path / "b.obj")) == [saved.names.get(name, name), "right leg"]
    assert bool(saved.names) == (name.strip() != name or "\n" in name or "\\" in name)


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ("", ()),
        ("v 9 9 9 1 0 0\n", ("1 other element (vertex colour)",)),
        ("  v\t9 9 9 1 0 0 1\nv 9 9 9 1 0 0\n", ("2 other elements (vertex colour)",)),
        ("v 9 9 9 1\nv 9 9 9 # 1 0 0 1\n", ()),
        ("l 1 2\n", ("1 other element (line)",)),
        ("p 1\nl 1 2\n l 2 3\n", ("3 other elements (line, point)",)),
    ],
)
def test_what_another_format_does_not_hold_is_told(tmp_path: Path, more: str, expected: tuple[str, ...]) -> None:
    saved = save(read(written(tmp_path / "a.obj", vertex_lines(box()) + quad_lines(1) + more)), tmp_path / "b.stl")
    why = "left out: MeshForge does not convert other elements to STL"
    assert saved.notes == tuple(f"{what} {'is' if what[0] == '1' else 'are'} {why}" for what in expected)


@pytest.mark.parametrize(
    ("libraries", "expected"),
    [
        ("a.mtl b.mtl", ["a.mtl", "b.mtl"]),
        ("gone.mtl b.mtl  more/c.mtl", ["b.mtl", "more/c.mtl"]),
        ("a.mtl gone.mtl", ["a.mtl"]),
        ("two words.mtl", ["two words.mtl"]),
        ("a.mtl b.mtl\nmtllib two words.mtl", ["a.mtl", "b.mtl", "two words.mtl"]),
        ("gone.mtl", []),
        ("a.mtl " * 60, ["a.mtl"]),
    ],
)
def test_all_libraries_of_a_line_go_along(tmp_path: Path, libraries: str, expected: list[str]) -> None:
    source, out = tmp_path / "in", tmp_path / "out"
    (source / "more").mkdir(parents=True)
    for name in ("a.mtl", "b.mtl", "words.mtl", "two words.mtl", "more/c.mtl"):
        (source / name).write_text("newmtl oak\n")
    asset = read(written(source / "a.obj", two_legs().replace("table.mtl", libraries)))
    save(asset, out / "a.obj")
    files = sorted(path.relative_to(out).as_posix() for path in out.rglob("*") if path.is_file())
    assert files == sorted(["a.obj", *expected])


def test_materials_and_their_textures_go_along(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    source = written(tmp_path / "in" / "a.obj", two_legs())
    (tmp_path / "in" / "table.mtl").write_text("newmtl oak\nmap_Kd wood/oak.png\n")
    (tmp_path / "in" / "wood").mkdir()
    (tmp_path / "in" / "wood" / "oak.png").write_bytes(b"png")
    save(read(source), tmp_path / "out" / "b.obj")
    assert (tmp_path / "out" / "wood" / "oak.png").read_bytes() == b"png"
    assert (tmp_path / "out" / "table.mtl").exists()
