import numpy as np
import pytest

from meshforge.geometry import Aabb, Box, Pose
from meshforge.symbolic import DESCRIPTOR_NAMES, Hull, SymbolicMesh, descriptors
from tests.synthesis_boxes import boxes, table


def moved(mesh: SymbolicMesh, pose: Pose) -> SymbolicMesh:
    return SymbolicMesh(tuple(hull.move(pose) for hull in mesh.hulls))


def test_every_hull_has_a_row_of_finite_numbers() -> None:
    rows = descriptors([table(), boxes(), table(legs=2)])
    assert rows.shape == (len(table().hulls) + len(table(legs=2).hulls), len(DESCRIPTOR_NAMES))
    assert np.isfinite(rows).all()


def test_no_meshes_have_no_rows() -> None:
    assert descriptors([]).shape == (0, len(DESCRIPTOR_NAMES))
    assert descriptors([boxes()]).shape == (0, len(DESCRIPTOR_NAMES))


def test_a_larger_copy_elsewhere_is_described_alike() -> None:
    mesh = table()
    large = [
        Hull(hull.name, hull.body, Box.of_bounds(Aabb(hull.aabb.min * 7 + 3, hull.aabb.max * 7 + 3)))
        for hull in mesh.hulls
    ]
    assert descriptors([SymbolicMesh(tuple(large))]) == pytest.approx(descriptors([mesh]), abs=1e-6)


def test_a_quarter_turn_about_the_upright_axis_changes_nothing() -> None:
    turn = Pose(np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), np.zeros(3))
    assert descriptors([moved(table(), turn)]) == pytest.approx(descriptors([table()]), abs=1e-6)


def test_a_row_does_not_depend_on_the_other_meshes() -> None:
    alone = descriptors([table()])
    assert (descriptors([table(), table(legs=2)])[: len(alone)] == alone).all()


def test_the_spread_of_a_box_is_its_sides_whatever_its_turn() -> None:
    tilt = Pose(np.array([[1.0, 0.0, 0.0], [0.0, 0.6, -0.8], [0.0, 0.8, 0.6]]), np.zeros(3))
    upright = SymbolicMesh((Hull("h", "b", Box(Pose.of_translation([0, 0, 0]), np.array([0.3, 0.2, 0.1]))),))
    sizes = [np.exp(descriptors([mesh])[0, 1:4]) for mesh in (upright, moved(upright, tilt))]
    for row in sizes:
        assert row / row[0] == pytest.approx([1, 2 / 3, 1 / 3])
