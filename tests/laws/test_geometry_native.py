"""Laws of the native primitives of the least radius: they enclose their shapes, no thinner or shorter one does, and a
primitive that lies along the axis is its own.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import (
    Aabb,
    Capsule,
    Cylinder,
    Floats,
    Pose,
    Shape,
    Sphere,
    longest_axis,
    native_capsule,
    native_cylinder,
    native_sphere,
)
from meshforge.geometry.native import smallest_ball
from tests.examples import examples
from tests.laws.test_geometry_fits import outside
from tests.shape_strategies import KINDS, generators, shape

LAW = examples(30)
FITS = (native_cylinder, native_capsule, native_sphere)
EXACT = ("polytope", "box", "sphere", "capsule")
"""Kinds that are enclosed exactly in any direction; around the others there is a little room."""
ROOM = {"cylinder": 1e-5, "ellipsoid": 5e-4}

Fit = Callable[[Sequence[Shape], Aabb], Cylinder | Capsule | Sphere]


@st.composite
def groups(draw: st.DrawFn, kinds: tuple[str, ...] = KINDS) -> list[Shape]:
    """One to four shapes, near each other or apart, some all tiny or far away."""
    rng = draw(generators())
    found = [shape(draw(st.sampled_from(kinds)), rng, spread=0.5) for _ in range(draw(st.integers(1, 4)))]
    scale, offset = 10.0 ** draw(st.sampled_from([0, 0, -3])), draw(st.sampled_from([0.0, 0.0, 10.0]))
    return [one.transform(np.eye(3) * scale, np.full(3, offset)) for one in found]


def bounds_of(shapes: Sequence[Shape]) -> Aabb:
    return Aabb.union(one.aabb for one in shapes)


def surface(shapes: Sequence[Shape], rng: np.random.Generator) -> Floats:
    """Points (n, 3) on the surfaces of shapes: their vertices, and the farthest ones along many directions."""
    directions = np.concatenate([rng.normal(size=(200, 3)), np.eye(3), -np.eye(3)])
    return np.concatenate([np.concatenate([one.vertices, [one.support(way) for way in directions]]) for one in shapes])


def farthest(shapes: Sequence[Shape], found: Cylinder | Capsule | Sphere) -> Floats:
    """The points (n, 3) of each shape that lie farthest from the axis of a primitive, a sphere's centre."""
    across = np.eye(3) if isinstance(found, Sphere) else np.eye(3) - np.outer(*[found.pose.rotation[:, 2]] * 2)
    points = []
    for one in shapes:
        for start in np.concatenate([np.eye(3), -np.eye(3)]):
            point = one.support(start)
            for _ in range(60):
                away = across @ (point - found.pose.translation)
                point = one.support(away) if np.linalg.norm(away) > 0 else point
            points.append(point)
    return np.array(points)


@LAW
@given(shapes=groups(), fit=st.sampled_from(FITS), rng=generators())
def test_a_native_shape_encloses_its_shapes(shapes: list[Shape], fit: Fit, rng: np.random.Generator) -> None:
    bounds = bounds_of(shapes)
    slack = 1e-9 * bounds.diagonal + 1e-14 * float(np.abs(bounds.max).max())
    found = fit(shapes, bounds)
    assert outside(surface(shapes, rng), found) <= slack
    assert outside(farthest(shapes, found), found) <= slack


@LAW
@given(shapes=groups(), fit=st.sampled_from((native_cylinder, native_capsule)))
def test_it_lies_along_the_longest_side(shapes: list[Shape], fit: Fit) -> None:
    bounds = bounds_of(shapes)
    found, axis = fit(shapes, bounds), longest_axis(bounds)
    if isinstance(found, Sphere):
        return
    assert found.pose.rotation[axis, 2] == 1.0
    if isinstance(found, Cylinder):
        assert 2 * found.half_length == pytest.approx(bounds.size[axis], rel=1e-12)
        assert found.pose.translation[axis] == pytest.approx(bounds.center[axis], abs=1e-9 * bounds.diagonal)


