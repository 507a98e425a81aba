from __future__ import annotations

import numpy as np
import pytest

from benchmark.assets import CATEGORIES, samples
from meshforge.geometry import Floats, Pose
from meshforge.label_model.describe import find_other_sides, find_up, rotation_to_z
from meshforge.symbolic import SymbolicMesh
from tests.synthesis_boxes import boxes, table


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
