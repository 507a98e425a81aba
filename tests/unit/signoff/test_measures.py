from math import isfinite

import numpy as np
import pytest

from meshforge.geometry import Polytope, Shape
from meshforge.signoff.outliers import EditMeasures, measure_edit
from meshforge.symbolic import Hull, SymbolicMesh
from tests.unit.language.scenes import box

FLAT = Polytope(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2], [0, 2, 1]]))
"""Two sides of one triangle: closed, and without a volume."""
LINE = Polytope(np.array([[0, 0, 0], [1, 1, 1], [2, 2, 2]]), np.array([[0, 1, 2], [0, 2, 1]]))


def mesh(**shapes: Shape) -> SymbolicMesh:
    return SymbolicMesh(tuple(Hull(name, "body", shape) for name, shape in shapes.items()))


def table() -> SymbolicMesh:
    """A top and two legs in a box of 2 by 1 by 1."""
    return mesh(
        top=box((0, 0, 0.9), (2, 1, 1)), left=box((0, 0, 0), (0.1, 1, 0.9)), right=box((1.9, 0, 0), (2, 1, 0.9))
    )


def test_an_edit_that_changes_nothing() -> None:
    found = measure_edit(table(), table())
    assert (found.hulls_before, found.hulls_after, found.removed) == (3, 3, 0)
    assert found.volume_before == found.volume_after == pytest.approx(0.38)
    assert found.extents_before == found.extents_after == pytest.approx((2, 1, 1))
    assert found.free == pytest.approx(1 - 0.38 / 2, abs=0.01)
    assert found.filled == found.freed == 0


def test_one_block_fills_all_free_space() -> None:
    found = measure_edit(table(), mesh(block=box((0, 0, 0), (2, 1, 1))))
    assert (found.filled, found.freed, found.removed) == (1, 0, 1)
    assert found.volume_after / found.volume_before == pytest.approx(2 / 0.38)


def test_hulls_that_go_free_their_space_and_those_that_stay_are_not_counted() -> None:
    before = table()
    found = measure_edit(before, before.with_hulls(before.hulls[:1]))
    assert found.removed == pytest.approx(2 / 3)
    assert found.freed == pytest.approx(0.18 / 0.38, abs=0.02)
    assert found.filled == 0
    assert found.extents_after == pytest.approx((2, 1, 0.1))


@pytest.mark.parametrize("before", [mesh(), table(), mesh(flat=FLAT), mesh(line=LINE), mesh(flat=FLAT, line=LINE)])
@pytest.mark.parametrize("after", [mesh(), table(), mesh(flat=FLAT), mesh(line=LINE)])
def test_every_measure_is_finite_whatever_the_hulls_are(before: SymbolicMesh, after: SymbolicMesh) -> None:
    found = measure_edit(before, after)
    sides = (*found.extents_before, *found.extents_after)
    assert all(map(isfinite, (found.volume_before, found.volume_after, *sides)))
    assert all(0 <= share <= 1 for share in (found.removed, found.free, found.filled, found.freed))


def test_flat_hulls_cover_nothing() -> None:
    assert measure_edit(mesh(line=LINE, flat=FLAT), mesh()).free == 1


def test_the_edit_of_no_hulls() -> None:
    found = measure_edit(mesh(), mesh())
    assert found == EditMeasures(0, 0, 0.0, 0.0, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0, 0.0)
