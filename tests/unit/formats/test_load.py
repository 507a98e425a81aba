"""Loading: one asset or many, with the labels beside them."""

import json
from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import labels_beside, load, load_many, read, save
from tests.mesh_files import obj, stl_binary
from tests.soups import box, together


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "table.obj"
    path.write_bytes(obj(together(box(), box((3, 0, 0)))))
    return path


def labelled(path: Path, **labels: str) -> Path:
    path.write_text(json.dumps({"hulls": {name.replace("_", "#"): label for name, label in labels.items()}}))
    return path


def test_labels_beside_an_asset_are_used_unless_others_are_given(table: Path, tmp_path: Path) -> None:
    assert [h.label for h in load(table).hulls] == [None, None]
    labelled(tmp_path / "table.labels.json", geom0_0="leg")
    assert [h.label for h in load(str(table)).hulls] == ["leg", None]
    other = labelled(tmp_path / "other.json", geom0_1="top")
    assert [h.label for h in load(table, labels=other).hulls] == [None, "top"]


def test_labels_that_are_asked_for_must_be_there(table: Path, tmp_path: Path) -> None:
    with pytest.raises(AssetError, match=r"gone\.json"):
        load(table, labels=tmp_path / "gone.json")


def test_labels_follow_hulls_that_an_edit_counts_anew(tmp_path: Path) -> None:
    from meshforge.symbolic import SymbolicMesh, write_labels

    (tmp_path / "a.stl").write_bytes(stl_binary(together(box(), box((3, 0, 0), (1, 1, 2)))))
    labels = labelled(tmp_path / "a.labels.json", geom0_0="leg", geom0_1="top")
    mesh = load(tmp_path / "a.stl", labels)
    edited = mesh.with_hulls(mesh.hulls[1:])
    save(edited, tmp_path / "b.stl")
    assert isinstance(edited, SymbolicMesh)
    write_labels(labels_beside(tmp_path / "b.stl"), edited, ["leg", "top"])
    assert [(h.name, h.label) for h in load(tmp_path / "b.stl").hulls] == [("geom0", "top")]


def test_many_assets_are_read_one_by_one_in_order(tmp_path: Path) -> None:
    for name in ("b/two.obj", "a/one.obj", "a/deep/three.obj", "a/broken.stl", "a/text.txt"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(obj(box()) if name.endswith(".obj") else b"")
    meshes = load_many(str(tmp_path / "**" / "*.obj"))
    assert [m.asset.path.name for m in meshes if m.asset] == ["three.obj", "one.obj", "two.obj"]
    lazy = load_many([str(tmp_path / "b" / "*"), tmp_path / "a" / "broken.stl", tmp_path / "b" / "two.obj"])
    with pytest.raises(AssetError, match=r"broken\.stl"):
        next(lazy)


def test_a_pattern_that_matches_nothing_is_an_error_at_once(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match="no file matches"):
        load_many(str(tmp_path / "*.obj"))
    (tmp_path / "a.txt").write_text("")
    with pytest.raises(AssetError, match="none of the files it matches is an asset"):
        load_many(str(tmp_path / "*"))


def test_a_file_whose_name_looks_like_a_pattern_is_read(tmp_path: Path) -> None:
    path = tmp_path / "table [old].obj"
    path.write_bytes(obj(box()))
    assert [m.asset.path for m in load_many(path) if m.asset] == [path]


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("gone.obj", "there is no such file"),
        ("a.txt", "is no format that MeshForge knows"),
        ("a", "Known suffixes"),
        ("a.ob", r"did you mean \.obj\?"),
    ],
)
def test_what_cannot_be_read_is_named(tmp_path: Path, name: str, message: str) -> None:
    for there in ("a.txt", "a", "a.ob"):
        (tmp_path / there).write_text("")
    with pytest.raises(AssetError, match=message):
        read(tmp_path / name)
