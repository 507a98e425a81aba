"""Distances against an independent reference, for shapes of all kinds, apart, touching and overlapping."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.geometry import Aabb, Box, Floats, Pose, Shape, close_pairs, convex_hull, distance
from tests.examples import examples
from tests.nearest import distance_bracket
from tests.shape_strategies import clouds, directions, generators, poses, shape, shapes

LAW = examples(100)
RIGHT = 1e-6  # of the diagonal; what the module states where curved surfaces touch


def diagonal(*both: Shape) -> float:
    return Aabb.union(s.aabb for s in both).diagonal


@LAW
@given(a=shapes(), b=shapes())
def test_a_distance_is_that_of_the_reference(a: Shape, b: Shape) -> None:
    below, above, _ = distance_bracket(a, b)
    slack = RIGHT * diagonal(a, b)
    assert below - slack <= distance(a, b) <= above + slack


@LAW
@given(a=shapes(), b=shapes(), share=st.sampled_from([1e-2, 2e-3, 1e-4, 1e-6, 0.0]))
def test_shapes_moved_to_a_gap_have_that_distance(a: Shape, b: Shape, share: float) -> None:
    below, above, way = distance_bracket(a, b)
    assume(above - below < 1e-9 and below > 1e-3)
    gap = share * diagonal(a, b)
    moved = b.move(Pose.of_translation(way * (gap / above - 1)))
    assert distance(a, moved) == pytest.approx(gap, abs=RIGHT * diagonal(a, moved))


def unit(points: Floats) -> Floats:
    """The points about the origin, in units of their extent."""
    return np.asarray((points - points.mean(axis=0)) / np.ptp(points, axis=0).max())


@LAW
@given(points=clouds(), other=clouds(), offset=directions())
def test_hulls_of_hard_points_have_the_distance_of_the_reference(points: Floats, other: Floats, offset: Floats) -> None:
    a, b = convex_hull(unit(points)), convex_hull(unit(other) + offset / np.linalg.norm(offset))
    below, above, _ = distance_bracket(a, b)
    slack = RIGHT * diagonal(a, b)
    assert below - slack <= distance(a, b) <= above + slack


@LAW
@given(a=shapes(), b=shapes(), pose=poses(), exponent=st.integers(-3, 3))
def test_a_distance_moves_and_scales_along(a: Shape, b: Shape, pose: Pose, exponent: int) -> None:
    factor = 10.0**exponent
    linear, offset = pose.rotation * factor, pose.translation * factor
    image = distance(a.transform(linear, offset), b.transform(linear, offset))
    assert image == pytest.approx(factor * distance(a, b), abs=2 * RIGHT * factor * diagonal(a, b))
    assert distance(b, a) == pytest.approx(distance(a, b), abs=2 * RIGHT * diagonal(a, b))


@LAW
@given(a=shapes())
def test_a_shape_is_at_distance_zero_of_itself_and_of_what_it_holds(a: Shape) -> None:
    inner = a.transform(np.eye(3) / 2, a.centroid / 2)
    assert distance(a, a) <= 1e-9
    assert distance(a, inner) <= 1e-9


@LAW
@given(rng=generators())
def test_upright_boxes_have_the_distance_of_their_corners_to_the_last_digits(rng: np.random.Generator) -> None:
    step = float(rng.choice([1.0, 0.1, 1 / 3, 0.037]))
    boxes, shapes_made = [], []
    for _ in range(6):
        low = rng.integers(-4, 5, size=3) * step
        size = rng.integers(1, 4, size=3) * step * rng.choice([1.0, 1.0, 1.0, 0.01], size=3)
        boxes.append(Aabb(low, low + size))
        shapes_made.append(Box.of_bounds(boxes[-1]) if rng.random() < 0.5 else convex_hull(boxes[-1].corners))
    found = close_pairs(shapes_made, 100.0)
    for (i, j), gap in found.items():
        apart = np.maximum(boxes[i].min - boxes[j].max, boxes[j].min - boxes[i].max).clip(0)
        assert gap == pytest.approx(float(np.linalg.norm(apart)), abs=1e-9 * step)
    assert len(found) == 15


@LAW
@given(rng=generators(), reach=st.sampled_from([0.0, 0.01, 0.3]))
def test_close_pairs_are_those_of_brute_force(rng: np.random.Generator, reach: float) -> None:
    many = [shape(str(kind), rng) for kind in rng.choice(["polytope", "box", "capsule", "cylinder"], size=9)]
    settled = frozenset(rng.choice(9, size=4, replace=False).tolist())
    slack = 1e-8 * diagonal(*many)
    wanted = [(i, j) for i in range(9) for j in range(i + 1, 9) if not {i, j} <= settled]
    exact = {pair: distance(many[pair[0]], many[pair[1]]) for pair in wanted}
    found = close_pairs(many, reach, settled)
    assert list(found) == sorted(found)
    assert {pair for pair, gap in exact.items() if gap < reach - slack} <= found.keys()
    assert found.keys() <= {pair for pair, gap in exact.items() if gap <= reach + slack}
    assert all(gap == pytest.approx(exact[pair], abs=slack) for pair, gap in found.items())
