"""Surfaces with so many faces that convexity is judged edge by edge."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import Floats, convex_hull, is_convex
from meshforge.geometry import surface as room


@pytest.fixture
def ball() -> Floats:
    points = np.random.default_rng(0).normal(size=(6000, 3))
    return np.asarray(points / np.linalg.norm(points, axis=1, keepdims=True))


def test_the_hull_of_thousands_of_points_on_a_ball_has_them_all(ball: Floats) -> None:
    hull = convex_hull(ball)
    assert len(hull.vertices) * len(hull.faces) > room._MOST_PAIRS_CHECKED
    assert len(hull.vertices) == len(ball)


@pytest.mark.parametrize("depth", [1e-6, 0.5])
def test_one_dent_among_thousands_of_faces_is_found(ball: Floats, depth: float) -> None:
    hull = convex_hull(ball)
    dented = hull.vertices.copy()
    dented[17] *= 1 - 0.01 - depth
    assert is_convex(hull.vertices, hull.faces, 1e-8)
    assert not is_convex(dented, hull.faces, 1e-8)


def test_judging_by_edges_and_by_all_pairs_agree(ball: Floats, monkeypatch: pytest.MonkeyPatch) -> None:
    hull = convex_hull(ball[:500])
    rng = np.random.default_rng(1)
    for size in (0.0, 1e-7, 1e-3):
        moved = hull.vertices + size * rng.normal(size=hull.vertices.shape)
        monkeypatch.setattr(room, "_MOST_PAIRS_CHECKED", 50_000_000)
        by_pairs = is_convex(moved, hull.faces)
        monkeypatch.setattr(room, "_MOST_PAIRS_CHECKED", 0)
        assert is_convex(moved, hull.faces) == by_pairs == (size < 1e-5)
