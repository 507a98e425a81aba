"""SDFs made of other formats: links, joints, masses and visuals where they were."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.formats import read, save
from meshforge.symbolic import FeatureKind, Joint
from tests.conversion_samples import block, doors, foreign, inertial


def test_doors_come_back_with_their_visuals_and_colours(tmp_path: Path) -> None:
    found = read(save(doors(), tmp_path / "model.sdf").path)
    assert sorted((v.body, v.rgba) for v in found.visuals) == [("door", (1, 0.25, 0, 1)), ("frame", None)]


def test_model_sdf_gets_a_model_config_and_is_read_as_a_folder(tmp_path: Path) -> None:
    saved = save(doors(), tmp_path / "cupboard" / "model.sdf")
    assert {path.name for path in saved.files} >= {"model.config", "model.sdf"}
    assert len(read(tmp_path / "cupboard").geoms) == len(doors().geoms)


def test_balls_are_balls(tmp_path: Path) -> None:
    asset = doors()
    last = asset.mechanism.joints[-1]
    joint = Joint("loose", "ball", last.parent, last.child, last.anchor, last.axis)
    asset = replace(asset, mechanism=replace(asset.mechanism, joints=(*asset.mechanism.joints[:-1], joint)))
    found = read(save(asset, tmp_path / "m.sdf").path)
    assert [j.kind for j in found.mechanism.joints if j.name.startswith("loose")] == ["ball"]


def test_what_moves_freely_has_no_joint_and_that_is_told(tmp_path: Path) -> None:
    asset = foreign(
        {"world": doors().bodies[0].pose, "cup": doors().bodies[1].pose}, [("cup/a", "cup", block(0, 0, 0))]
    )
    joint = Joint("free", "floating", "world", "cup", np.zeros(3), np.array([1.0, 0, 0]))
    asset = replace(
        asset, mechanism=replace(asset.mechanism, joints=(joint,), inertials=(inertial("cup", 1, (0, 0, 0)),))
    )
    saved = save(asset, tmp_path / "m.sdf")
    assert "<joint" not in saved.path.read_text()
    assert [loss.names for loss in saved.report.lost if loss.kind is FeatureKind.JOINTS] == [("free",)]
    assert [body.name for body in read(saved.path).bodies] == ["cup"]


def test_what_is_fixed_to_the_world_stays_so(tmp_path: Path) -> None:
    floor, ball = '<geom name="floor" type="box" size="1 1 1"/>', '<body name="b"><geom size=".1"/></body>'
    (tmp_path / "m.xml").write_text(f"<mujoco><worldbody>{floor}{ball}</worldbody></mujoco>")
    saved = save(read(tmp_path / "m.xml"), tmp_path / "out" / "m.sdf")
    found = read(saved.path)
    assert [(j.parent, j.child, j.kind) for j in found.mechanism.joints] == [
        ("world", "world_link", "fixed"),
        ("world_link", "b", "fixed"),
    ]
    assert any("world as world_link" in note for note in saved.notes)


def test_names_that_sdf_keeps_to_itself_are_written_otherwise(tmp_path: Path) -> None:
    asset = foreign({"a::b": doors().bodies[0].pose}, [("a::b/x", "a::b", block(0, 0, 0))])
    saved = save(asset, tmp_path / "m.sdf")
    assert [geom.body for geom in read(saved.path).geoms] == ["a__b"]
    assert any("a::b as a__b" in note for note in saved.notes)
    assert saved.names == {"a::b/x": "a__b/x"}
