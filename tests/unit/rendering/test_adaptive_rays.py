"""Casting with fewer rays, against casting with all."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import Aabb
from meshforge.rendering.camera import VIEWS, Camera, View, aim_camera
from meshforge.rendering.raycast import ViewFrame, cast_rays, cast_rays_adaptively, cast_rays_with_steps, up_vector
from meshforge.rendering.scene import RayScene, RenderMesh, build_scene, prepare_for_rays, to_render_mesh
from tests.unit.rendering.scenes import box, table

SIZE = (201, 150)


def staged(skins: list[RenderMesh], view: View) -> tuple[RayScene, Camera]:
    points = np.concatenate([s.vertices for s in skins])
    stage = ViewFrame(Aabb.of_points(points), up_vector("Z"))
    return build_scene(skins, stage.bounds.center, stage.unit), aim_camera(view, "Z", SIZE, stage.to_unit(points))


ORTHOGRAPHIC = [view for view in VIEWS if not view.startswith("iso")]


@pytest.mark.parametrize("view", ORTHOGRAPHIC)
def test_fewer_rays_show_the_same_things(view: View) -> None:
    scene, camera = staged([to_render_mesh(h.shape) for h in table().hulls], view)
    rough = cast_rays_adaptively(prepare_for_rays(scene, None), camera)
    exact = cast_rays(scene, camera)
    assert (rough.item == exact.item).mean() > 0.998
    assert rough.item.shape == exact.item.shape == SIZE[::-1]


def test_a_step_within_one_thing_is_found_where_it_is() -> None:
    near, far = box((0, -1, 0), (1, 0.1, 1)), box((0, 0, 0), (3, 0.1, 3))
    faces = np.concatenate([near.faces, far.faces + len(near.vertices)])
    both = RenderMesh(np.concatenate([near.vertices, far.vertices]), faces)
    scene, camera = staged([both], "front")
    _, steps = cast_rays_with_steps(prepare_for_rays(scene, None), camera)
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
    assert not cast_rays_with_steps(prepare_for_rays(scene, None), camera)[1].any()


def test_nothing_is_met_of_nothing() -> None:
    scene = prepare_for_rays(build_scene([], np.zeros(3), 1.0), None)
    _, camera = staged([to_render_mesh(box((0, 0, 0), (1, 1, 1)))], "top")
    hits, steps = cast_rays_with_steps(scene, camera)
    assert (hits.item == -1).all()
    assert not steps.any()
