"""Up in files: what stands in a format of Y stands in a format of Z, and plain meshes keep their coordinates."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import Format, list_formats, read, save
from meshforge.formats.conversion import turn_asset, turn_upright
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.geometry import Pose
from meshforge.symbolic import Surface
from tests.asset_bounds import bounds_of
from tests.conversion_samples import TURNED, doors, opaque
from tests.urdf_sample import boxes_obj

BY_NAME: dict[str, Format] = {known.name: known for known in list_formats()}


@pytest.mark.parametrize(
    ("source", "target", "said"),
    [
        ("urdf", "gltf", "the asset is turned about X to stand upright: URDF is z-up, glTF y-up"),
        ("gltf", "mjcf", "the asset is turned about X to stand upright: glTF is y-up, MJCF z-up"),
        ("obj", "gltf", "coordinates are as they were: glTF is y-up, OBJ does not say"),
        ("mjcf", "stl", "coordinates are as they were, z-up: STL does not say what is up"),
        ("urdf", "mjcf", None),
        ("obj", "ply", None),
        (None, "urdf", None),
    ],
)
def test_the_report_says_what_was_done_about_up(source: str | None, target: str, said: str | None) -> None:
    standing, notes = turn_upright(doors(), BY_NAME[source] if source else None, BY_NAME[target])
    assert notes == ((said,) if said else ())
    before, after = bounds_of(doors()), bounds_of(standing)
    is_turned = said is not None and said.startswith("the asset")
    np.testing.assert_allclose(after.size, before.size[[0, 2, 1]] if is_turned else before.size)


def test_all_of_an_asset_turns_together(tmp_path: Path) -> None:
    file = tmp_path / "box.obj"
    file.write_text(boxes_obj(((0, 0, 0), (1, 2, 3))))
    visuals = VisualSurfaces((Visual("door", file, TURNED.rotation, TURNED.translation, (1, 0, 0, 1)),))
    asset = replace(doors(), visuals=visuals, non_convex=opaque().non_convex)
    after = turn_asset(asset, TURNED)
    walls, floor = after.non_convex
    assert walls.surface is not None
    assert asset.non_convex[0].surface is not None
    np.testing.assert_allclose(walls.surface.vertices, TURNED.apply(asset.non_convex[0].surface.vertices))
    assert floor.plane is not None
    np.testing.assert_allclose(floor.plane.translation, TURNED.apply(np.array([[0, 0, -1.0]]))[0])
    np.testing.assert_allclose(after.visuals[0].vertices, TURNED.apply(asset.visuals[0].vertices), atol=1e-12)
    assert after.visuals[0].rgba == (1, 0, 0, 1)
    np.testing.assert_allclose(
        after.mechanism.joints[0].anchor, TURNED.apply(asset.mechanism.joints[0].anchor[None])[0]
    )
    np.testing.assert_allclose(after.body_poses["frame"].rotation, np.eye(3), atol=1e-12)
    shown = turn_asset(replace(asset, visuals=(Surface(*_triangle()),)), TURNED)
    np.testing.assert_allclose(shown.visuals[0].vertices, TURNED.apply(_triangle()[0]))


def _triangle() -> tuple[np.ndarray, np.ndarray]:
    return np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), np.array([[0, 1, 2]])


def test_masses_stand_up_with_their_bodies(tmp_path: Path) -> None:
    urdf = save(doors(), tmp_path / "a.urdf").path
    glb = read(save(read(urdf), tmp_path / "b.glb").path)
    back = read(save(glb, tmp_path / "c.urdf").path)
    masses = read(urdf).mechanism.inertials
    assert len(masses) == 5
    for was, now in zip(masses, turn_asset(read(urdf), TURNED).mechanism.inertials, strict=True):
        np.testing.assert_allclose(now.centre, TURNED.apply(was.centre[None])[0], atol=1e-12)
        np.testing.assert_allclose(now.inertia, TURNED.rotation @ was.inertia @ TURNED.rotation.T, atol=1e-12)
    for body, pose in read(urdf).body_poses.items():
        np.testing.assert_allclose(back.body_poses[body].translation, pose.translation, atol=1e-6)
        np.testing.assert_allclose(back.body_poses[body].rotation, pose.rotation, atol=1e-6)
    assert isinstance(back.body_poses["frame"], Pose)
