"""Written SDFs: unedited ones byte for byte, edited ones with other collisions and nothing else."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import save
from meshforge.geometry import Box, Capsule, Ellipsoid, Pose, Sphere
from meshforge.symbolic import Asset, Geom
from tests.corpus_case import ROOT
from tests.sdf_sample import SAMPLE, box, link, model, put_text, read, sample, write
from tests.urdf_sample import made, put, without

TURNED = Pose.from_rpy([1, 2, 3], [0.3, -0.5, 1.1])
PARTS = ROOT / "sdf"


def again(asset: Asset, folder: Path) -> Asset:
    """The asset after it was written and read; nothing of its hulls changed on the way."""
    found = read(put(write(asset), folder / "model.sdf"))
    assert {g.name for g in found.geoms} == {g.name for g in asset.geoms}
    was = {g.name: g.shape for g in asset.geoms}
    for geom in found.geoms:
        np.testing.assert_allclose(geom.shape.aabb.min, was[geom.name].aabb.min, atol=1e-9)
        np.testing.assert_allclose(geom.shape.aabb.max, was[geom.name].aabb.max, atol=1e-9)
    return found


def outside(text: str) -> str:
    """A text without its collisions."""
    return re.sub(r"\s*<collision.*?</collision>", "", text, flags=re.S)


def test_an_unedited_file_is_written_byte_for_byte_with_its_files(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    saved = save(asset, tmp_path / "out" / "model.sdf")
    assert saved.path.read_bytes() == SAMPLE.encode()
    below = sorted(path.relative_to(tmp_path / "out").as_posix() for path in saved.files)
    assert below == ["meshes/three.obj", "model.config", "model.sdf"]
    assert [geom.name for geom in read(saved.path).geoms] == [geom.name for geom in asset.geoms]


def test_an_edit_changes_collisions_and_no_other_byte(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    ball = made(asset, "base/plate", Sphere(TURNED, 0.2))
    kept = without(asset, "base/plate", "base/posts#1", "wheel/tyre")
    edit = kept.with_geoms([*kept.geoms, ball])
    text = write(edit).main.decode()
    assert outside(text) == outside(SAMPLE)
    assert "<mu>0.7</mu>" in text  # inherited
    assert text.count("<max_contacts>4</max_contacts>") == 2
    assert again(edit, tmp_path / "out").non_convex == ()


def test_line_ends_and_encoding_stay(tmp_path: Path) -> None:
    text = (
        SAMPLE.replace("a cart", "ein Stühlchen").replace('"1.0"?', '"1.0" encoding="latin-1"?').replace("\n", "\r\n")
    )
    path = sample(tmp_path)
    path.write_bytes(text.encode("latin-1"))
    asset = read(path)
    ball = made(asset, "base/plate", Sphere(TURNED, 0.2))
    out = write(asset.with_geoms([*asset.geoms, ball])).main
    assert "ein Stühlchen" in out.decode("latin-1")
    assert b"\n" not in out.replace(b"\r\n", b"")


def test_made_shapes_are_native_where_the_version_has_them(tmp_path: Path) -> None:
    for version, kinds in (("1.7", ["polytope", "polytope", "box"]), ("1.8", ["capsule", "ellipsoid", "box"])):
        asset = read(put_text(tmp_path / version, model(link(box()), version=version)))
        shapes = [Capsule(TURNED, 0.2, 0.4), Ellipsoid(TURNED, np.array([0.1, 0.2, 0.3])), Box(TURNED, np.ones(3))]
        new = [made(asset, "a/c0", shape, k) for k, shape in enumerate(shapes)]
        output = write(asset.with_geoms([*asset.geoms, *new]))
        found = read(put(output, tmp_path / version / "out" / "model.sdf"))
        assert [geom.shape.kind for geom in found.geoms[1:]] == kinds
        assert len(output.notes) == kinds.count("polytope")


def test_a_hull_of_another_link_or_of_none_is_new_and_has_a_name(tmp_path: Path) -> None:
    asset = read(put_text(tmp_path, model(link(box()), '<link name="b"/>')))
    new = Geom("thing", "b", Box(TURNED, np.ones(3)))
    text = write(asset.with_geoms([*asset.geoms, new])).main.decode()
    assert '<link name="b">\n  <collision name="thing">' in text


def test_pieces_that_stay_get_files_in_metres_beside_their_mesh(tmp_path: Path) -> None:
    two = "<mesh><uri>model://cart/meshes/two.obj</uri><scale>1 2 1</scale></mesh>"
    path = sample(tmp_path, model(link(two)))
    (path.parent / "meshes" / "two.obj").write_bytes((PARTS / "parts" / "two.obj").read_bytes())
    asset = read(path)
    edit = without(asset, "a/c0#0")
    output = write(edit)
    assert list(output.made) == ["meshes/model--a_c0_1.obj"]
    assert "<uri>model://cart/meshes/model--a_c0_1.obj</uri>" in output.main.decode()
    again(edit, tmp_path / "out")
    (path.parent / "meshes" / "two.obj").write_text("o left\n")
    with pytest.raises(AssetError, match="has changed since"):
        write(edit)


def test_an_edited_mesh_that_was_a_submesh_is_used_whole(tmp_path: Path) -> None:
    mesh = f"<mesh><uri>{PARTS / 'parts' / 'two.obj'}</uri><submesh><name>right</name></submesh></mesh>"
    asset = read(put_text(tmp_path, model(link(mesh))))
    hull = made(asset, "a/c0", asset.geoms[0].shape)
    edit = asset.with_geoms([hull])
    assert b"submesh" not in write(edit).main
    again(edit, tmp_path / "out")


def test_a_computed_mass_changes_only_where_that_is_asked(tmp_path: Path) -> None:
    text = model(link(box(), box(2, 2, 2), more='<inertial auto="true"/>\n'), version="1.11")
    asset = read(put_text(tmp_path, text))
    with pytest.raises(AssetError, match="--mass recompute"):
        write(without(asset, "a/c1"))
    assert b'auto="true"' in write(without(asset, "a/c1"), mass="recompute").main
    assert write(asset).main.decode() == text
    assert asset.mechanism.inertials == ()


def test_an_edit_in_an_included_model_changes_that_file_only(tmp_path: Path) -> None:
    text = model(link(box()), "<include><uri>model://part</uri></include>")
    asset = read(put_text(tmp_path, text), PARTS)
    edit = without(asset, "part::p/new")
    output = write(edit)
    assert output.main.decode() == text
    assert b"<collision" not in output.made["part/model.sdf"]
    assert output.copies["part/model.config"] == PARTS / "part" / "model.config"
    again(edit, tmp_path / "out")


def test_an_included_model_beside_the_folder_goes_beside_the_output(tmp_path: Path) -> None:
    top = tmp_path / "in" / "top"
    part = tmp_path / "in" / "part"
    shutil.copytree(PARTS / "part", part)
    path = put_text(top, model(link(box()), "<include><uri>../part</uri></include>"))
    saved = save(without(read(path), "part::p/new"), tmp_path / "out" / "top" / "model.sdf")
    assert [geom.name for geom in read(saved.path).geoms] == ["a/c0"]
    assert b"<collision" not in (tmp_path / "out" / "part" / "model.sdf").read_bytes()


def test_a_model_that_is_included_twice_is_not_edited_here(tmp_path: Path) -> None:
    include = "<include><uri>model://part</uri><name>{}</name></include>"
    asset = read(put_text(tmp_path, model(link(box()), include.format("x"), include.format("y"))), PARTS)
    assert write(without(asset, "a/c0")).made["part/model.sdf"] == (PARTS / "part" / "model.sdf").read_bytes()
    with pytest.raises(AssetError, match="is included 2 times") as error:
        write(without(asset, "x::p/new"))
    assert str(PARTS / "part" / "model.sdf") in str(error.value)


def test_a_world_is_read_only_and_says_what_to_do(tmp_path: Path) -> None:
    text = f'<sdf version="1.7"><world name="w"><model name="m">{link(box())}</model></world></sdf>'
    asset = read(put_text(tmp_path, text))
    assert write(asset).main.decode() == text
    with pytest.raises(AssetError, match="Put its <model> into a file of its own"):
        write(without(asset, "a/c0"))


def test_two_files_that_would_become_one_are_refused(tmp_path: Path) -> None:
    for root in ("one", "two"):
        (tmp_path / root / "x" / "meshes").mkdir(parents=True)
        (tmp_path / root / "x" / "meshes" / "a.obj").write_bytes((PARTS / "parts" / "cube.obj").read_bytes())
    near, far = "model://x/meshes/a.obj", "x/meshes/a.obj"
    path = put_text(tmp_path / "two", model(link(f"<mesh><uri>{near}</uri></mesh>", f"<mesh><uri>{far}</uri></mesh>")))
    asset = read(path, tmp_path / "one")
    with pytest.raises(AssetError, match="would both become"):
        write(asset)
