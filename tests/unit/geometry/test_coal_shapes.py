"""What coal is given: hulls of more edges at a vertex than it can count; and which boxes are near each other."""

import numpy as np
import pytest

from meshforge.geometry import Box, Cylinder, Floats, Polytope, Pose, Sphere, close_pairs, convex_hull, distance
from meshforge.geometry.arrays import bounds, near_boxes


def ball(corners: int, center: Floats) -> Polytope:
    """A polytope of so many corners on a sphere of radius one."""
    k = np.arange(corners) + 0.5
    height, turn = 1 - 2 * k / corners, np.pi * (1 + 5**0.5) * k
    flat = np.sqrt(1 - height**2)
    made = convex_hull(np.column_stack([flat * np.cos(turn), flat * np.sin(turn), height]) + center)
    assert len(made.vertices) == corners
    return made


@pytest.mark.parametrize("count", [254, 255, 300, 700])
def test_a_vertex_may_have_more_edges_than_coal_can_count(count: int) -> None:
    cone = convex_hull(np.vstack([rim(count), [[0, 0, 1]]]))
    assert np.bincount(cone.faces.ravel()).max() == count
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
    top = float(shape.aabb.max[2])
    assert distance(shape, Box(Pose.of_translation([0, 0, top + 1.5]), np.ones(3))) == pytest.approx(0.5, abs=1e-9)
    assert distance(shape, Box(Pose.of_translation([2.5, 0, 0]), np.ones(3))) == pytest.approx(0.5, abs=1e-9)
    above = shape.vertices[shape.vertices[:, 2].argmax()] + np.array([0, 0, 1.0])
    assert distance(shape, Cylinder(Pose.of_translation(above), 0.4, 0.6)) == pytest.approx(0.4, abs=1e-8)
    mirrored = shape.transform(np.diag([1.0, 1.0, -1.0]), np.array([0, 0, 2 * top + 0.3]))
    assert distance(shape, mirrored) == pytest.approx(0.3, abs=1e-9)
    inside = shape.transform(np.eye(3) / 20, shape.vertices.mean(axis=0) * 0.95)
    around = shape.transform(np.eye(3) * 20, shape.vertices.mean(axis=0) * -19)
    for one in (inside, around, Sphere(Pose.of_translation(shape.vertices.mean(axis=0)), 0.01)):
        assert distance(shape, one) == distance(one, shape) == 0.0


def test_distances_do_not_depend_on_what_was_measured_before() -> None:
    """Polytopes of coal's are written to again and again."""
    balls = [ball(corners, np.array([0, 0, 2.5 * k])) for k, corners in enumerate((8, 20, 33, 100, 192, 193))]
    first = close_pairs(balls, 1.0)
    assert len(first) == len(balls) - 1
    for one in balls[::-1]:
        distance(one, ball(5, np.array([9.0, 0, 0])))
    assert close_pairs(balls, 1.0) == first


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
