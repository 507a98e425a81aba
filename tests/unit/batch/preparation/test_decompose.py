import re
from dataclasses import replace
from pathlib import Path

import pytest

from meshforge.batch import Preparation, apply_preparation, decompose_asset, find_sources, replay_preparation
from meshforge.common import AssetError
from meshforge.formats import NO_GEOMETRY, load, read, save
from meshforge.geometry import volume_of_union
from meshforge.geometry.decomposition.engines import DecomposeSettings
from meshforge.symbolic import NonConvexPiece, Surface, SymbolicMesh
from tests.unit.batch.preparation.samples import PIECES, QUICK, VOXELS, stand, write_stand


def test_opaque_pieces_and_bodies_that_only_show_something_can_be_decomposed(tmp_path: Path) -> None:
    asset = read(write_stand(tmp_path))
    assert {source.what: source.kind for source in find_sources(asset)} == PIECES
    assert [source.base for source in find_sources(asset)] == ["frame/body", "cover/geom0"]


def test_a_prepared_asset_is_not_noted_to_have_no_collision_geometry(tmp_path: Path) -> None:
    path = write_stand(tmp_path)
    path.write_text(re.sub(r"(?s)<collision.*</collision>", "", path.read_text()))
    asset = read(path)
    (gone,) = {*asset.notes} - {
        *apply_preparation(asset, decompose_asset(asset, Preparation(), QUICK).preparation).notes
    }
    assert gone == NO_GEOMETRY
    assert apply_preparation(asset, Preparation()).notes == asset.notes


@pytest.mark.parametrize("settings", [QUICK, VOXELS], ids=["coacd", "vhacd"])
def test_the_hulls_take_the_place_of_what_they_were_made_of(tmp_path: Path, settings: DecomposeSettings) -> None:
    asset = read(write_stand(tmp_path))
    done = decompose_asset(asset, Preparation(), settings)
    ready = apply_preparation(asset, done.preparation)
    made = {geom.name: geom for geom in ready.geoms[len(asset.geoms) :]}
    assert ready.non_convex == () and ready.geoms[: len(asset.geoms)] == asset.geoms
    bodies = {name.partition("/")[0] for name in made}
    assert bodies == {"frame", "cover"} and all(geom.body in bodies for geom in made.values())
    assert {geom.parent for geom in made.values() if geom.body == "frame"} == {"frame/body"}
    assert {geom.parent for geom in made.values() if geom.body == "cover"} == {None}
    frame = [geom for name, geom in made.items() if geom.body == "frame"]
    assert [geom.name for geom in frame] == [f"frame/body#{k}" for k in range(len(frame))]
    assert volume_of_union([geom.shape for geom in frame]) == pytest.approx(5.0, rel=0.15)


def test_the_edited_file_has_the_hulls_in_the_place_of_the_piece(tmp_path: Path) -> None:
    asset, preparation = stand(tmp_path / "in")
    mesh = SymbolicMesh.of(apply_preparation(asset, preparation))
    saved = save(mesh, tmp_path / "out/stand.urdf")
    back = load(saved.path)
    assert sorted(hull.name for hull in back.hulls) == sorted(hull.name for hull in mesh.hulls)
    assert back.asset and back.asset.non_convex == ()
    text = saved.path.read_text()
    assert text.count('<friction mu="0.3"/>') == 2 and "<!-- a stand -->" in text
    assert text.count('filename="corner.obj"') == 2  # both visuals, as they were


def test_twice_the_same_gives_nothing_new(tmp_path: Path) -> None:
    asset, preparation = stand(tmp_path)
    again = decompose_asset(asset, preparation, VOXELS)
    assert again.made == () and again.preparation.steps == preparation.steps


def test_some_pieces_can_be_named(tmp_path: Path) -> None:
    asset = read(write_stand(tmp_path))
    first = decompose_asset(asset, Preparation(), QUICK, only=["co*"])
    assert [entry.what for entry in first.made] == ["cover"]
    then = decompose_asset(asset, first.preparation, VOXELS)
    assert [entry.what for entry in then.made] == ["frame/body"]
    assert [step.settings["method"] for step in then.preparation.steps] == ["coacd", "vhacd"]


def test_again_does_anew_what_is_done_and_names_stay(tmp_path: Path) -> None:
    asset, preparation = stand(tmp_path)
    again = decompose_asset(asset, preparation, VOXELS, only=["frame/*"], again=True)
    assert [entry.what for entry in again.made] == ["frame/body"]
    assert [step.settings["method"] for step in again.preparation.steps] == ["coacd", "vhacd"]
    assert "frame/body#0" in again.made[0].made and again.dropped == ()


def test_names_that_the_file_has_already_are_not_given_again(tmp_path: Path) -> None:
    path = write_stand(tmp_path)
    path.write_text(path.read_text().replace('name="foot"', 'name="body#1"'))
    asset = read(path)
    done = decompose_asset(asset, Preparation(), QUICK, only=["frame/body"])
    assert list(done.made[0].made) == ["frame/body#0", "frame/body#2"]


def test_a_piece_that_fails_is_told_and_the_others_are_done(tmp_path: Path) -> None:
    asset = read(write_stand(tmp_path))
    line = Surface(asset.visuals[0].vertices * [1, 0, 0], asset.visuals[0].faces)
    bad = replace(asset, non_convex=(NonConvexPiece("frame/wire", "frame", "flat", line), *asset.non_convex))
    done = decompose_asset(bad, Preparation(), QUICK)
    assert [(lost.what, "no area" in lost.why) for lost in done.failed] == [("frame/wire", True)]
    assert [entry.what for entry in done.made] == ["frame/body", "cover"]
    assert [piece.name for piece in apply_preparation(bad, done.preparation).non_convex] == ["frame/wire"]


BALL = '<collision><geometry><sphere radius="1"/></geometry></collision>'


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('xyz="0 0 -1"', 'xyz="0 0 -2"'),
        ("<!-- a stand -->", "<!-- a better stand -->"),
        ('name="stand"', 'name="rack"'),
        ('upper="1"', 'upper="2"'),
    ],
)
def test_a_preparation_stays_where_other_things_change(tmp_path: Path, old: str, new: str) -> None:
    asset, preparation = stand(tmp_path)
    asset.path.write_text(asset.path.read_text().replace(old, new))
    assert len(apply_preparation(read(asset.path), preparation).geoms) == 5


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ('scale="1 1 0.5"', 'scale="1 1 0.6"', "cover has another geometry now"),
        ('<origin xyz="0 0 2"/>', '<origin xyz="0 0 2.5"/>', "cover has another geometry now"),
        ('<link name="cover">', f'<link name="cover">{BALL}', "cover has collision geometry now"),
        ('name="body"', 'name="cast"', "frame/body is gone"),
    ],
)
def test_a_preparation_is_never_applied_to_other_geometry(tmp_path: Path, old: str, new: str, problem: str) -> None:
    asset, preparation = stand(tmp_path)
    asset.path.write_text(asset.path.read_text().replace(old, new))
    changed = read(asset.path)
    with pytest.raises(AssetError, match=f"out of date: {problem}") as caught:
        apply_preparation(changed, preparation)
    assert "meshforge prepare" in caught.value.message
    kept = replay_preparation(changed, preparation)
    assert len(kept.lost) == 1 and len(kept.preparation.steps[0].replaced) == 1
    done = decompose_asset(changed, preparation, QUICK)
    assert len(done.dropped) == 1 and apply_preparation(changed, done.preparation).non_convex == ()
