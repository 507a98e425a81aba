"""Laws of simpler hulls around hulls."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import nnls
from scipy.spatial import ConvexHull

from meshforge.geometry import (
    Floats,
    HullBudget,
    Polytope,
    convex_hull,
    enclose,
    is_closed,
    is_convex,
    is_outward,
    polygon_sizes,
)
from tests.examples import examples
from tests.shape_strategies import clouds, generators

_BUDGETS = st.builds(HullBudget, st.integers(8, 64), st.integers(6, 64), st.integers(4, 32))


def heights(points: Floats, hull: Polytope) -> Floats:
    """How far (n,) each point lies above the highest face plane of a hull; needles of faces left out."""
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    wide = lengths > 1e-8 * np.ptp(hull.vertices, axis=0).max() ** 2
    units = normals[wide] / lengths[wide, None]
    found: Floats = (points @ units.T - np.einsum("ij,ij->i", a[wide], units)).max(axis=1)
    return found


def distance_to(point: Floats, vertices: Floats) -> float:
    """The distance of a point from the convex hull of points (n, 3), as a quadratic programme."""
    scale = np.abs(vertices - point).max()
    rows = np.vstack([(vertices - point).T / scale, np.full((1, len(vertices)), 1e3)])
    weights, _ = nnls(rows, np.array([0, 0, 0, 1e3]), maxiter=100 * len(vertices))
    return float(np.linalg.norm(weights / weights.sum() @ (vertices - point)))


@pytest.mark.slow
@examples(80)
@given(clouds(), _BUDGETS)
def test_a_simpler_hull_is_convex_holds_the_old_one_and_keeps_to_its_budget(cloud: Floats, budget: HullBudget) -> None:
    hull = convex_hull(cloud)
    found = enclose(hull, budget)
    if found is None:
        return
    made, size = found.hull, float(np.ptp(hull.vertices, axis=0).max())
    assert (
        is_closed(made.faces) and is_outward(made.vertices, made.faces) and is_convex(made.vertices, made.faces, 1e-7)
    )
    assert heights(hull.vertices, made).max() <= 1e-9 * size + 1e-13 * np.abs(hull.vertices).max()
    assert len(made.vertices) <= budget.vertices
    sizes = polygon_sizes(made)
    assert len(sizes) <= budget.polygons and max(sizes) <= budget.polygon_vertices


@pytest.mark.slow
@examples(60)
@given(generators(), st.integers(8, 40))
def test_the_error_is_the_distance_of_the_farthest_vertex(rng: np.random.Generator, vertices: int) -> None:
    hull = convex_hull(rng.normal(size=(60, 3)) * 10.0 ** rng.uniform(-1, 0, size=3))
    found = enclose(hull, HullBudget(vertices))
    assert found is not None
    farthest = max(distance_to(vertex, hull.vertices) for vertex in found.hull.vertices)
    assert found.error == pytest.approx(farthest, rel=1e-4, abs=1e-5)


@pytest.mark.slow
@examples(25)
@given(generators())
def test_there_is_always_a_box(rng: np.random.Generator) -> None:
    hull = convex_hull(rng.normal(size=(30, 3)) * 10.0 ** rng.uniform(-3, 3, size=3))
    found = enclose(hull, HullBudget(8, 6, 4))
    assert found is not None and len(found.hull.vertices) <= 8 and len(polygon_sizes(found.hull)) <= 6


def test_a_budget_that_no_hull_keeps_to_is_refused() -> None:
    cube = convex_hull(np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float))
    assert enclose(cube, HullBudget(vertices=3)) is None and enclose(cube, HullBudget(polygons=3)) is None


@pytest.mark.slow
@pytest.mark.parametrize(("count", "share"), [(65, 0.004), (70, 0.008), (90, 0.013), (130, 0.025)])
def test_a_hull_of_a_few_vertices_too_many_hardly_grows(count: int, share: float) -> None:
    points = np.random.default_rng(count).normal(size=(count, 3))
    ball = convex_hull(points / np.linalg.norm(points, axis=1, keepdims=True))
    found = enclose(ball, HullBudget(vertices=64))
    assert found is not None and found.error < share * ball.aabb.diagonal


def test_the_same_hull_gives_the_same_bytes() -> None:
    points = np.random.default_rng(3).normal(size=(200, 3))
    first, second = (enclose(convex_hull(points), HullBudget(24)) for _ in range(2))
    assert first and second and first.hull.vertices.tobytes() == second.hull.vertices.tobytes()


def covering_bound(count: int) -> float:
    """How far a polytope of so many faces, or of so many vertices, around a ball of radius 1 sticks out at least
    (L. Fejes Tóth's bound on coverings of the sphere by equal caps; vertices by polarity)."""
    return float(np.sqrt(3) * np.tan(count * np.pi / (6 * (count - 2))) - 1)


def make_ball(count: int) -> Polytope:
    """The hull of a spiral of points on the sphere of radius 1."""
    turn = np.arange(count) * np.pi * (3 - np.sqrt(5))
    height = 1 - (np.arange(count) + 0.5) * 2 / count
    across = np.sqrt(1 - height**2)
    return convex_hull(np.column_stack([across * np.cos(turn), across * np.sin(turn), height]))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("budget", "count"),
    [
        (HullBudget(vertices=16), 16),
        (HullBudget(vertices=32), 32),
        (HullBudget(vertices=64), 64),
        (HullBudget(polygons=32), 32),
        (HullBudget(polygons=64), 64),
    ],
)
def test_a_ball_is_met_within_one_and_a_half_times_of_what_is_possible(budget: HullBudget, count: int) -> None:
    ball = make_ball(642)
    found = enclose(ball, budget)
    assert found is not None and found.error <= 1.5 * covering_bound(count)
    assert len(found.hull.vertices) <= budget.vertices and len(polygon_sizes(found.hull)) <= budget.polygons
    assert heights(ball.vertices, found.hull).max() <= 1e-12


