import pickle

import numpy as np
import pytest

from meshforge.geometry import (
    Aabb,
    Box,
    Cylinder,
    Ellipsoid,
    Polytope,
    Pose,
    Sphere,
    digest,
    freeze_floats,
    freeze_ints,
    is_same_shape,
)
from meshforge.geometry.arrays import sort_rows


def test_frozen_arrays_are_copies_that_cannot_be_written() -> None:
    source = np.zeros((2, 3))
    frozen = freeze_floats(source, (-1, 3))
    source[0, 0] = 1
    assert frozen[0, 0] == 0
    with pytest.raises(ValueError, match="read-only"):
        frozen[0, 0] = 1


def test_an_array_of_another_shape_is_refused() -> None:
    with pytest.raises(ValueError, match=r"\(-1, 3\) was expected, not \(2, 2\)"):
        freeze_floats(np.zeros((2, 2)), (-1, 3))
    with pytest.raises(ValueError, match="was expected"):
        freeze_ints([1, 2], (3,))


def test_nothing_is_an_array_of_no_rows() -> None:
    assert freeze_floats([], (-1, 3)).shape == (0, 3)
    assert freeze_ints([], (-1, 3)).shape == (0, 3)


@pytest.mark.parametrize("rpy", [(0.3, -1.2, 2.9), (0, 0, 0), (1, np.pi / 2, 0), (1, -np.pi / 2, 0), (3, 1.5707, -3)])
def test_roll_pitch_and_yaw_come_back(rpy: tuple[float, float, float]) -> None:
    pose = Pose.from_rpy([0, 0, 0], rpy)
    assert np.allclose(Pose.from_rpy([0, 0, 0], pose.to_rpy()).rotation, pose.rotation, atol=1e-9)


def test_a_box_around_boxes_holds_them() -> None:
    whole = Aabb.union([Aabb([0, 0, 0], [1, 1, 1]), Aabb([-1, 2, 0], [0, 3, 0.5])])
    assert (whole.min.tolist(), whole.max.tolist()) == ([-1, 0, 0], [1, 3, 1])
    assert whole.diagonal == pytest.approx(np.sqrt(4 + 9 + 1))
    assert whole.corners.shape == (8, 3)


def test_shapes_and_poses_pickle() -> None:
    for shape in (Box.of_bounds(Aabb([0, 0, 0], [1, 2, 3])), Sphere(Pose.identity(), 2.0)):
        assert is_same_shape(pickle.loads(pickle.dumps(shape)), shape)
    hull = Box.of_bounds(Aabb([0, 0, 0], [1, 2, 3])).tessellate()
    assert is_same_shape(pickle.loads(pickle.dumps(hull)), hull)


def test_volumes_of_round_shapes_are_analytic() -> None:
    here = Pose.identity()
    assert Sphere(here, 2.0).volume == pytest.approx(4 / 3 * np.pi * 8)
    assert Cylinder(here, 2.0, 3.0).volume == pytest.approx(np.pi * 4 * 6)
    assert Ellipsoid(here, np.array([1.0, 2.0, 3.0])).volume == pytest.approx(4 / 3 * np.pi * 6)


@pytest.mark.parametrize("count", [0, 1, 400])
def test_rows_are_sorted_as_by_numpy(count: int) -> None:
    rows = np.random.default_rng(9).integers(-3, 4, (count, 3)).astype(np.float32) / 7
    assert np.array_equal(sort_rows(rows), np.unique(rows, axis=0))


def hull() -> Polytope:
    return Box.of_bounds(Aabb([0.1, 0.2, 0.3], [1.1, 2.3, 3.7])).tessellate()


def test_a_digest_survives_single_precision_and_another_order() -> None:
    rounded = Polytope(hull().vertices.astype(np.float32), hull().faces)
    reordered = Polytope(hull().vertices[::-1], 7 - hull().faces)
    assert digest(hull()) == digest(rounded) == digest(reordered)
    assert len(digest(hull())) == 16


def test_a_digest_tells_place_size_and_kind_apart() -> None:
    box = Box.of_bounds(Aabb([0.1, 0.2, 0.3], [1.1, 2.3, 3.7]))
    others = [hull().move(Pose.of_translation([1e-3, 0, 0])), hull().transform(np.eye(3) * 1.001, np.zeros(3)), box]
    assert len({digest(shape) for shape in [hull(), *others]}) == 4


def test_shapes_of_two_kinds_are_never_the_same() -> None:
    box = Box.of_bounds(Aabb([0, 0, 0], [1, 1, 1]))
    assert is_same_shape(box, box)
    assert not is_same_shape(box, box.tessellate())
    assert not is_same_shape(box, box.move(Pose.of_translation([1e-3, 0, 0])))
    assert is_same_shape(box, box.move(Pose.of_translation([1e-3, 0, 0])), tolerance=2e-3)


@pytest.mark.parametrize("rpy", [(0.3, -1.2, 2.9), (0, 0, 0), (np.pi, 0, 0), (0, np.pi, 0), (0, 0, np.pi), (2, 3, -1)])
def test_a_quaternion_turns_as_the_pose_does(rpy: tuple[float, float, float]) -> None:
    pose = Pose.from_rpy([0, 0, 0], rpy)
    w, *xyz = pose.to_quaternion()
    assert w >= 0
    point = np.array([0.3, -0.4, 0.5])
    turned = point + 2 * np.cross(xyz, np.cross(xyz, point) + w * point)
    assert np.allclose(turned, pose.rotation @ point, atol=1e-15)
