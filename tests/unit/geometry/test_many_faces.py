"""Surfaces with so many faces that convexity is judged edge by edge, and points that rise above them, by groups."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import Floats, Ints, convex_hull, is_convex
from meshforge.geometry import surface as room
from meshforge.geometry.surface import planes_of, rises_above


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


def cloud(rng: np.random.Generator, round_: bool) -> Floats:
    points = rng.normal(size=(700, 3)) * [1, 2, 0.1]
    return np.asarray(points / np.linalg.norm(points, axis=1)[:, None]) if round_ else points


def highest(points: Floats, vertices: Floats, faces: Ints) -> float:
    planes = planes_of(vertices, faces)
    return float(((points - planes.middle) @ planes.normals.T - planes.offsets).max())


@pytest.mark.parametrize("round_", [True, False])
def test_groups_find_what_rises_as_all_pairs_do(round_: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "_MOST_PAIRS_AT_ONCE", 0)
    rng = np.random.default_rng(1)
    for _ in range(20):
        hull = convex_hull(cloud(rng, round_))
        points = cloud(rng, round_) * rng.uniform(0.5, 1.1)
        top = highest(points, hull.vertices, hull.faces)
        assert rises_above(points, hull.vertices, hull.faces, top - 1e-9)
        assert not rises_above(points, hull.vertices, hull.faces, top + 1e-9)
