"""Shapes around points, shapes that fill boxes, cuts and overlaps."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import (
    Aabb,
    Box,
    Capsule,
    Cylinder,
    Floats,
    Pose,
    Shape,
    Sphere,
    aabb_box,
    aabb_capsule,
    aabb_cylinder,
    aabb_sphere,
    convex_hull,
    cut,
    is_closed,
    is_convex,
    is_outward,
    longest_axis,
    map_to_box,
    overlap_volume,
    tight_box,
    tight_capsule,
    tight_cylinder,
    volume_of_union,
)
from tests.examples import examples
from tests.shape_strategies import clouds, directions, generators, posed, rotation, shapes

LAW = examples(60)
SLOW = examples(20)
FILLS = (aabb_box, aabb_cylinder, aabb_capsule, aabb_sphere)
ANGULAR = ("polytope", "box")


def outside(points: Floats, shape: Box | Cylinder | Capsule | Sphere) -> float:
    """How far [m] the outermost of the points lies outside a primitive, measured from its own axes."""
    local = (points - shape.pose.translation) @ shape.pose.rotation
    across = np.hypot(local[:, 0], local[:, 1])
    match shape:
        case Box():
            return float((np.abs(local) - shape.half).max())
        case Cylinder():
            return float(max((across - shape.radius).max(), (np.abs(local[:, 2]) - shape.half_length).max()))
        case Capsule():
            beyond = (np.abs(local[:, 2]) - shape.half_length).clip(0)
            return float((np.hypot(across, beyond) - shape.radius).max())
        case Sphere():
            return float((np.linalg.norm(local, axis=1) - shape.radius).max())


@LAW
@given(points=clouds(), fit=st.sampled_from([tight_box, tight_cylinder, tight_capsule]))
def test_tight_shapes_hold_points(points: Floats, fit: Callable[[Floats], Box | Cylinder | Capsule | Sphere]) -> None:
    rounding = np.spacing(np.abs(points).max())  # of points far from the origin it is more than their size allows
    assert outside(points, fit(points)) <= max(1e-9 * float(np.ptp(points, axis=0).max()), 4 * rounding)


@LAW
@given(rng=generators())
def test_a_turned_box_is_found_again(rng: np.random.Generator) -> None:
    box = Box(Pose(rotation(rng), rng.normal(size=3)), 10.0 ** rng.uniform(-1, 0, size=3))
    found = tight_box(box.vertices)
    assert found.volume == pytest.approx(box.volume, rel=1e-6)
    assert np.allclose(np.sort(found.half), np.sort(box.half), rtol=1e-3)


@LAW
@given(points=clouds(("scattered", "lattice", "prism")))
def test_a_tight_box_is_no_larger_than_the_upright_one(points: Floats) -> None:
    assert tight_box(points).volume <= convex_hull(points).aabb.size.prod() * (1 + 1e-9)


@SLOW
@given(rng=generators())
def test_a_turned_cylinder_is_found_again(rng: np.random.Generator) -> None:
    cylinder = Cylinder(Pose(rotation(rng), rng.normal(size=3)), *10.0 ** rng.uniform(-1, 0, size=2))
    hull = cylinder.tessellate()
    assert hull.volume < tight_cylinder(hull.vertices).volume <= cylinder.volume * (1 + 1e-3)


@SLOW
@given(rng=generators())
def test_a_turned_capsule_is_found_again(rng: np.random.Generator) -> None:
    capsule = Capsule(Pose(rotation(rng), rng.normal(size=3)), *10.0 ** rng.uniform(-1, 0, size=2))
    hull = capsule.tessellate()
    assert hull.volume < tight_capsule(hull.vertices).volume <= capsule.volume * (1 + 1e-2)


@st.composite
def boxes(draw: st.DrawFn) -> Aabb:
    """Bounding boxes, often with sides that are equal or nearly so."""
    rng = draw(generators())
    size = 10.0 ** rng.uniform(-3, 1, size=3)
    alike = draw(st.sampled_from(["no", "two", "three"]))
    if alike != "no":
        same = slice(None) if alike == "three" else rng.choice(3, size=2, replace=False)
        size[same] = size.max() * (1 + draw(st.sampled_from([0.0, 1e-12, 0.004, 0.02])) * rng.random(size[same].shape))
    low = rng.normal(size=3)
    return Aabb(low, low + size)


@examples(200)
@given(bounds=boxes(), fill=st.sampled_from(FILLS))
def test_a_shape_that_fills_a_box_has_that_box(bounds: Aabb, fill: Callable[[Aabb], Shape]) -> None:
    shape = fill(bounds)
    slack = 1e-12 if shape.kind == "polytope" else 0.005 * bounds.size.max() + 1e-12  # half of 1%, for the mean
    assert np.allclose(shape.aabb.min, bounds.min, rtol=0, atol=slack)
    assert np.allclose(shape.aabb.max, bounds.max, rtol=0, atol=slack)
    hull = shape.tessellate()
    assert len(hull.vertices) <= 64
    assert is_closed(hull.faces)
    assert is_convex(hull.vertices, hull.faces)
    assert is_outward(hull.vertices, hull.faces)


@examples(200)
@given(bounds=boxes())
def test_round_shapes_are_native_where_their_sides_agree_within_one_percent(bounds: Aabb) -> None:
    across = np.delete(bounds.size, longest_axis(bounds))
    round_across = np.ptp(across) <= 0.01 * across.max()
    assert (aabb_cylinder(bounds).kind == "cylinder") == round_across
    assert (aabb_capsule(bounds).kind in ("capsule", "sphere")) == round_across
    assert (aabb_sphere(bounds).kind == "sphere") == (np.ptp(bounds.size) <= 0.01 * bounds.size.max())
    for shape in (aabb_cylinder(bounds), aabb_capsule(bounds)):
        if shape.kind in ("cylinder", "capsule"):
            assert posed(shape).rotation[longest_axis(bounds), 2] == 1.0


@LAW
@given(a=shapes(), b=shapes(), target=boxes())
def test_mapped_shapes_together_have_the_target_box(a: Shape, b: Shape, target: Aabb) -> None:
    hulls = [a.tessellate(), b.tessellate()]
    made = map_to_box(hulls, Aabb.union(h.aabb for h in hulls), target)
    box = Aabb.union(shape.aabb for shape in made)
    assert np.allclose(box.min, target.min, rtol=0, atol=1e-9)
    assert np.allclose(box.max, target.max, rtol=0, atol=1e-9)


@LAW
@given(shape=shapes(), point=generators(), normal=directions())
def test_the_parts_of_a_cut_are_hulls_and_the_whole(shape: Shape, point: np.random.Generator, normal: Floats) -> None:
    whole = shape.tessellate()
    at = shape.centroid + point.normal(size=3) * 0.2 * whole.aabb.size
    parts = cut(shape, at, normal)
    assert sum(part.volume for part in parts if part) == pytest.approx(whole.volume, rel=1e-6)
    slack = 1e-9 * whole.aabb.diagonal
    for part, side in zip(parts, (1.0, -1.0), strict=True):
        if part is not None:
            assert is_closed(part.faces)
            assert is_convex(part.vertices, part.faces, 1e-7)
            assert (side * (part.vertices - at) @ normal / np.linalg.norm(normal)).max() <= slack


@SLOW
@given(a=shapes(spread=0.3), b=shapes(spread=0.3))
def test_an_overlap_and_a_union_share_out_the_volumes(a: Shape, b: Shape) -> None:
    common, together = overlap_volume(a, b), volume_of_union([a, b])
    assert common + together == pytest.approx(a.volume + b.volume, rel=1e-6)
    assert common == pytest.approx(overlap_volume(b, a), rel=1e-6, abs=1e-15)
    assert 0 <= common <= min(a.volume, b.volume) * (1 + 1e-6)


@LAW
@given(shape=shapes(kinds=ANGULAR), normal=directions())
def test_an_overlap_with_a_part_is_that_part(shape: Shape, normal: Floats) -> None:
    for part in cut(shape, shape.centroid, normal):
        assert part is not None
        assert overlap_volume(shape, part) == pytest.approx(part.volume, rel=1e-6)


@LAW
@given(shape=shapes(), pose=generators())
def test_an_overlap_of_round_shapes_is_right_to_a_thousandth(shape: Shape, pose: np.random.Generator) -> None:
    half = shape.transform(np.eye(3) / 2, shape.centroid / 2)
    assert overlap_volume(shape, half) == pytest.approx(half.volume, rel=1e-3)


@LAW
@given(rng=generators())
def test_two_spheres_overlap_in_a_lens(rng: np.random.Generator) -> None:
    r, s = rng.uniform(0.3, 1, size=2)
    d = float(rng.uniform(abs(r - s) + 0.05, r + s))
    turn = [Pose(rotation(rng), [0, 0, 0]), Pose(rotation(rng), [d, 0, 0])]
    lens = np.pi * (r + s - d) ** 2 * (d * d + 2 * d * (r + s) - 3 * (r - s) ** 2) / (12 * d)
    measured = overlap_volume(Sphere(turn[0], float(r)), Sphere(turn[1], float(s)))
    assert measured == pytest.approx(lens, abs=1e-3 * 4.19 * min(r, s) ** 3)