@LAW
@given(shapes=groups(), fit=st.sampled_from(FITS), rng=generators())
def test_no_thinner_one_encloses_them(shapes: list[Shape], fit: Fit, rng: np.random.Generator) -> None:
    """The distance to the farthest point is convex in the place of the axis: no place nearby means none at all."""
    bounds = bounds_of(shapes)
    found, points = fit(shapes, bounds), surface(shapes, rng)
    room = max(ROOM.get(one.kind, 0.0) for one in shapes)
    fine = room + 0.02 * any(one.kind not in ("polytope", "box") for one in shapes)  # points of round ones are sparse
    axis = longest_axis(bounds)
    across = np.eye(3)[[k for k in range(3) if k != axis]] if fit is not native_sphere else np.eye(3)
    center, flat = found.pose.translation @ across.T, points @ across.T
    for step in (0.1, 1e-2, 1e-3):
        for _ in range(30):
            other = center + step * found.radius * rng.normal(size=len(across))
            assert np.linalg.norm(flat - other, axis=1).max() >= found.radius * (1 - 1e-9 - fine)


@LAW
@given(shapes=groups(("polytope", "box")))
def test_no_shorter_capsule_of_its_radius_encloses_them(shapes: list[Shape]) -> None:
    bounds = bounds_of(shapes)
    found = native_capsule(shapes, bounds)
    if isinstance(found, Sphere):
        return
    points = np.concatenate([one.vertices for one in shapes])
    for end in (-1.0, 1.0):
        cut = 0.01 * found.half_length
        pose = found.pose @ Pose.of_translation([0, 0, -end * cut / 2])
        assert outside(points, replace(found, pose=pose, half_length=found.half_length - cut / 2)) > 0


@LAW
@given(rng=generators(), axis=st.integers(0, 2))
def test_a_primitive_along_an_axis_is_its_own(rng: np.random.Generator, axis: int) -> None:
    pose = Pose(np.roll(np.eye(3), axis - 2, axis=0), rng.normal(size=3))
    radius = float(10.0 ** rng.uniform(-3, 0))
    half = radius * float(rng.uniform(1.1, 20))
    for fit, one in (
        (native_cylinder, Cylinder(pose, radius, half)),
        (native_capsule, Capsule(pose, radius, half)),
        (native_sphere, Sphere(pose, radius)),
        (native_capsule, Cylinder(pose, radius, half)),
        (native_cylinder, Capsule(pose, radius, half)),
    ):
        found = fit([one], one.aabb)
        assert found.radius == pytest.approx(radius, rel=1e-9)
        assert np.allclose(found.pose.translation, pose.translation, atol=1e-9)
        if isinstance(found, Cylinder | Capsule):
            ends = radius if isinstance(one, Capsule) and isinstance(found, Cylinder) else 0.0
            assert found.half_length == pytest.approx(half + ends, rel=1e-6)
            assert found.pose.rotation[axis, 2] == 1.0


@LAW
@given(shapes=groups(EXACT))
def test_around_a_part_of_the_shapes_the_radius_is_no_larger(shapes: list[Shape]) -> None:
    bounds = bounds_of(shapes)
    for part in ([one] for one in shapes):
        for fit in FITS:
            assert fit(part, bounds).radius <= fit(shapes, bounds).radius * (1 + 1e-9)


@examples(100)
@given(rng=generators(), d=st.sampled_from([2, 3]), kind=st.sampled_from(["points", "balls", "lattice", "line"]))
def test_the_smallest_ball_is_smallest(rng: np.random.Generator, d: int, kind: str) -> None:
    """How far a ball must reach is convex in its centre: no better centre nearby means none at all."""
    count = int(rng.integers(1, 40))
    centers = rng.integers(0, 4, size=(count, d)).astype(float) if kind == "lattice" else rng.normal(size=(count, d))
    if kind == "line":
        centers = np.outer(rng.normal(size=count), centers[0])
    radii = rng.uniform(0, 1.5, size=count) if kind == "balls" else None
    center, radius = smallest_ball(centers, radii)
    own = np.zeros(count) if radii is None else radii
    for step in (1e-1, 1e-2, 1e-3):
        other = center + step * rng.normal(size=(50, d))
        reach = (np.linalg.norm(centers[None] - other[:, None], axis=2) + own).max(axis=1)
        assert reach.min() >= radius * (1 - 1e-9)
    assert (np.linalg.norm(centers - center, axis=1) + own).max() == radius
