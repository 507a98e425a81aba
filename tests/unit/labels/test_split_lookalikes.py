"""A split of one hull carried over to another: by the boxes around both, turned and mirrored where that fits better."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import Floats, Polytope, convex_hull, cut
from meshforge.labels.split_lookalikes import SplitExample, SplitLookalikes, split_likewise
from meshforge.symbolic import Hull, SymbolicMesh
from tests.unit.project.stools import boxes, coarse

POINTS = np.array(
    [[0, 0, 0], [1, 0, 0], [0, 2, 0], [1, 2, 0], [0, 0, 0.5], [1, 0, 0.2], [0.3, 2, 3], [0.8, 1.5, 2.5]], dtype=float
)
"""A lopsided body, so that no turn or mirror takes it to itself."""
AT, ACROSS = np.array([0.4, 1.2, 0.3]), np.array([0.2, 1.0, 0.3])
QUARTER = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])


def example(plane: bool = True) -> SplitExample:
    whole = convex_hull(POINTS)
    mesh = SymbolicMesh((Hull("base", "body", whole),))
    below, above = cut(whole, AT, ACROSS)
    assert below and above
    return SplitExample("cup", "base", mesh, (below, above), np.stack([AT, ACROSS]) if plane else None)


@pytest.mark.parametrize("plane", [True, False])
@pytest.mark.parametrize(
    ("linear", "why"),
    [
        (np.eye(3), "the same shape"),
        (np.diag([1.3, 0.9, 1.2]), "stretched along the axes"),
        (np.diag([-1.0, 1, 1]), "mirrored"),
        (QUARTER @ np.diag([1.1, 1.1, 1.1]), "turned by a quarter"),
        (np.diag([1.0, -1, 1]) @ QUARTER, "turned and mirrored"),
    ],
)
def test_the_parts_are_those_of_the_example_moved_along(plane: bool, linear: Floats, why: str) -> None:
    offset = np.array([3.0, -1, 2])
    found = split_likewise(example(plane), convex_hull(POINTS @ linear.T + offset))
    assert found, why
    parts, misfit = found
    assert misfit < 0.15, why
    for part, shown in zip(parts, example().parts, strict=True):
        moved = convex_hull(shown.vertices @ linear.T + offset)
        assert part.volume == pytest.approx(moved.volume, rel=1e-6), why
        assert part.aabb.min == pytest.approx(moved.aabb.min, abs=1e-6), why
        assert part.aabb.max == pytest.approx(moved.aabb.max, abs=1e-6), why


def test_a_part_that_would_be_a_sliver_is_no_part() -> None:
    corner = convex_hull(np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3.0]]))
    whole = example()
    beside = SplitExample("cup", "base", whole.mesh, whole.parts, np.array([[0.99, 1.99, 2.99], [1.0, 1.0, 1.0]]))
    assert split_likewise(beside, corner) is None


def test_the_hull_of_each_other_asset_that_looks_alike_is_found_and_no_leg() -> None:
    def stool(width: float, height: float) -> SymbolicMesh:
        hulls = coarse(boxes(width, height))
        return SymbolicMesh(tuple(Hull(f"h{k}", "base", hull) for k, hull in enumerate(hulls)))

    meshes = {"a": stool(0.2, 0.4), "b": stool(0.22, 0.45), "c": stool(0.18, 0.38)}
    whole = meshes["a"].hulls[0].shape
    plane = np.array([[0.0, 0, 0.4], [0, 0, 1.0]])
    below, above = cut(whole, *plane)
    assert isinstance(below, Polytope) and isinstance(above, Polytope)
    found = list(SplitLookalikes(meshes).find(SplitExample("a", "h0", meshes["a"], (below, above), plane)))
    likely = [one for one in found if one.chance >= 0.5]
    assert [(one.asset, one.hull) for one in likely] == [("b", "h0"), ("c", "h0")]
    for one in likely:
        share = one.parts[0].volume / (one.parts[0].volume + one.parts[1].volume)
        assert share == pytest.approx(below.volume / whole.volume, abs=0.01)
