"""Lines where a surface steps back behind itself."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import Aabb
from meshforge.rendering.camera import Camera, View, aim_camera
from meshforge.rendering.raycast import ViewFrame, cast_rays, find_steps, up_vector
from meshforge.rendering.scene import RayScene, RenderMesh, build_scene
from tests.unit.rendering.scenes import box

SIZE = (201, 150)


def staged(skins: list[RenderMesh], view: View) -> tuple[RayScene, Camera]:
    points = np.concatenate([s.vertices for s in skins])
    stage = ViewFrame(Aabb.of_points(points), up_vector("Z"))
    return build_scene(skins, stage.bounds.center, stage.unit), aim_camera(view, "Z", SIZE, stage.to_unit(points))


def test_a_step_within_one_thing_is_found_where_it_is() -> None:
    near, far = box((0, -1, 0), (1, 0.1, 1)), box((0, 0, 0), (3, 0.1, 3))
    faces = np.concatenate([near.faces, far.faces + len(near.vertices)])
    both = RenderMesh(np.concatenate([near.vertices, far.vertices]), faces)
    scene, camera = staged([both], "front")
    steps = find_steps(cast_rays(scene, camera), camera)
    rows, columns = np.nonzero(steps)
    side = 0.88 * 150 / 3
    for found, middle in ((rows, 74.5), (columns, 100)):
        assert abs(found.min() - (middle - side / 2)) <= 2
        assert abs(found.max() - (middle + side / 2)) <= 2
    assert steps.sum() == pytest.approx(2 * 4 * side, rel=0.1), "two pixels wide, all around"


def test_a_slope_is_no_step() -> None:
    turn = np.linspace(0, np.pi, 60)
    arch = np.column_stack([np.cos(turn), -np.sin(turn)])
    points = np.concatenate([np.column_stack([arch, np.full(60, z)]) for z in (0.0, 1.0)])
    k = np.arange(59)
    faces = np.concatenate([np.column_stack([k, k + 1, k + 61]), np.column_stack([k, k + 61, k + 60])])
    scene, camera = staged([RenderMesh(points, faces)], "front")
    assert not find_steps(cast_rays(scene, camera), camera).any()
