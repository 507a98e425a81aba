"""Shapes that are made: fills, fits, cuts, overlaps."""

import numpy as np
import pytest

from meshforge.common import GeometryError
from meshforge.geometry import (
    Aabb,
    Box,
    Capsule,
    Cylinder,
    Pose,
    Sphere,
    aabb_box,
    aabb_capsule,
    aabb_cylinder,
    aabb_sphere,
    cut,
    distance,
    longest_axis,
    map_to_box,
    overlap_volume,
    tight_box,
    tight_capsule,
    tight_cylinder,
    volume_of_union,
)

CUBE = Box.of_bounds(Aabb([0, 0, 0], [1, 1, 1]))


@pytest.mark.parametrize(
    ("size", "axis"), [((3, 1, 2), 0), ((1, 3, 2), 1), ((1, 1, 1), 2), ((2, 2, 1), 1), ((2, 1, 2), 2), ((1, 2, 2), 2)]
)
def test_of_equal_longest_sides_z_goes_before_y_before_x(size: tuple[float, float, float], axis: int) -> None:
    assert longest_axis(Aabb([0, 0, 0], size)) == axis


def test_a_native_cylinder_takes_the_mean_of_its_sides() -> None:
    shape = aabb_cylinder(Aabb([0, 0, 0], [1.0, 1.008, 3]))
    assert isinstance(shape, Cylinder)
    assert shape.radius == pytest.approx(0.502)
    assert aabb_cylinder(Aabb([0, 0, 0], [1.0, 1.02, 3])).kind == "polytope"


def test_a_capsule_fills_a_box_with_its_ends() -> None:
    shape = aabb_capsule(Aabb([0, 0, 0], [2, 2, 5]))
    assert isinstance(shape, Capsule)
    assert (shape.radius, shape.half_length) == (1.0, 1.5)


def test_a_capsule_in_a_cube_is_a_sphere() -> None:
    assert isinstance(aabb_capsule(Aabb([0, 0, 0], [2, 2, 2])), Sphere)


@pytest.mark.parametrize("fill", [aabb_box, aabb_cylinder, aabb_capsule, aabb_sphere])
def test_a_box_without_extent_cannot_be_filled(fill: object) -> None:
    assert callable(fill)
    with pytest.raises(GeometryError, match="1 x 0 x 1 m cannot be filled"):
        fill(Aabb([0, 0, 0], [1, 0, 1]))


def test_a_side_of_the_source_without_extent_is_moved_only() -> None:
    (shape,) = map_to_box([CUBE], Aabb([0, 0, 0.5], [1, 1, 0.5]), Aabb([0, 0, 3], [2, 2, 5]))
    assert np.allclose(shape.aabb.size, [2, 2, 1])
    assert shape.aabb.center[2] == pytest.approx(4)


def test_a_target_without_extent_is_refused() -> None:
    with pytest.raises(GeometryError, match="cannot be filled"):
        map_to_box([CUBE], CUBE.aabb, Aabb([0, 0, 0], [1, 1, 0]))


def test_the_tight_box_of_an_upright_box_is_that_box_unturned() -> None:
    box = tight_box(Aabb([1, 2, 3], [2, 4, 6]).corners)
    assert np.array_equal(box.pose.rotation, np.eye(3))
    assert np.allclose(box.half, [0.5, 1, 1.5])
    assert np.allclose(box.pose.translation, [1.5, 3, 4.5])


def test_tight_shapes_of_flat_points_are_refused_by_name_or_thickened() -> None:
    square = CUBE.vertices * [1, 1, 0]
    for fit in (tight_box, tight_cylinder, tight_capsule):
        with pytest.raises(GeometryError, match="top: its points span no volume"):
            fit(square, name="top")
    assert tight_box(square, thicken=0.01).volume == pytest.approx(0.01)


def test_the_same_points_give_the_same_fit_to_the_last_bit() -> None:
    points = np.random.default_rng(3).normal(size=(40, 3))
    for fit in (tight_box, tight_cylinder, tight_capsule):
        assert np.array_equal(fit(points).vertices, fit(points.copy()).vertices)


@pytest.mark.parametrize(("height", "parts"), [(-1.0, (False, True)), (0.0, (False, True)), (1.0, (True, False))])
def test_a_plane_beside_a_shape_leaves_it_whole(height: float, parts: tuple[bool, bool]) -> None:
    found = cut(CUBE, np.array([0, 0, height]), np.array([0, 0, 1.0]))
    assert tuple(part is not None for part in found) == parts


@pytest.mark.parametrize("normal", [(0, 0, 0), (np.nan, 0, 1), (np.inf, 0, 0)])
def test_a_cut_needs_a_normal(normal: tuple[float, ...]) -> None:
    with pytest.raises(GeometryError, match="normal"):
        cut(CUBE, np.zeros(3), np.array(normal, dtype=float))


@pytest.mark.parametrize("length", [5e-324, 1e-300, 1e200, 1.7e308])
def test_a_normal_may_have_any_length(length: float) -> None:
    point, normal = np.array([0.1, 0.2, 0.05]), np.array([1.0, 1.0, 0.0])
    for part, same in zip(cut(CUBE, point, normal * length), cut(CUBE, point, normal), strict=True):
        assert part and same and part.volume == pytest.approx(same.volume)


def test_a_plane_may_be_anywhere() -> None:
    far = np.full(3, 1.79e308)
    below, above = cut(CUBE, far, np.ones(3))
    assert below and len(below.vertices) == 8 and above is None


def test_boxes_that_touch_have_no_overlap_and_no_distance() -> None:
    beside = CUBE.move(Pose.of_translation([1, 0, 0]))
    assert overlap_volume(CUBE, beside) == 0
    assert distance(CUBE, beside) == pytest.approx(0, abs=1e-9)
    assert volume_of_union([CUBE, beside]) == pytest.approx(2)


def test_a_shape_overlaps_itself_whole() -> None:
    assert overlap_volume(CUBE, CUBE.tessellate()) == pytest.approx(1)
    assert volume_of_union([CUBE, CUBE, CUBE.tessellate()]) == pytest.approx(1)
    assert volume_of_union([]) == 0


def test_far_from_the_origin_an_overlap_is_the_same() -> None:
    a, b = CUBE, CUBE.move(Pose.of_translation([0.5, 0.5, 0.5]))
    away = Pose.of_translation([1e6, 1e6, 1e6])
    assert overlap_volume(a.move(away), b.move(away)) == pytest.approx(0.125, rel=1e-6)
