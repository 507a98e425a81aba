"""Saving: the whole tree, atomically, and nothing that is there already gets hurt."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import Format, Mass, Output, output_path_of, read, save
from meshforge.formats import output_tree as saving_module
from meshforge.geometry import convex_hull
from meshforge.symbolic import Asset, Hull, SymbolicMesh
from tests.mesh_files import obj
from tests.soups import box, together

TEXTURE = b"not really a picture"


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A table with a material in a folder above."""
    (tmp_path / "in" / "tables").mkdir(parents=True)
    (tmp_path / "in" / "wood.mtl").write_text("newmtl oak\nmap_Kd oak.png\n")
    (tmp_path / "in" / "oak.png").write_bytes(TEXTURE)
    path = tmp_path / "in" / "tables" / "table.obj"
    path.write_bytes(b"mtllib ../wood.mtl\n" + obj(together(box(), box((3, 0, 0)))))
    return path


def tree(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def edited(source: Path) -> Asset:
    asset = read(source)
    return asset.with_geoms(asset.geoms[1:])


def test_files_go_where_the_text_says_they_are(source: Path, tmp_path: Path) -> None:
    saved = save(read(source), tmp_path / "out" / "a" / "b" / "table.obj")
    assert sorted(tree(tmp_path / "out")) == ["a/b/table.obj", "a/oak.png", "a/wood.mtl"]
    assert (tmp_path / "out" / "a" / "oak.png").read_bytes() == TEXTURE
    assert saved.path == saved.files[-1] == tmp_path / "out" / "a" / "b" / "table.obj"


def test_a_second_version_may_lie_beside_the_first(source: Path) -> None:
    before = tree(source.parents[1])
    save(edited(source), source.with_name("table2.obj"))
    after = tree(source.parents[1])
    assert {name: after[name] for name in before} == before
    assert set(after) - set(before) == {"tables/table2.obj"}


@pytest.mark.parametrize("overwrite", [False, True])
def test_the_input_is_never_overwritten(source: Path, overwrite: bool) -> None:
    before = tree(source.parents[1])
    with pytest.raises(AssetError, match=r"table\.obj: this file belongs to the input"):
        save(edited(source), source, overwrite=overwrite)
    with pytest.raises(AssetError, match="this file belongs to the input"):
        save(edited(source), source.parent / ".." / "tables" / "table.obj", overwrite=overwrite)
    assert tree(source.parents[1]) == before


def test_the_input_may_be_written_onto_itself_unchanged(source: Path) -> None:
    before = source.stat().st_mtime_ns
    save(read(source), source)
    assert source.stat().st_mtime_ns == before


def test_another_file_is_overwritten_only_when_allowed(source: Path, tmp_path: Path) -> None:
    out = tmp_path / "out" / "x" / "table.obj"
    out.parent.mkdir(parents=True)
    out.write_text("mine")
    with pytest.raises(AssetError, match="there is such a file already") as error:
        save(read(source), out)
    assert "overwrite" in str(error.value)
    assert tree(tmp_path / "out") == {"x/table.obj": b"mine"}
    save(read(source), out, overwrite=True)
    assert out.read_bytes() == source.read_bytes()


def test_a_file_with_the_same_content_is_left_alone(source: Path, tmp_path: Path) -> None:
    out = tmp_path / "out" / "x" / "table.obj"
    save(read(source), out)
    before = {f: f.stat().st_mtime_ns for f in (tmp_path / "out").rglob("*")}
    save(read(source), out)
    assert {f: f.stat().st_mtime_ns for f in (tmp_path / "out").rglob("*")} == before


def test_copies_may_be_hard_links(source: Path, tmp_path: Path) -> None:
    save(read(source), tmp_path / "out" / "x" / "table.obj", link=True)
    assert (tmp_path / "out" / "oak.png").samefile(tmp_path / "in" / "oak.png")
    assert not (tmp_path / "out" / "x" / "table.obj").samefile(source)


def test_copies_are_made_where_links_cannot_be(source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError("another disk")

    monkeypatch.setattr(os, "link", refuse)
    save(read(source), tmp_path / "out" / "x" / "table.obj", link=True)
    assert (tmp_path / "out" / "oak.png").read_bytes() == TEXTURE
    assert not (tmp_path / "out" / "oak.png").samefile(tmp_path / "in" / "oak.png")


def test_a_writer_that_dies_leaves_each_file_whole_and_the_main_file_for_last(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = iter([None, None, KeyboardInterrupt()])
    replace = Path.replace

    def dying(path: Path, target: Path) -> Path:
        error = next(calls)
        if error:
            raise error
        return replace(path, target)

    monkeypatch.setattr(Path, "replace", dying)
    with pytest.raises(KeyboardInterrupt):
        save(read(source), tmp_path / "out" / "x" / "table.obj")
    left = tree(tmp_path / "out")
    assert left == {name: data for name, data in tree(tmp_path / "in").items() if name in ("oak.png", "wood.mtl")}


def test_a_folder_in_the_way_is_named(source: Path, tmp_path: Path) -> None:
    (tmp_path / "table.obj").mkdir()
    with pytest.raises(AssetError, match="there is a folder of this name"):
        save(read(source), tmp_path / "table.obj")


def test_a_place_that_cannot_be_written_is_named(source: Path, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(AssetError, match="cannot be written"):
        save(read(source), tmp_path / "file" / "table.obj")


@pytest.mark.parametrize("name", ["table.xyz", "table.obi"])
def test_a_suffix_of_no_format_is_refused_with_the_nearest(source: Path, tmp_path: Path, name: str) -> None:
    with pytest.raises(AssetError, match="is no format that MeshForge knows"):
        save(read(source), tmp_path / name)


def test_a_file_that_is_gone_by_now_is_named(source: Path, tmp_path: Path) -> None:
    asset = read(source)
    output = Output(b"", copies={"gone.png": tmp_path / "gone.png"})

    class Gone(Format):
        name = "obj"
        suffixes = (".obj",)

        def read(self, path: Path, options: object) -> Asset:
            return asset

        def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
            return output

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(saving_module, "format_for", lambda *_: Gone())
        with pytest.raises(AssetError, match=r"gone\.png: cannot be read|gone\.png: cannot be written"):
            save(asset, tmp_path / "out" / "table.obj")


def test_a_mesh_made_in_memory_can_be_saved(tmp_path: Path) -> None:
    mesh = SymbolicMesh((Hull("block", "body", convex_hull(box()[0])),))
    assert [g.name for g in read(save(mesh, tmp_path / "a.obj").path).geoms] == ["block"]


def test_a_symbolic_mesh_is_saved_like_its_asset(source: Path, tmp_path: Path) -> None:
    mesh = SymbolicMesh.of(read(source))
    save(mesh.with_hulls(mesh.hulls[1:]), tmp_path / "out" / "x" / "table.obj")
    assert [g.name for g in read(tmp_path / "out" / "x" / "table.obj").geoms] == ["geom0#1"]


@pytest.fixture
def asset(source: Path) -> Iterator[Asset]:
    yield read(source)


def test_an_output_lies_below_the_output_folder_as_the_asset_below_the_base(asset: Asset, tmp_path: Path) -> None:
    assert output_path_of(asset, tmp_path, Path("out")) == Path("out/in/tables/table.obj")
    assert output_path_of(asset, tmp_path / "in", Path("out")) == Path("out/tables/table.obj")


def test_references_that_climb_above_the_base_stay_in_the_output_folder(asset: Asset, tmp_path: Path) -> None:
    path = output_path_of(asset, tmp_path / "in" / "tables", tmp_path / "out")
    assert path == tmp_path / "out" / "tables" / "table.obj"
    save(asset, path)
    assert sorted(tree(tmp_path / "out")) == ["oak.png", "tables/table.obj", "wood.mtl"]


def test_an_asset_elsewhere_counts_from_its_own_files(asset: Asset, tmp_path: Path) -> None:
    assert output_path_of(asset, tmp_path / "elsewhere", Path("out")) == Path("out/tables/table.obj")


def test_paths_may_be_relative(source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(source.parent)
    assert output_path_of(read(Path("table.obj")), Path(".."), Path("out")) == Path("out/tables/table.obj")
