"""Orientation: which frame the landmarks ask for."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from meshforge.common import ProgramError
from meshforge.geometry import Floats, Pose
from meshforge.language import orient_mesh
from meshforge.language.orient import _find_outline, square_up_angle
from meshforge.symbolic import SymbolicMesh
from tests.program_parts import parse_orient
from tests.unit.language.scenes import table

UPRIGHT = parse_orient("orient +Z: Is(leg) -> Is(panel)")


def about_z(degrees: float) -> Floats:
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def moved(scene: SymbolicMesh, rotation: Floats) -> SymbolicMesh:
    pose = Pose(rotation, np.zeros(3))
    return scene.with_hulls(h.move(pose) for h in scene.hulls)


def size(scene: SymbolicMesh) -> list[float]:
    assert scene.aabb is not None
    return [round(float(side), 9) for side in scene.aabb.size]


def test_an_upright_square_table_stays_the_very_mesh() -> None:
    scene = table()
    oriented, pose = orient_mesh(scene, UPRIGHT)
    assert oriented is scene and np.array_equal(pose.rotation, np.eye(3))


@pytest.mark.parametrize("degrees", [10, 30, 44, -44, -10])
def test_one_pair_squares_the_footprint_up(degrees: float) -> None:
    oriented, pose = orient_mesh(moved(table(), about_z(degrees)), UPRIGHT)
    assert size(oriented) == [2, 1, 1.1]
    assert np.allclose(pose.rotation, about_z(-degrees))


def test_of_the_quarter_turns_the_nearest_to_the_incoming_frame_is_taken() -> None:
    oriented, pose = orient_mesh(moved(table(), about_z(60)), UPRIGHT)
    assert size(oriented) == [1, 2, 1.1]
    assert np.allclose(pose.rotation, about_z(30))


def test_between_two_turns_that_are_equally_near_the_positive_one_is_taken() -> None:
    for degrees in (45, -45):
        _, pose = orient_mesh(moved(table(), about_z(degrees)), UPRIGHT)
        assert np.allclose(pose.rotation, about_z(45))


def test_a_frame_within_five_percent_of_the_smallest_rectangle_is_kept() -> None:
    askew = moved(table(), about_z(0.5))
    assert orient_mesh(askew, UPRIGHT)[0] is askew
    assert orient_mesh(moved(table(), about_z(2.0)), UPRIGHT)[0] is not askew


def test_a_round_footprint_is_kept() -> None:
    angles = np.arange(64) * (2 * np.pi / 64)
    assert square_up_angle(np.column_stack([np.cos(angles), np.sin(angles)])) == 0.0


def test_the_outline_of_a_footprint_is_that_of_qhull() -> None:
    random = np.random.default_rng(3)
    grid = np.stack(np.meshgrid(np.arange(7.0), np.arange(4.0)), axis=-1).reshape(-1, 2)
    for k in range(60):
        cosine, sine = np.cos(k), np.sin(k)
        for points in (random.normal(size=(4 + k, 2)), grid @ np.array([[cosine, sine], [-sine, cosine]]), grid[::-1]):
            expected = points[ConvexHull(points).vertices]
            found = _find_outline(points)
            assert {tuple(point) for point in found} == {tuple(point) for point in expected}
            turns = np.roll(found, -1, axis=0) - found
            assert (turns[:, 0] * np.roll(turns[:, 1], -1) > turns[:, 1] * np.roll(turns[:, 0], -1)).all()


def test_the_opposite_direction_is_a_half_turn_about_a_fixed_axis() -> None:
    overhead = moved(table(), np.diag([-1.0, 1, -1]))
    _, pose = orient_mesh(overhead, UPRIGHT)
    assert np.array_equal(pose.rotation, np.diag([1.0, -1, -1]))


def test_an_empty_landmark_is_named() -> None:
    with pytest.raises(ProgramError, match=r"the landmark Is\(door\) selects nothing"):
        orient_mesh(table(), parse_orient("orient +Z: Is(leg) -> Is(door)"))


def test_landmarks_at_one_point_are_named_with_what_they_selected() -> None:
    with pytest.raises(ProgramError) as error:
        orient_mesh(table(), parse_orient("orient +Z: Is(leg) -> Is(leg)"))
    assert "Is(leg) (leg0_low, leg0_high, leg1_low, leg1_high, leg2_low and 3 more)" in str(error.value)
    assert "one centre" in str(error.value)


def test_two_pairs_along_one_line_give_no_frame() -> None:
    with pytest.raises(ProgramError, match="run along one line"):
        orient_mesh(table(), parse_orient("orient +Z: Is(leg) -> Is(panel), +X: Is(panel) -> Is(leg)"))
