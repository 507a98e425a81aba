"""What holds of every shape, whatever its kind."""

import numpy as np
import pytest
from hypothesis import given

from meshforge.geometry import Floats, Pose, Shape, is_closed, is_convex, is_outward, is_same_shape
from tests.examples import examples
from tests.shape_strategies import KINDS, directions, generators, posed, poses, shapes
from tests.shape_strategies import shape as random_shape

LAW = examples(120)
ROUND = ("sphere", "cylinder", "capsule", "ellipsoid")
EXACT = ("polytope", "box", "ellipsoid")  # kinds whose image is exact under any map


def width(shape: Shape, direction: Floats) -> float:
    return float(shape.support(direction) @ direction)


@LAW
@given(shape=shapes(), direction=directions())
def test_no_vertex_lies_beyond_the_support_point(shape: Shape, direction: Floats) -> None:
    reach = float((shape.vertices @ direction).max())
    slack = 1e-12 * float(np.linalg.norm(direction))
    assert width(shape, direction) >= reach - slack
    if shape.kind not in ROUND:
        assert width(shape, direction) <= reach + slack


@LAW
@given(shape=shapes(), direction=directions(), other=directions())
def test_a_support_point_is_a_point_of_the_shape(shape: Shape, direction: Floats, other: Floats) -> None:
    slack = 1e-12 * float(np.linalg.norm(other))
    assert shape.support(direction) @ other <= width(shape, other) + slack


@LAW
@given(shape=shapes())
def test_the_bounding_box_is_the_support_along_the_axes(shape: Shape) -> None:
    high = [width(shape, axis) for axis in np.eye(3)]
    low = [-width(shape, -axis) for axis in np.eye(3)]
    assert np.allclose(shape.aabb.min, low, rtol=0, atol=1e-12)
    assert np.allclose(shape.aabb.max, high, rtol=0, atol=1e-12)


@LAW
@given(shape=shapes())
def test_a_tessellation_is_a_hull_within_the_shape_and_of_about_its_volume(shape: Shape) -> None:
    hull = shape.tessellate()
    assert is_closed(hull.faces)
    assert is_convex(hull.vertices, hull.faces)
    assert is_outward(hull.vertices, hull.faces)
    if shape.kind in ROUND:
        assert len(hull.vertices) <= 64
        assert 0.8 * shape.volume < hull.volume < shape.volume
    else:
        assert hull.volume == pytest.approx(shape.volume, rel=1e-9)


@LAW
@given(shape=shapes(kinds=ROUND))
def test_a_tessellation_square_to_the_axes_has_the_box_of_the_shape(shape: Shape) -> None:
    upright = shape.move(Pose(posed(shape).rotation.T, np.zeros(3)))
    assert np.allclose(upright.tessellate().aabb.size, upright.aabb.size, rtol=1e-12, atol=1e-12)


@LAW
@given(shape=shapes(), pose=poses())
def test_moving_there_and_back_changes_nothing(shape: Shape, pose: Pose) -> None:
    assert is_same_shape(shape.move(pose).move(pose.inverse()), shape, tolerance=1e-12)


@LAW
@given(shape=shapes(), first=poses(), second=poses())
def test_two_moves_are_one(shape: Shape, first: Pose, second: Pose) -> None:
    assert is_same_shape(shape.move(first).move(second), shape.move(second @ first), tolerance=1e-12)


@LAW
@given(shape=shapes(), pose=poses(), direction=directions())
def test_a_moved_shape_keeps_kind_volume_and_support(shape: Shape, pose: Pose, direction: Floats) -> None:
    moved = shape.move(pose)
    assert moved.kind == shape.kind
    assert moved.volume == pytest.approx(shape.volume, rel=1e-9)
    expected = width(shape, pose.rotation.T @ direction) + float(pose.translation @ direction)
    assert width(moved, direction) == pytest.approx(expected, abs=1e-11 * float(np.linalg.norm(direction)))


@LAW
@given(shape=shapes(), rng=generators())
def test_any_map_takes_volume_and_centroid_along(shape: Shape, rng: np.random.Generator) -> None:
    linear, offset = rng.normal(size=(3, 3)), rng.normal(size=3)
    if abs(np.linalg.det(linear)) < 1e-2:
        linear = linear + 3 * np.eye(3)
    image = shape.transform(linear, offset)
    source = shape if shape.kind in EXACT or image.kind == shape.kind else shape.tessellate()
    assert image.volume == pytest.approx(abs(np.linalg.det(linear)) * source.volume, rel=1e-8)
    assert np.allclose(image.centroid, linear @ source.centroid + offset, rtol=0, atol=1e-9)
    assert is_closed(image.faces)
    assert is_outward(image.vertices, image.faces)


@LAW
@given(shape=shapes(), rng=generators())
def test_a_uniform_scale_or_a_reflection_keeps_the_kind(shape: Shape, rng: np.random.Generator) -> None:
    factor = float(10.0 ** rng.uniform(-2, 2))
    mirror = np.diag(rng.choice([-1.0, 1.0], size=3))
    offset, direction = rng.normal(size=(2, 3))
    image = shape.transform(mirror * factor, offset)
    assert image.kind == shape.kind
    assert image.volume == pytest.approx(factor**3 * shape.volume, rel=1e-9)
    expected = factor * width(shape, mirror @ direction) + float(offset @ direction)
    assert width(image, direction) == pytest.approx(expected, abs=1e-11 * (1 + factor))


@LAW
@given(shape=shapes(kinds=("box",)), rng=generators())
def test_a_stretch_along_its_own_axes_leaves_a_box_a_box(shape: Shape, rng: np.random.Generator) -> None:
    turn = posed(shape).rotation
    linear = turn @ np.diag(10.0 ** rng.uniform(-1, 1, size=3)) @ turn.T
    assert shape.transform(linear, np.zeros(3)).kind == "box"


@LAW
@given(shape=shapes(kinds=("cylinder",)), rng=generators())
def test_a_stretch_along_its_axis_leaves_a_cylinder_a_cylinder(shape: Shape, rng: np.random.Generator) -> None:
    turn = posed(shape).rotation
    linear = turn @ np.diag([2.0, 2.0, 10.0 ** rng.uniform(-1, 1)]) @ turn.T
    image = shape.transform(linear, np.zeros(3))
    assert image.kind == "cylinder"
    assert image.volume == pytest.approx(float(np.linalg.det(linear)) * shape.volume, rel=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_shapes_are_write_protected(kind: str) -> None:
    made = random_shape(kind, np.random.default_rng(0))
    for array in [made.vertices, made.faces, made.aabb.min]:
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
