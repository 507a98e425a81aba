"""Casting with fewer rays, against casting with all."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import Aabb
from meshforge.views.camera import VIEWS, Camera, View, look
from meshforge.views.rough import met_roughly, met_with_steps
from meshforge.views.roundness import Skin, skin
from meshforge.views.scene import Scene, assembled, seen_from
from meshforge.views.stage import Stage, met, upright
from tests.unit.views.scenes import box, table

SIZE = (201, 150)


def staged(skins: list[Skin], view: View) -> tuple[Scene, Camera]:
    points = np.concatenate([s.vertices for s in skins])
    stage = Stage(Aabb.of_points(points), upright("Z"))
    return assembled(skins, stage.bounds.center, stage.unit), look(view, "Z", SIZE, stage.to_unit(points))


ORTHOGRAPHIC = [view for view in VIEWS if not view.startswith("iso")]


@pytest.mark.parametrize("view", ORTHOGRAPHIC)
def test_fewer_rays_show_the_same_things(view: View) -> None:
    scene, camera = staged([skin(h.shape) for h in table().hulls], view)
    rough = met_roughly(seen_from(scene, None), camera)
    exact = met(scene, camera)
    assert (rough.item == exact.item).mean() > 0.998
    assert rough.item.shape == exact.item.shape == SIZE[::-1]


def test_a_step_within_one_thing_is_found_where_it_is() -> None:
    near, far = box((0, -1, 0), (1, 0.1, 1)), box((0, 0, 0), (3, 0.1, 3))
    faces = np.concatenate([near.faces, far.faces + len(near.vertices)])
    both = Skin(np.concatenate([near.vertices, far.vertices]), faces)
    scene, camera = staged([both], "front")
    _, steps = met_with_steps(seen_from(scene, None), camera)
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
    scene, camera = staged([Skin(points, faces)], "front")
    assert not met_with_steps(seen_from(scene, None), camera)[1].any()


def test_nothing_is_met_of_nothing() -> None:
    scene = seen_from(assembled([], np.zeros(3), 1.0), None)
    _, camera = staged([skin(box((0, 0, 0), (1, 1, 1)))], "top")
    hits, steps = met_with_steps(scene, camera)
    assert (hits.item == -1).all()
    assert not steps.any()
