"""What coal is given: shapes made a quick way are those it makes from points and triangles, one by one."""

from __future__ import annotations

import gc
from typing import Any

import coal
import numpy as np
import pytest

from meshforge.geometry import Box, Floats, Polytope, Pose, close_pairs, convex_hull, distance
from meshforge.geometry.aabb import bounds
from meshforge.geometry.coal_shapes import Frame, _known
from meshforge.geometry.distance import near_boxes


def ball(corners: int, center: Floats) -> Polytope:
    """A polytope of so many corners on a sphere of radius one."""
    k = np.arange(corners) + 0.5
    height, turn = 1 - 2 * k / corners, np.pi * (1 + 5**0.5) * k
    flat = np.sqrt(1 - height**2)
    made = convex_hull(np.column_stack([flat * np.cos(turn), flat * np.sin(turn), height]) + center)
    assert len(made.vertices) == corners
    return made


def plainly(shape: Polytope) -> Any:
    points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    points.extend(list(shape.vertices / 8))
    triangles.extend([coal.Triangle(*corners) for corners in shape.faces.tolist()])
    return coal.Convex(points, triangles)


def plain_distance(a: Polytope, b: Polytope) -> float:
    request = coal.DistanceRequest()
    request.enable_signed_distance, request.gjk_tolerance, request.gjk_max_iterations = False, 1e-10, 512
    still = coal.Transform3s()
    found = coal.distance(plainly(a), still, plainly(b), still, request, coal.DistanceResult())
    return float(max(0.0, found * 8))


@pytest.mark.parametrize("corners", [4, 12, 31, 32, 33, 48, 49, 80, 128, 129, 300])
def test_shapes_of_few_and_of_many_corners_have_the_distances_of_shapes_made_plainly(corners: int) -> None:
    rng = np.random.default_rng(corners)
    for _ in range(20):
        way = rng.normal(size=3)
        a, b = ball(corners, np.zeros(3)), ball(20, way / np.linalg.norm(way) * rng.uniform(1.5, 3))
        assert distance(a, b) == pytest.approx(plain_distance(a, b), abs=1e-8)


def test_a_shape_is_given_to_coal_once_while_the_frame_stays() -> None:
    row = [convex_hull(Box(Pose.of_translation([k, 0, 0]), np.array([0.6, 1, 1])).vertices) for k in range(4)]
    close_pairs(row, 0.1)
    first = _known[row[1]]
    close_pairs([*row, ball(20, np.array([1.0, 0, 0]))], 0.1)
    assert _known[row[1]] is first
    far = ball(20, np.array([100.0, 0, 0]))
    assert distance(row[1], far) == pytest.approx(distance(far, row[1]), abs=1e-9)
    assert _known[row[1]] is not first


def test_what_coal_was_given_goes_with_the_shape() -> None:
    gone = ball(10, np.zeros(3))
    distance(gone, ball(10, np.ones(3)))
    gc.collect()
    before = len(_known)
    del gone
    gc.collect()
    assert len(_known) < before


def test_a_frame_makes_what_lies_in_it_about_one_long() -> None:
    for scale in (1e-6, 1.0, 3e5):
        low, high = np.array([3.0, -1, 2]) * scale, np.array([5.0, 7, 2]) * scale
        frame = Frame.around(low, high)
        assert 0.5 <= np.linalg.norm(high - low) / frame.unit < 1
        assert np.abs((np.array([low, high]) - frame.origin) / frame.unit).max() <= 1


def test_boxes_near_each_other_are_found_in_blocks_too() -> None:
    rng = np.random.default_rng(0)
    low = rng.random((1300, 3)) * 30
    high = low + rng.random((1300, 3))
    apart = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2)
    wanted = np.argwhere(np.triu(apart <= 0.5, 1))
    assert len(wanted) > 100
    assert near_boxes(low, high, 0.5) == [(i, j) for i, j in wanted.tolist()]


def test_bounds_are_the_corners_of_the_boxes() -> None:
    shapes = [ball(8, np.array([k, 0.0, 0.0])) for k in range(3)]
    low, high = bounds([shape.aabb for shape in shapes])
    assert low.shape == high.shape == (3, 3)
    assert all((low[k] == s.aabb.min).all() and (high[k] == s.aabb.max).all() for k, s in enumerate(shapes))
