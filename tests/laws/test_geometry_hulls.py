"""What holds of every convex hull, of easy points and of hard ones."""

import numpy as np
import pytest
from hypothesis import given

from meshforge.geometry import Floats, Polytope, convex_hull, is_closed, is_convex, is_outward, principal_extents
from tests.examples import examples
from tests.shape_strategies import clouds, directions, generators

LAW = examples(150)


def rows(points: Floats) -> set[tuple[float, ...]]:
    return set(map(tuple, points.tolist()))


def whitened(points: Floats, frame_of: Floats) -> Floats:
    """Points in coordinates where `frame_of` is one long, wide and high."""
    center, axes, extents = principal_extents(frame_of)
    return (points - center) @ (axes.T / extents)


def outside(points: Floats, hull: Polytope) -> float:
    """How far the outermost of the points lies above a face, in the whitened frame of the points."""
    corners, given_points = whitened(hull.vertices, points), whitened(points, points)
    a, b, c = (corners[hull.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return float((given_points @ normals.T - np.einsum("ij,ij->i", normals, a)).max())


@LAW
@given(points=clouds())
def test_a_hull_is_closed_convex_and_outward_of_some_of_its_points_and_holds_all(points: Floats) -> None:
    hull = convex_hull(points)
    assert is_closed(hull.faces)
    assert is_convex(hull.vertices, hull.faces, 1e-7)
    assert is_outward(hull.vertices, hull.faces)
    assert hull.volume > 0
    assert len(hull.vertices) - len(hull.faces) // 2 == 2
    assert np.array_equal(np.unique(hull.faces), np.arange(len(hull.vertices)))
    assert rows(hull.vertices) <= rows(points), "bit for bit"
    assert len(rows(hull.vertices)) == len(hull.vertices)
    assert outside(points, hull) <= 1e-6
    corners = whitened(hull.vertices, hull.vertices)[hull.faces]
    sides = corners - np.roll(corners, 1, axis=1)
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    assert (areas / np.linalg.norm(sides, axis=2).max(axis=1)).min() > 5e-8, "no triangle is a needle"


@LAW
@given(points=clouds(), direction=directions())
def test_a_hull_reaches_as_far_as_its_points_in_every_direction(points: Floats, direction: Floats) -> None:
    hull, unit = convex_hull(points), direction / np.linalg.norm(direction)
    slack = 1e-6 * float(np.ptp(points, axis=0).max())
    assert hull.support(unit) @ unit == pytest.approx(float((points @ unit).max()), abs=slack)


@LAW
@given(points=clouds(("scattered", "lattice", "two planes", "prism", "thin", "needle")))
def test_the_hull_of_a_hull_is_that_hull(points: Floats) -> None:
    hull = convex_hull(points)
    assert rows(convex_hull(hull.vertices).vertices) == rows(hull.vertices)


@LAW
@given(points=clouds(("scattered", "two planes", "prism", "thin")), rng=generators())
def test_neither_order_nor_repetition_of_the_points_matters(points: Floats, rng: np.random.Generator) -> None:
    shuffled = rng.permutation(np.concatenate([points, points[: len(points) // 2]]))
    assert convex_hull(shuffled).volume == pytest.approx(convex_hull(points).volume, rel=1e-6)


@LAW
@given(rng=generators())
def test_points_on_faces_and_edges_are_no_vertices(rng: np.random.Generator) -> None:
    steps = np.linspace(0.0, 1.0, int(rng.integers(3, 8)))
    grid = np.stack(np.meshgrid(steps, steps, steps), axis=-1).reshape(-1, 3)
    hull = convex_hull(grid * 10.0 ** rng.uniform(-2, 2, size=3) + rng.normal(size=3))
    assert (len(hull.vertices), len(hull.faces)) == (8, 12)


@LAW
@given(points=clouds(("scattered", "lattice", "single precision", "noisy lattice")), rng=generators())
def test_flattened_points_are_thickened_to_the_given_thickness(points: Floats, rng: np.random.Generator) -> None:
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    middle = points.mean(axis=0)
    flat = points - np.outer((points - middle) @ axis, axis)
    thickness = 1e-4 * float(np.ptp(flat, axis=0).max())
    hull = convex_hull(flat, thicken=thickness)
    assert np.ptp((hull.vertices - middle) @ axis) == pytest.approx(thickness, rel=1e-3)
    assert is_closed(hull.faces)
    assert is_convex(hull.vertices, hull.faces, 1e-7)
