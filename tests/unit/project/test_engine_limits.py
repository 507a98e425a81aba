from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import HullParts, Preparation, replace_hulls
from meshforge.formats import read
from meshforge.geometry import Polytope, convex_hull, cut
from meshforge.project.rebuild import describe_limits
from meshforge.symbolic import Asset
from tests.unit.project.stools import boxes, write_stool


@pytest.fixture
def stool(tmp_path: Path) -> Asset:
    return read(write_stool(tmp_path, "a", boxes(0.2, 0.4), boxes(0.2, 0.4)))


def ball(points: int) -> Polytope:
    """A hull of so many vertices, which lie on a sphere."""
    found = np.random.default_rng(0).normal(size=(points, 3))
    return convex_hull(0.02 * found / np.linalg.norm(found, axis=1, keepdims=True) + [0, 0, 0.42])


def slices(hull: Polytope, count: int) -> tuple[Polytope, ...]:
    """A hull cut into so many across x."""
    found, rest = list[Polytope](), hull
    low, high = hull.aabb.min[0], hull.aabb.max[0]
    for k in range(1, count):
        below, above = cut(rest, np.array([low + (high - low) * k / count, 0, 0]), np.array([1.0, 0, 0]))
        assert below and above
        found.append(below)
        rest = above
    return (*found, rest)


def limits(asset: Asset, parts: tuple[Polytope, ...], engine: str | None) -> list[str]:
    after = replace_hulls(asset, Preparation(), [HullParts("base/h0", parts, "")], {"pieces": "coacd"})
    return describe_limits(asset, Preparation(), after, engine)


def test_parts_of_too_many_vertices_are_named_with_the_remedy(stool: Asset) -> None:
    (text,) = [one for one in limits(stool, (ball(300), ball(20)), "physx-cpu") if "255 vertices" in one]
    assert text.startswith("then, PhysX on the CPU: base/h0#0 (300): more than 255 vertices; ")
    assert text.endswith("Reduce it (check --fix), replace it by a primitive, or cut it.")
    assert limits(stool, (ball(60), ball(20)), "unity") == []


@pytest.mark.slow
def test_a_body_of_too_many_hulls_is_named(stool: Asset) -> None:
    parts = slices(boxes(0.2, 0.4)[0], 70)
    (text,) = [one for one in limits(stool, parts, "physx-gpu") if "body" in one]
    assert text.startswith("then, PhysX on the GPU (Isaac, SAPIEN): body 'base': 74 hulls, more than 64; ")
    assert not [one for one in limits(stool, parts[:60], "physx-gpu") if "body" in one]


def test_by_default_it_is_the_engines_that_read_the_file(stool: Asset) -> None:
    tiny = convex_hull(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]) * 1e-5 + [0, 0, 0.42])
    assert any("MuJoCo refuses the mesh" in one for one in limits(stool, (tiny, ball(20)), None))
    assert limits(stool, (ball(20), ball(24)), None) == []
