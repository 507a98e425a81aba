"""Descriptions of hulls: the same part is described alike, however it lies; and which way is up in a tilted mesh."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmark.assets import CATEGORIES, samples
from meshforge.geometry import Aabb, Box, Floats, Polytope, Pose
from meshforge.label_model import read_weights
from meshforge.label_model.describe import ROW_WIDTH, MeshDescriber, find_other_sides, find_up, rotation_to_z
from meshforge.label_model.surroundings import points_inside, points_on_surface
from meshforge.symbolic import Hull, SymbolicMesh
from tests.synthesis_boxes import boxes, table

CHAIR = samples("chair", calibration=True)[0].mesh


def described(mesh: SymbolicMesh) -> Floats:
    return MeshDescriber(mesh).describe().rows


METRIC = read_weights("metric.json")


def test_every_hull_has_a_row_of_finite_numbers_as_wide_as_the_metric() -> None:
    rows = described(CHAIR)
    assert rows.shape == (len(CHAIR.hulls), ROW_WIDTH) == (len(CHAIR.hulls), len(METRIC))
    assert np.isfinite(rows).all()
    assert (METRIC > 0).all()


def test_no_hulls_have_no_rows_and_one_alone_has_one() -> None:
    assert described(boxes()).shape == (0, ROW_WIDTH)
    alone = described(SymbolicMesh(CHAIR.hulls[:1]))
    assert alone.shape == (1, ROW_WIDTH)
    assert np.isfinite(alone).all()


@pytest.mark.slow
@given(yaw=st.floats(-3.0, 3.0), x=st.floats(-100.0, 100.0), scale=st.sampled_from([0.001, 1.0, 40.0]))
def test_neither_place_nor_size_nor_yaw_changes_a_row(yaw: float, x: float, scale: float) -> None:
    pose = Pose.from_rpy((x * scale, -x * scale, x * scale), (0.0, 0.0, yaw))
    shapes = (Polytope(pose.apply(hull.vertices * scale), hull.faces) for hull in CHAIR.hulls)
    moved = [Hull(hull.name, "body", shape, hull.annotation) for hull, shape in zip(CHAIR.hulls, shapes, strict=True)]
    far = np.abs(described(SymbolicMesh(tuple(moved), scale=CHAIR.diagonal * scale)) - described(CHAIR))
    assert np.median(far) < 1e-6
    assert far @ METRIC == pytest.approx(0.0, abs=0.25)  # a point may change its ring by a rounding


def test_the_order_of_hulls_does_not_matter() -> None:
    turned = SymbolicMesh(CHAIR.hulls[::-1])
    assert described(turned)[::-1] == pytest.approx(described(CHAIR), abs=1e-9)


@pytest.mark.long
def test_very_many_hulls_are_described_in_bounded_memory() -> None:
    rows = [
        Hull(
            f"h{k}",
            "body",
            Box.of_bounds(Aabb(np.array([k % 50, k // 50, 0.0]), np.array([k % 50 + 0.5, k // 50 + 1.0, 1.0]))),
        )
        for k in range(1500)
    ]
    tracemalloc.start()
    found = described(SymbolicMesh(tuple(rows)))
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert np.isfinite(found).all()
    assert most < 700e6  # all points at once would take 2 GB


def test_points_are_where_they_should_be() -> None:
    hull = CHAIR.hulls[0]
    first, second, third = (hull.vertices[hull.faces[:, k]] for k in range(3))
    normals = np.cross(second - first, third - first)
    reach = (normals * first).sum(axis=1)
    within = points_inside(hull.vertices, np.zeros(2), 8)
    assert (within @ normals.T <= reach + 1e-12).all()
    on = points_on_surface(hull.vertices[hull.faces], 500)
    assert (on @ normals.T <= reach + 1e-9).all()
    assert ((np.abs(on @ normals.T - reach) / np.linalg.norm(normals, axis=1)).min(axis=1) < 1e-9).all()


def tilted(mesh: SymbolicMesh, roll: float, pitch: float, yaw: float) -> tuple[SymbolicMesh, Floats]:
    """The mesh turned, and where its own upright axis points then."""
    pose = Pose.from_rpy((0.0, 0.0, 0.0), (roll, pitch, yaw))
    return SymbolicMesh(tuple(hull.move(pose) for hull in mesh.hulls)), pose.rotation[:, 2]


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (0.4, 0.0, 1.0), (-0.3, 0.35, 2.0), (0.0, -0.5, -1.0)])
def test_a_tilted_table_still_has_its_top_up(turn: tuple[float, float, float]) -> None:
    mesh, up = tilted(table(), *turn)
    assert find_up(mesh) @ up > np.cos(np.radians(1.0))


def test_what_has_no_hulls_or_stands_straight_keeps_the_axis_of_its_file() -> None:
    assert find_up(boxes()).tolist() == [0.0, 0.0, 1.0]
    assert find_up(table()).tolist() == [0.0, 0.0, 1.0]


def test_the_other_sides_of_a_fallen_table_are_apart_and_its_true_one_is_among_them() -> None:
    mesh, up = tilted(table(), np.pi / 2, 0.0, 0.4)
    seems = find_up(mesh)
    sides = find_other_sides(mesh, seems, 5)
    every = np.array([seems, *sides])
    assert len(sides) == 5
    assert (every @ every.T)[~np.eye(6, dtype=bool)].max() < np.cos(np.radians(30.0))
    assert (every @ up).max() > np.cos(np.radians(1.0))


def test_what_has_no_hulls_has_no_other_sides() -> None:
    assert find_other_sides(boxes(), np.array([0.0, 0.0, 1.0]), 5) == []


@pytest.mark.parametrize("up", [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.6, 0.0, 0.8), (0.0, 0.6, -0.8)])
def test_standing_takes_the_direction_to_z_by_a_proper_turn(up: tuple[float, float, float]) -> None:
    turn = rotation_to_z(np.array(up))
    assert turn @ np.array(up) == pytest.approx([0.0, 0.0, 1.0])
    assert turn @ turn.T == pytest.approx(np.eye(3))
    assert np.linalg.det(turn) == pytest.approx(1.0)


@pytest.mark.parametrize("category", CATEGORIES)
def test_of_generated_assets_a_third_of_which_are_tilted_nearly_all_are_set_upright(category: str) -> None:
    rows = samples(category, calibration=True)[::3]
    right = [find_up(row.mesh) @ row.asset.pose.rotation[:, 2] > np.cos(np.radians(6.0)) for row in rows]
    assert np.mean(right) > 0.85
