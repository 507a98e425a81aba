"""Laws of space in cells."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from meshforge.checks.grid import (
    Grid,
    cells_to_surface,
    find_pockets,
    flood_from_outside,
    grid_around,
    voxelize_hulls,
    voxelize_surface,
)
from meshforge.checks.surface_samples import SurfaceIndex, sample_triangles
from meshforge.geometry import Floats, Shape, nearest_on_triangles, volume_of_union
from tests.examples import examples
from tests.laws.test_geometry_enclosures import heights
from tests.shape_strategies import generators, shapes
from tests.shape_strategies import shape as shape_of

_SETTINGS = examples(60)
_CLOSED = ("polytope", "box")


def middles(grid: Grid) -> Floats:
    axes = np.meshgrid(*(grid.cell_centers(k) for k in range(3)), indexing="ij")
    return np.stack(axes, axis=-1).reshape(-1, 3)


@_SETTINGS
@given(shapes())
def test_a_cell_is_filled_where_its_middle_is_inside(shape: Shape) -> None:
    grid = grid_around(shape.aabb, shape.aabb.diagonal / 24)
    above = heights(middles(grid), shape.tessellate()).reshape(grid.shape)
    mask, slack = voxelize_hulls(grid, [shape]), 1e-6 * grid.cell
    assert mask[above < -slack].all() and not mask[above > slack].any()


@_SETTINGS
@given(shapes(), st.sampled_from([17, 40, 64]))
def test_nothing_leaks_through_a_closed_surface(shape: Shape, cells: int) -> None:
    grid = grid_around(shape.aabb, shape.aabb.diagonal / cells)
    hull = shape.tessellate()
    outside = flood_from_outside(voxelize_surface(grid, hull.vertices[hull.faces]))
    inside = heights(middles(grid), hull).reshape(grid.shape) < -1e-9
    assert not (outside & inside).any()


@_SETTINGS
@given(shapes(kinds=_CLOSED))
def test_blocks_are_closed_and_have_the_volume_of_their_cells(shape: Shape) -> None:
    grid = grid_around(shape.aabb, shape.aabb.diagonal / 20)
    mask = voxelize_hulls(grid, [shape])
    surface = cells_to_surface(grid, mask)
    corners = surface.vertices[surface.faces] - grid.origin
    volume = np.linalg.det(corners).sum() / 6
    assert volume == pytest.approx(mask.sum() * grid.cell**3, rel=1e-9, abs=1e-18)


def mean_curvature(corners: Floats) -> float:
    """Of the surface of a hull [m], given the corners (n, 3, 3) of its triangles: half its edges by their bends."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    beside: dict[tuple[bytes, bytes], int] = {}  # the triangle that has an edge, by its ends
    for triangle, ends in enumerate(corners):
        beside |= {(ends[k].tobytes(), ends[(k + 1) % 3].tobytes()): triangle for k in range(3)}
    total = 0.0
    for (start, stop), triangle in beside.items():
        one, other = normals[triangle], normals[beside[stop, start]]  # every edge is met twice
        length = np.linalg.norm(np.frombuffer(start) - np.frombuffer(stop))
        total += length * np.arctan2(np.linalg.norm(np.cross(one, other)), one @ other) / 4
    return float(total)


@_SETTINGS
@given(st.integers(0, 2**32 - 1))
@example(1646)  # a needle, thinner than the cells: most of what is within a cell of it is beside its edges
def test_cells_measure_volume_the_better_the_smaller_they_are(seed: int) -> None:
    hull = shape_of("polytope", np.random.default_rng(seed)).tessellate()
    truth, size = volume_of_union([hull]), hull.aabb.diagonal
    corners = hull.vertices[hull.faces]
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()
    bend = mean_curvature(corners)
    for parts in (16, 32, 64):
        grid = grid_around(hull.aabb, size / parts)
        # Only space within half a cell's diagonal of the surface can be counted wrongly. Outside of a hull that is
        # the volume by Steiner's formula: over the faces, around the edges, around the corners. Inside it is less.
        reach = grid.cell * np.sqrt(3) / 2
        bound = area * reach + bend * reach**2 + 4 / 3 * np.pi * reach**3
        assert abs(grid.litres(voxelize_hulls(grid, [hull])) / 1000 - truth) <= bound


@_SETTINGS
@given(generators(), st.floats(0.02, 0.5))
def test_every_point_of_a_triangle_has_a_sample_near_by(rng: np.random.Generator, spacing: float) -> None:
    corners = rng.normal(size=(5, 3, 3)) * 10.0 ** rng.uniform(-2, 0, size=(5, 1, 3))
    parts = list(sample_triangles(corners, spacing))
    points, triangle = np.concatenate([p.points for p in parts]), np.concatenate([p.triangle for p in parts])
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    assert np.bincount(triangle, np.concatenate([p.area for p in parts])) == pytest.approx(area, rel=1e-9, abs=1e-15)
    assert np.linalg.norm(nearest_on_triangles(points, corners[triangle]) - points, axis=1).max() < 1e-9
    weights = rng.dirichlet(np.ones(3), size=200)
    for k in range(5):
        somewhere = weights @ corners[k]
        gaps = np.linalg.norm(somewhere[:, None] - points[triangle == k], axis=2).min(axis=1)
        assert gaps.max() <= 1.12 * spacing


@_SETTINGS
@given(generators())
def test_the_nearest_point_of_a_triangle_is_nearer_than_any_other(rng: np.random.Generator) -> None:
    corners = rng.normal(size=(4, 3, 3))
    corners[1, 2] = corners[1, 1]  # a needle
    corners[2] = corners[2, 0]  # a point
    points = rng.normal(size=(4, 3)) * 2
    found = nearest_on_triangles(points, corners)
    others = np.einsum("nk,mkj->mnj", rng.dirichlet(np.ones(3), size=500), corners)
    best = np.linalg.norm(others - points[:, None], axis=2).min(axis=1)
    assert (np.linalg.norm(found - points, axis=1) <= best + 1e-12).all()


@_SETTINGS
@given(generators())
def test_the_distance_to_a_surface_is_never_too_small_nor_much_too_large(rng: np.random.Generator) -> None:
    corners = rng.normal(size=(30, 3, 3)) * 0.3 + rng.normal(size=(30, 1, 3))
    points, spacing = rng.normal(size=(40, 3)) * 2, 0.05
    found, _ = SurfaceIndex(corners, spacing).distances(points)
    pairs = np.repeat(points, 30, axis=0), np.tile(corners, (40, 1, 1))
    truth = np.linalg.norm(nearest_on_triangles(*pairs) - pairs[0], axis=1).reshape(40, 30).min(axis=1)
    assert (found >= truth - 1e-12).all() and (found <= truth + 1.12 * spacing).all()


def test_pockets_are_numbered_by_size_and_layers_belong_to_none() -> None:
    mask = np.zeros((30, 30, 30), dtype=bool)
    mask[2:8, 2:8, 2:8] = True
    mask[12:22, 12:22, 12:22] = True
    mask[25:27] = True
    numbers, count = find_pockets(mask)
    assert count == 2
    assert numbers[15, 15, 15] == 1 and numbers[4, 4, 4] == 2 and not numbers[25:27].any()


def test_a_room_is_reached_only_through_its_door() -> None:
    taken = np.zeros((12, 12, 12), dtype=bool)
    taken[2:10, 2:10, 2:10] = True
    taken[3:9, 3:9, 3:9] = False
    assert not flood_from_outside(taken)[5, 5, 5]
    taken[9, 5, 5] = False
    assert flood_from_outside(taken)[5, 5, 5]
