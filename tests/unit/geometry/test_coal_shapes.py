"""What coal is given: shapes made a quick way are those it makes from points and triangles, one by one."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import coal
import numpy as np
import pytest

from meshforge.geometry import Box, Floats, Polytope, Pose, close_pairs, convex_hull, distance
from meshforge.geometry.arrays import bounds, near_boxes
from meshforge.geometry.proximity import _POOL_SIZE, CoalFrame, _pool, split_for_coal


def ball(corners: int, center: Floats) -> Polytope:
    """A polytope of so many corners on a sphere of radius one."""
    k = np.arange(corners) + 0.5
    height, turn = 1 - 2 * k / corners, np.pi * (1 + 5**0.5) * k
    flat = np.sqrt(1 - height**2)
    made = convex_hull(np.column_stack([flat * np.cos(turn), flat * np.sin(turn), height]) + center)
    assert len(made.vertices) == corners
    return made


class Odd:
    """A shape of a kind that nobody knows."""

    kind = "odd"


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


def test_a_vessel_holds_nothing_of_what_was_in_it_before() -> None:
    rng = np.random.default_rng(1)
    shapes = [ball(int(corners), rng.normal(size=3) * 3) for corners in rng.permutation(np.arange(4, 200, 7))]
    pairs = [(a, b) for a in shapes for b in shapes if a is not b]
    first = [distance(a, b) for a, b in pairs]
    assert [distance(a, b) for a, b in reversed(pairs)] == first[::-1]


def test_vessels_are_used_again_and_not_too_many_are_kept() -> None:
    crowd = [ball(30, np.array([3.0 * k, 0, 0])) for k in range(100)]
    assert len(close_pairs(crowd, 1.5)) == 99
    assert len(_pool[32]) == _POOL_SIZE
    kept = {id(vessel.shape) for vessel in _pool[32]}
    close_pairs(crowd[:5], 1.5)
    assert {id(vessel.shape) for vessel in _pool[32]} == kept


def test_vessels_come_back_when_a_shape_has_no_place() -> None:
    shapes = [ball(30, np.zeros(3)), ball(30, np.ones(3))]
    distance(*shapes)
    kept = len(_pool[32])
    with pytest.raises(TypeError, match="no distance for shapes of kind odd"):
        CoalFrame.of_bounds(np.zeros(3), np.ones(3)).place([*shapes, Odd()]).__enter__()  # type: ignore[list-item]
    assert len(_pool[32]) == kept


def test_threads_do_not_pour_into_each_others_vessels() -> None:
    rng = np.random.default_rng(2)
    crowds = [[ball(40, rng.normal(size=3) * 2) for _ in range(12)] for _ in range(8)]
    wanted = [close_pairs(crowd, 1.0) for crowd in crowds]
    with ThreadPoolExecutor(8) as pool:
        for _ in range(5):
            assert list(pool.map(lambda crowd: close_pairs(crowd, 1.0), crowds)) == wanted


@pytest.mark.parametrize("count", [254, 255, 300, 700])
def test_a_vertex_may_have_more_edges_than_coal_can_count(count: int) -> None:
    cone = convex_hull(np.vstack([rim(count), [[0, 0, 1]]]))
    assert np.bincount(cone.faces.ravel()).max() == count
    cut = split_for_coal(cone)
    assert (len(cut) > 1) == (count > 254)
    assert sum(part.volume for part in cut) == pytest.approx(cone.volume, rel=1e-12)
    small = Box(Pose.of_translation([0, 0, 1.75]), np.array([0.25, 0.25, 0.25]))
    assert distance(cone, small) == pytest.approx(0.5, abs=1e-9)
    beside = Box(Pose.of_translation([2.5, 0, 0]), np.array([0.5, 0.5, 0.5]))
    others = [small, beside, cone, Box(Pose.of_translation([9, 0, 0]), np.ones(3))]
    assert close_pairs(others, 1.05) == pytest.approx({(0, 2): 0.5, (1, 2): 1.0}, abs=1e-9)
    assert close_pairs(others, 1.05, frozenset({1, 2})) == pytest.approx({(0, 2): 0.5}, abs=1e-9)


def rim(count: int) -> Floats:
    turn = np.arange(count) / count * 2 * np.pi
    return np.column_stack([np.cos(turn), np.sin(turn), np.zeros(count)])


def fanned(count: int) -> Polytope:
    """A leaning cone whose base is a fan about one vertex, so that two vertices have edges to all others."""
    k = np.arange(count)
    side = np.column_stack([k, (k + 1) % count, np.full(count, count)])
    base = np.column_stack([np.zeros(count - 2, dtype=int), k[2:], k[1:-1]])
    return Polytope(np.vstack([rim(count), [[0.3, 0.2, 1]]]), np.concatenate([side, base]))


@pytest.mark.parametrize(
    "shape",
    [
        fanned(300),
        convex_hull(np.vstack([rim(300), [[0.3, 0, 1], [0, 0.3, -1]]])),
        convex_hull(np.vstack([rim(600), [[0.5, 0, 1], [-0.2, 0.6, -0.1]]])),
    ],
    ids=["leaning cone", "double cone", "flat double cone"],
)
def test_several_vertices_may_have_too_many_edges(shape: Polytope) -> None:
    assert (np.bincount(shape.faces.ravel()) > 254).sum() == 2
    cut = split_for_coal(shape)
    assert all(np.bincount(part.faces.ravel()).max() <= 254 for part in cut)
    assert sum(part.volume for part in cut) == pytest.approx(shape.volume, rel=1e-9)
    top = float(shape.aabb.max[2])
    assert distance(shape, Box(Pose.of_translation([0, 0, top + 1.5]), np.ones(3))) == pytest.approx(0.5, abs=1e-9)
    assert distance(shape, Box(Pose.of_translation([2.5, 0, 0]), np.ones(3))) == pytest.approx(0.5, abs=1e-9)


def test_a_frame_makes_what_lies_in_it_about_one_long() -> None:
    for scale in (1e-6, 1.0, 3e5):
        low, high = np.array([3.0, -1, 2]) * scale, np.array([5.0, 7, 2]) * scale
        frame = CoalFrame.of_bounds(low, high)
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
