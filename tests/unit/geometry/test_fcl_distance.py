"""FCL, which stands in for coal on Windows, finds the contacts that coal finds."""

from itertools import combinations

import numpy as np
import pytest

from meshforge.formats import load
from meshforge.geometry import (
    Aabb,
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Floats,
    Pose,
    Shape,
    Sphere,
    coal_distance,
    fcl_distance,
)
from meshforge.geometry import distance as distance_of_two
from meshforge.geometry.arrays import bounds
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh


def corners(shapes: list[Shape]) -> tuple[Floats, Floats]:
    low, high = bounds([shape.aabb for shape in shapes])
    return low.min(axis=0), high.max(axis=0)


@pytest.mark.parametrize("name", ["table_02", "table_07", "table_14"])
def test_hulls_of_real_tables_touch_by_both_or_by_none(name: str) -> None:
    mesh = load(TABLES / f"{name}.obj")
    shapes: list[Shape] = [hull.shape for hull in mesh.hulls]
    pairs = list(combinations(range(len(shapes)), 2))
    low, high = corners(shapes)
    size = float(np.linalg.norm(high - low))
    mine = np.array(coal_distance.measure_gaps(shapes, pairs, low, high)) / size
    theirs = np.array(fcl_distance.measure_gaps(shapes, pairs, low, high)) / size
    assert np.array_equal(mine <= 0.005, theirs <= 0.005) and (mine <= 0.005).any()
    near = mine <= 0.01
    np.testing.assert_allclose(theirs[near], mine[near], atol=1e-4)


def test_a_mesh_has_the_same_contacts_by_both(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = load(TABLES / "table_11.obj")
    known = mesh.contacts
    monkeypatch.setattr("meshforge.geometry.proximity._engine", fcl_distance)
    again = SymbolicMesh(mesh.hulls)
    assert known and again.contacts == known


@pytest.mark.parametrize("gap", [0.0, 0.25, 1.5])
def test_primitives_are_as_far_apart_as_they_are(gap: float) -> None:
    turn = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])  # the long axis along X
    box = Box.of_bounds(Aabb([-1, -1, -1], [0, 1, 1]))
    for other in (
        Sphere(Pose(np.eye(3), np.array([gap + 0.5, 0, 0])), 0.5),
        Capsule(Pose(turn, np.array([gap + 0.75, 0, 0])), 0.25, 0.5),
        Cylinder(Pose(turn, np.array([gap + 0.5, 0, 0])), 0.25, 0.5),
        Ellipsoid(Pose(np.eye(3), np.array([gap + 0.5, 0, 0])), np.array([0.5, 0.25, 1.0])),
    ):
        shapes: list[Shape] = [box, other]
        (found,) = fcl_distance.measure_gaps(shapes, [(0, 1)], *corners(shapes))
        assert found == pytest.approx(gap, abs=1e-3)
        assert found == pytest.approx(distance_of_two(box, other), abs=1e-3)


def test_shapes_that_overlap_are_no_distance_apart() -> None:
    shapes: list[Shape] = [Box.of_bounds(Aabb([0, 0, 0], [2, 2, 2])), Box.of_bounds(Aabb([1, 1, 1], [3, 3, 3]))]
    assert fcl_distance.measure_gaps(shapes, [(0, 1)], *corners(shapes)) == [0.0]
