"""Rows in order as by numpy; shortcuts of hulls."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import is_convex, is_convex_hull, is_outward, principal_extents
from meshforge.geometry.arrays import sort_rows
from meshforge.geometry.convex import _is_surely_thick, convex_hull

RANDOM = np.random.default_rng(9)


@pytest.mark.parametrize("count", [0, 1, 400])
def test_rows_are_sorted_as_by_numpy(count: int) -> None:
    rows = RANDOM.integers(-3, 4, (count, 3)).astype(np.float32) / 7
    assert np.array_equal(sort_rows(rows), np.unique(rows, axis=0))


@pytest.mark.parametrize("thin", [1.0, 1e-2, 1e-4, 1e-6, 1e-9, 0.0])
def test_points_that_are_surely_thick_are_thick(thin: float) -> None:
    for count in (4, 9, 500):
        points = RANDOM.normal(size=(count, 3)) * [3.0, 1.0, thin] + 100.0
        extents = principal_extents(points)[2]
        assert extents.min() > thin or thin == 0.0 or count == 4 or thin < 1e-8
        if _is_surely_thick(points, 0.0):
            assert extents.min() > 1e-6 * extents.max()
        if _is_surely_thick(points, 0.1):
            assert extents.min() > 0.05
    assert not _is_surely_thick(np.zeros((5, 3)), 0.0)
    assert _is_surely_thick(RANDOM.normal(size=(100, 3)), 0.1)


def test_a_hull_that_is_open_inside_out_or_dented_is_none() -> None:
    hull = convex_hull(RANDOM.normal(size=(30, 3)))
    assert is_convex_hull(hull.vertices, hull.faces, 1e-8)
    assert not is_convex_hull(hull.vertices, hull.faces[1:], 1e-8)
    assert not is_convex_hull(hull.vertices, hull.faces[:, ::-1], 1e-8)
    ball = convex_hull((balls := RANDOM.normal(size=(40, 3))) / np.linalg.norm(balls, axis=1, keepdims=True))
    dented = ball.vertices.copy()
    dented[0] *= 0.8
    assert is_outward(dented, ball.faces) and not is_convex(dented, ball.faces)
    assert not is_convex_hull(dented, ball.faces, 1e-8)
