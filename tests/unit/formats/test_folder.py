"""A folder of mesh files as one asset."""

from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import labels_beside, read, save
from meshforge.geometry import convex_hull
from meshforge.symbolic import Geom
from tests.gltf_edited import names
from tests.mesh_files import obj, ply, stl_binary, wrl
from tests.soups import box, together


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    made = tmp_path / "mug"
    made.mkdir()
    (made / "hull_10.stl").write_bytes(stl_binary(box((10, 0, 0))))
    (made / "hull_2.stl").write_bytes(stl_binary(together(box((2, 0, 0)), box((2, 2, 0)), box((2, 4, 0)))))
    (made / "handle.obj").write_bytes(_two_groups())
    (made / "base.ply").write_bytes(ply(box((0, 0, 5))))
    (made / "notes.txt").write_text("not a mesh")
    (made / ".hidden.stl").write_bytes(b"")
    (made / "old").mkdir()
    return made


def _two_groups() -> bytes:
    vertices, faces = together(box(), box((0, 3, 0)))
    lines = obj((vertices, faces)).decode().splitlines()
    return "\n".join(["mtllib a.mtl", *lines[:16], "o grip", *lines[16:28], "o rod", *lines[28:], ""]).encode()


NAMES = ["base", "handle/grip", "handle/rod", "hull_2#0", "hull_2#1", "hull_2#2", "hull_10"]


def test_hulls_are_named_after_their_files_in_the_order_people_count(folder: Path) -> None:
    asset = read(folder)
    assert names(asset) == NAMES
    assert {g.body for g in asset.geoms} == {"body"}
    assert [f.name for f in asset.files] == ["base.ply", "handle.obj", "hull_2.stl", "hull_10.stl"]


def test_an_unedited_folder_is_copied_byte_for_byte(folder: Path, tmp_path: Path) -> None:
    (folder / "a.mtl").write_text("newmtl oak\n")
    saved = save(read(folder), tmp_path / "out")
    assert sorted(f.name for f in saved.files) == ["a.mtl", "base.ply", "handle.obj", "hull_10.stl", "hull_2.stl"]
    assert all(f.read_bytes() == (folder / f.name).read_bytes() for f in saved.files)
    assert not list((tmp_path / "out").glob("*.txt"))


def test_deleted_hulls_take_their_files_and_made_ones_get_files(folder: Path, tmp_path: Path) -> None:
    asset = read(folder)
    made = Geom("hull_10~1", "body", convex_hull(box((20, 0, 0))[0]), "hull_10")
    saved = save(asset.with_geoms([*(g for g in asset.geoms if g.name != "hull_10"), made]), tmp_path / "out")
    assert sorted(f.name for f in saved.files) == ["base.ply", "handle.obj", "hull_10~1.stl", "hull_2.stl"]
    assert names(read(tmp_path / "out")) == [*NAMES[:-1], "hull_10~1"]
    assert saved.names == {}


def test_pieces_of_a_file_that_loses_one_get_files_and_keep_their_names(folder: Path, tmp_path: Path) -> None:
    asset = read(folder)
    saved = save(asset.with_geoms(g for g in asset.geoms if g.name != "hull_2#0"), tmp_path / "out")
    assert names(read(tmp_path / "out")) == [n for n in NAMES if n != "hull_2#0"]
    assert {"hull_2#1.stl", "hull_2#2.stl"} <= {f.name for f in saved.files}


def test_a_name_that_cannot_stay_is_told(folder: Path, tmp_path: Path) -> None:
    asset = read(folder)
    saved = save(asset.with_geoms(g for g in asset.geoms if g.name != "handle/grip"), tmp_path / "out")
    assert saved.names == {"handle/rod": "handle"}
    assert "handle" in names(read(tmp_path / "out"))


def test_a_hull_whose_name_is_no_file_name_gets_one(folder: Path, tmp_path: Path) -> None:
    asset = read(folder)
    made = [
        Geom(f"handle/{stem}~1", "body", convex_hull(box((x, 9, 9))[0]), "handle/rod")
        for x, stem in ((0, "rod"), (3, "ROD"))
    ]
    saved = save(asset.with_geoms([*asset.geoms, *made]), tmp_path / "out")
    assert saved.names == {"handle/rod~1": "handle_rod~1", "handle/ROD~1": "handle_ROD~1_2"}
    assert set(saved.names.values()) <= set(names(read(tmp_path / "out")))


def test_any_asset_can_become_a_folder_of_one_file_a_hull(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "a.wrl").write_bytes(wrl(together(box(), box((3, 0, 0)))))
    saved = save(read(tmp_path / "a.wrl"), tmp_path / "pieces")
    assert [f.name for f in saved.files] == ["geom0#0.obj", "geom0#1.obj"]
    assert names(read(tmp_path / "pieces")) == ["geom0#0", "geom0#1"]


def test_other_mesh_files_in_the_way_are_not_taken_for_hulls(folder: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "stray.stl").write_bytes(stl_binary(box((7, 7, 7))))
    (out / "readme.txt").write_text("stays")
    with pytest.raises(AssetError, match=r"this folder has other mesh files in it, such as stray\.stl"):
        save(read(folder), out)
    assert [f.name for f in out.iterdir() if f.suffix == ".ply"] == []
    save(read(folder), out, overwrite=True)
    assert names(read(out)) == NAMES
    assert (out / "readme.txt").exists()


def test_a_new_folder_appears_whole_or_never(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from meshforge.formats import output_tree

    asset, copy, calls = read(folder), output_tree.copy_atomically, iter([None, KeyboardInterrupt()])

    def dying(source: Path, target: Path, *, link: bool) -> None:
        if error := next(calls):
            raise error
        copy(source, target, link=link)

    monkeypatch.setattr(output_tree, "copy_atomically", dying)
    with pytest.raises(KeyboardInterrupt):
        save(asset, tmp_path / "new" / "out")
    assert list((tmp_path / "new").iterdir()) == []


def test_labels_of_a_folder_lie_beside_it(folder: Path) -> None:
    assert labels_beside(folder) == folder.parent / "mug.labels.json"