@pytest.mark.slow
def test_a_ball_of_as_many_faces_as_vertices_uses_both() -> None:
    """Of 64 vertices on 64 faces, four at each, square cells stick out least: half the square of their circumradius."""
    ball, cells = make_ball(642), np.pi / 64
    found = enclose(ball, HullBudget(64, 64, 32))
    assert found is not None and found.error <= 1.5 * cells
    assert len(found.hull.vertices) == 64 == len(polygon_sizes(found.hull))


_RING = np.column_stack([np.cos(np.arange(60) * np.pi / 30), np.sin(np.arange(60) * np.pi / 30), np.zeros(60)])
_UP = np.array([0.0, 0.0, 1.0])
_CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
_SHAPES = {
    "sphere": make_ball(300).vertices,
    "ellipsoid": make_ball(300).vertices * [3, 1, 0.5],
    "cylinder": np.concatenate([_RING - 2 * _UP, _RING + 2 * _UP]),
    "thin disc": np.concatenate([_RING - 0.01 * _UP, _RING + 0.01 * _UP]),
    "cone": np.concatenate([_RING, [2 * _UP]]),
    "filleted box": (_CUBE[:, None] * [3, 2, 1] + 0.3 * make_ball(40).vertices).reshape(-1, 3),
    "box": _CUBE * [3, 2, 1],
}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("budget", "share"),
    [
        pytest.param(HullBudget(64), 0.03, marks=pytest.mark.long),
        pytest.param(HullBudget(polygons=64), 0.03, marks=pytest.mark.long),
        (HullBudget(64, 64, 32), 0.03),
        pytest.param(HullBudget(40, 50), 0.04, marks=pytest.mark.long),
    ],
)
@pytest.mark.parametrize("shape", _SHAPES)
def test_shapes_of_all_kinds_keep_their_budget_and_grow_little(shape: str, budget: HullBudget, share: float) -> None:
    hull = convex_hull(_SHAPES[shape])
    found = enclose(hull, budget)
    assert found is not None
    made = ConvexHull(found.hull.vertices)
    assert (hull.vertices @ made.equations[:, :3].T + made.equations[:, 3]).max() <= 1e-9
    assert len(made.vertices) <= budget.vertices and len(polygon_sizes(found.hull)) <= budget.polygons
    assert found.error <= share * hull.aabb.diagonal
