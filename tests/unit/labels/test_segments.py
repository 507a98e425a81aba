"""Classes of hulls from segmented points: laws over boxes, whose points are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import AssetError
from meshforge.formats import align_points
from meshforge.geometry import Aabb, Box, Floats, Ints, Pose, Sphere
from meshforge.labels.from_files.points import vote_by_points

Case = tuple[list[Box], Floats, Ints]


def shelf_of(count: int) -> list[Box]:
    """Boxes apart from each other, of different sizes."""
    return [Box(Pose.of_translation([2.0 * k, 0, 0]), np.array([0.5, 0.3 + 0.05 * k, 0.4])) for k in range(count)]


def within(box: Box, count: int, rng: np.random.Generator) -> Floats:
    points: Floats = box.pose.apply(rng.uniform(-1, 1, (count, 3)) * box.half)
    return points


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """Disjoint boxes, points in them, and a class of each box that its points have."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    boxes = shelf_of(draw(st.integers(1, 6)))
    counts = [draw(st.integers(1, 12)) for _ in boxes]
    kinds = [draw(st.integers(0, 3)) for _ in boxes]
    points = np.concatenate([within(box, count, rng) for box, count in zip(boxes, counts, strict=True)])
    return boxes, points, np.repeat(kinds, counts)


@given(cases())
def test_points_in_boxes_give_back_the_class_of_each(case: Case) -> None:
    boxes, points, classes = case
    said, held = vote_by_points(boxes, points, classes)
    assert held == pytest.approx(1.0)
    for box, (kind, confidence) in zip(boxes, said, strict=True):
        own = classes[np.abs(box.pose.inverse().apply(points) / box.half).max(axis=1) <= 1 + 1e-9]
        assert kind == own[0] and confidence == pytest.approx(len(own) / (len(own) + 2))


def test_the_majority_counts_and_its_share_is_how_sure_it_is() -> None:
    rng = np.random.default_rng(1)
    (box,) = shelf_of(1)
    points = within(box, 1000, rng)
    ((kind, confidence),), _ = vote_by_points([box], points, np.repeat([4, 2], [700, 300]))
    assert kind == 4 and confidence == pytest.approx(700 / 1002)
    ((kind, confidence),), _ = vote_by_points([box], points, np.repeat([4, 2], 500))
    assert kind == 2 and confidence == pytest.approx(500 / 1002)


def test_points_without_a_class_outvote_others() -> None:
    (box,) = shelf_of(1)
    points = within(box, 10, np.random.default_rng(2))
    ((kind, confidence),), _ = vote_by_points([box], points, np.repeat([-1, 3], [6, 4]))
    assert kind == -1 and confidence == pytest.approx(0.5)


def test_a_hull_without_points_takes_those_near_it_with_little_trust_and_none_from_afar() -> None:
    boxes = [Box(Pose.of_translation([x, 0, 0]), np.full(3, 0.5)) for x in (0.0, 1.08, 5.0)]
    points = within(boxes[0], 400, np.random.default_rng(3))
    points[:40, 0] = 0.5
    (_, near, far), _ = vote_by_points(boxes, points, np.zeros(400, dtype=np.int64))
    assert near[0] == 0 and 0.3 < near[1] <= 0.4
    assert far == (-1, 0.0)


def test_no_points_and_no_hulls_say_nothing() -> None:
    assert vote_by_points(shelf_of(2), np.zeros((0, 3)), np.zeros(0, dtype=np.int64)) == ([(-1, 0.0)] * 2, 0.0)
    assert vote_by_points([], np.zeros((1, 3)), np.zeros(1, dtype=np.int64)) == ([], 0.0)


def test_round_hulls_hold_what_lies_on_them() -> None:
    rng = np.random.default_rng(4)
    points = rng.normal(size=(500, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    ((kind, confidence),), held = vote_by_points([Sphere(Pose.identity(), 1.0)], points, np.full(500, 7))
    assert kind == 7 and confidence == pytest.approx(500 / 502) and held == 1.0


# Places

BOX = Aabb([0, 0, 0], [1, 2, 3])
CORNERS = np.array(BOX.corners)


def test_points_that_fit_stay_as_they_are() -> None:
    assert align_points(CORNERS * 1.01, [BOX], "check", "p.npz") is not None
    assert np.array_equal(align_points(CORNERS, [BOX], "check", "p.npz"), CORNERS)
    assert np.array_equal(align_points(CORNERS * 9, [BOX, Aabb([0, 0, 0], [9, 18, 27])], "check", "p.npz"), CORNERS * 9)


@pytest.mark.parametrize(
    "points", [CORNERS * 3 + 7, CORNERS[:, [0, 2, 1]] * [1, 1, -1], CORNERS[:, [0, 2, 1]] * [5, 5, -5] + 2]
)
def test_points_elsewhere_are_refused_with_what_makes_them_fit(points: Floats) -> None:
    with pytest.raises(AssetError) as told:
        align_points(points, [BOX], "check", "p.npz")
    assert told.value.remedy == "They would fit with --align box."
    assert align_points(points, [BOX], "box", "p.npz") == pytest.approx(CORNERS)


def test_points_of_an_asset_whose_y_points_up_are_turned_the_other_way() -> None:
    upright = CORNERS[:, [0, 2, 1]] * [1, 1, -1]
    assert align_points(CORNERS, [Aabb.of_points(upright)], "box", "p.npz", up="y") == pytest.approx(upright)


def test_points_of_another_thing_are_refused_however_they_are_moved() -> None:
    flat = np.array([[0, 0, 0], [5, 5, 0.1], [0, 5, 0], [5, 0, 0]])
    for align in ("check", "box"):
        with pytest.raises(AssetError, match="do not lie where the asset does") as told:
            align_points(flat, [BOX], align, "p.npz")
        assert told.value.remedy == "Export them in the frame of the asset, in metres."
    assert np.array_equal(align_points(flat, [BOX], "off", "p.npz"), flat)
