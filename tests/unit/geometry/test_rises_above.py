"""Whether points rise above planes: in groups as one by one."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import Floats, Ints, convex_hull, surface
from meshforge.geometry.arrays import cross
from meshforge.geometry.surface import planes_of, rises_above


def cloud(rng: np.random.Generator, round_: bool) -> Floats:
    points = rng.normal(size=(700, 3)) * [1, 2, 0.1]
    return np.asarray(points / np.linalg.norm(points, axis=1)[:, None]) if round_ else points


def highest(points: Floats, vertices: Floats, faces: Ints) -> float:
    planes = planes_of(vertices, faces)
    return float(((points - planes.middle) @ planes.normals.T - planes.offsets).max())


@pytest.mark.parametrize("round_", [True, False])
def test_groups_find_what_rises_as_all_pairs_do(round_: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(surface, "_MOST_PAIRS_AT_ONCE", 0)
    rng = np.random.default_rng(1)
    for _ in range(20):
        hull = convex_hull(cloud(rng, round_))
        points = cloud(rng, round_) * rng.uniform(0.5, 1.1)
        top = highest(points, hull.vertices, hull.faces)
        assert rises_above(points, hull.vertices, hull.faces, top - 1e-9)
        assert not rises_above(points, hull.vertices, hull.faces, top + 1e-9)


def test_a_hull_of_many_points_holds_them_all() -> None:
    rng = np.random.default_rng(2)
    points = np.concatenate([cloud(rng, True), 0.99999 * cloud(rng, True)])
    hull = convex_hull(points)
    assert len(hull.vertices) * 2 * len(points) > surface._MOST_PAIRS_AT_ONCE
    assert not rises_above(points, hull.vertices, hull.faces, 1e-6)
    assert rises_above(points * 1.001, hull.vertices, hull.faces, 1e-6)


def test_nothing_rises_of_no_points() -> None:
    hull = convex_hull(np.random.default_rng(3).normal(size=(20, 3)))
    assert not rises_above(np.zeros((0, 3)), hull.vertices, hull.faces, 0.0)


def test_cross_products_are_those_of_numpy_bit_for_bit() -> None:
    a, b = np.random.default_rng(4).normal(size=(2, 1000, 3))
    assert (cross(a, b) == np.cross(a, b)).all()
