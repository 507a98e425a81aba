"""Classes of hulls from segmented points: laws over boxes, whose points are known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import GeometryError
from meshforge.formats import PointAlignment, PointSamples, align_points, samples_of_faces, samples_of_points
from meshforge.formats.segmentation.samples import _COUNT
from meshforge.geometry import Aabb, Box, Floats, Ints, Pose, Sphere
from meshforge.labels.from_files.segments import vote_by_points

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


def found(boxes: list[Box], points: Floats, classes: Ints) -> list[int | None]:
    return [vote.kind if vote else None for vote in vote_by_points(boxes, samples_of_points(points, classes)).of_hulls]


@given(cases())
def test_points_in_boxes_give_back_the_class_of_each(case: Case) -> None:
    boxes, points, classes = case
    said = vote_by_points(boxes, samples_of_points(points, classes))
    assert said.held == pytest.approx(1.0)
    for box, vote in zip(boxes, said.of_hulls, strict=True):
        own = classes[np.abs(box.pose.inverse().apply(points) / box.half).max(axis=1) <= 1 + 1e-9]
        assert vote is not None and len(own) == vote.points and vote.kind == own[0]
        assert vote.confidence == pytest.approx(len(own) / (len(own) + 2), abs=1e-3)


@given(cases(), st.integers(0, 99))
def test_the_order_of_points_does_not_matter(case: Case, seed: int) -> None:
    boxes, points, classes = case
    order = np.random.default_rng(seed).permutation(len(points))
    assert (
        vote_by_points(boxes, samples_of_points(points, classes)).of_hulls
        == vote_by_points(boxes, samples_of_points(points[order], classes[order])).of_hulls
    )


@given(cases(), st.integers(2, 4))
def test_points_given_several_times_say_the_same_more_surely(case: Case, times: int) -> None:
    boxes, points, classes = case
    once = vote_by_points(boxes, samples_of_points(points, classes)).of_hulls
    more = vote_by_points(boxes, samples_of_points(np.tile(points, (times, 1)), np.tile(classes, times))).of_hulls
    for few, many in zip(once, more, strict=True):
        assert few and many and few.kind == many.kind and many.confidence > few.confidence


def test_the_majority_counts_and_its_share_is_how_sure_it_is() -> None:
    rng = np.random.default_rng(1)
    (box,) = shelf_of(1)
    points = within(box, 1000, rng)
    (vote,) = vote_by_points([box], samples_of_points(points, np.repeat([4, 2], [700, 300]))).of_hulls
    assert vote is not None and vote.kind == 4
    assert vote.confidence == pytest.approx(0.7 * 1000 / 1002, abs=1e-3)
    (tie,) = vote_by_points([box], samples_of_points(points, np.repeat([4, 2], 500))).of_hulls
    assert tie is not None and tie.kind == 2


def test_points_without_a_class_outvote_others() -> None:
    (box,) = shelf_of(1)
    (vote,) = vote_by_points(
        [box], samples_of_points(within(box, 10, np.random.default_rng(2)), np.repeat([-1, 3], [6, 4]))
    ).of_hulls
    assert vote is not None and vote.kind == -1


def test_a_hull_without_points_takes_those_near_it_with_little_trust_and_none_from_afar() -> None:
    boxes = [Box(Pose.of_translation([x, 0, 0]), np.full(3, 0.5)) for x in (0.0, 1.08, 5.0)]
    points = within(boxes[0], 400, np.random.default_rng(3))
    points[:40, 0] = 0.5
    near, far = vote_by_points(boxes, samples_of_points(points, np.zeros(400, dtype=np.int64))).of_hulls[1:]
    assert near is not None and near.kind == 0 and 0.3 < near.confidence <= 0.4
    assert far is None


def test_no_points_and_no_hulls_say_nothing() -> None:
    none = samples_of_points(np.zeros((0, 3)), np.zeros(0, dtype=np.int64))
    assert vote_by_points(shelf_of(2), none).of_hulls == (None, None)
    assert vote_by_points([], samples_of_points(np.zeros((1, 3)), np.zeros(1, dtype=np.int64))).of_hulls == ()


def test_round_hulls_hold_what_lies_on_them() -> None:
    ball = Sphere(Pose.identity(), 1.0)
    rng = np.random.default_rng(4)
    points = rng.normal(size=(500, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    (vote,) = vote_by_points([ball], samples_of_points(points, np.full(500, 7))).of_hulls
    assert vote is not None and vote.kind == 7 and vote.points > 400


# Faces


def mesh_of(boxes: list[Box]) -> tuple[Floats, Ints]:
    vertices, faces, start = [], [], 0
    for box in boxes:
        vertices.append(box.vertices)
        faces.append(box.faces + start)
        start += len(box.vertices)
    return np.concatenate(vertices), np.concatenate(faces)


def test_points_on_faces_stand_for_their_area() -> None:
    vertices, faces = mesh_of(shelf_of(3))
    samples = samples_of_faces(vertices, faces, np.arange(len(faces)), each=True)
    corners = vertices[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert np.bincount(samples.classes, samples.weights) == pytest.approx(areas)
    assert _COUNT <= len(samples.points) <= _COUNT + len(faces)
    for face in (0, 5, len(faces) - 1):
        own = samples.points[samples.classes == face]
        assert own.mean(axis=0) == pytest.approx(corners[face].mean(axis=0), abs=0.01)


def test_a_face_divided_finely_has_no_more_weight() -> None:
    """The sides are twelve faces of class 0; before one of them are very many of class 1, which are tiny."""
    (box,) = shelf_of(1)
    vertices, faces = box.vertices, box.faces
    shrunk = vertices[faces[0]] * 0.001 + vertices[faces[0]].mean(axis=0) * 0.999
    tiny = np.tile(np.arange(3) + len(vertices), (90_000, 1))
    classes = np.repeat([0, 1], [len(faces), len(tiny)])
    samples = samples_of_faces(np.concatenate([vertices, shrunk]), np.concatenate([faces, tiny]), classes, each=True)
    (vote,) = vote_by_points([box], samples).of_hulls
    assert np.bincount(samples.classes)[1] > np.bincount(samples.classes)[0]
    assert vote is not None and vote.kind == 0


def test_classes_of_vertices_go_to_the_face_around_them() -> None:
    boxes = shelf_of(2)
    vertices, faces = mesh_of(boxes)
    classes = np.repeat([5, 6], [len(box.vertices) for box in boxes])
    said = vote_by_points(boxes, samples_of_faces(vertices, faces, classes, each=False))
    assert [vote.kind for vote in said.of_hulls if vote] == [5, 6]


def test_a_mesh_without_area_still_has_a_point_a_face() -> None:
    samples = samples_of_faces(np.zeros((3, 3)), np.array([[0, 1, 2]]), np.array([1]), each=True)
    assert isinstance(samples, PointSamples) and len(samples.points) == 1


# Places

BOX = Aabb([0, 0, 0], [1, 2, 3])
CORNERS = np.array(BOX.corners)


def test_points_that_fit_stay_as_they_are() -> None:
    assert align_points(CORNERS * 1.01, [BOX], PointAlignment()) is not None
    assert np.array_equal(align_points(CORNERS, [BOX], PointAlignment()), CORNERS)
    assert np.array_equal(align_points(CORNERS * 9, [BOX, Aabb([0, 0, 0], [9, 18, 27])], PointAlignment()), CORNERS * 9)


@pytest.mark.parametrize(
    ("points", "option"),
    [
        (CORNERS * 3 + 7, "--align box"),
        (CORNERS[:, [0, 2, 1]] * [1, 1, -1], "--points-up y"),
        (CORNERS[:, [0, 2, 1]] * [5, 5, -5] + 2, "--points-up y --align box"),
    ],
)
def test_points_elsewhere_are_refused_with_what_would_make_them_fit(points: Floats, option: str) -> None:
    with pytest.raises(GeometryError) as told:
        align_points(points, [BOX], PointAlignment())
    assert told.value.remedy == f"They would fit with {option}."
    words = option.split()
    placing = PointAlignment("box" if "box" in words else "check", "y" if "y" in words else None)
    assert align_points(points, [BOX], placing) == pytest.approx(CORNERS)


def test_points_of_another_thing_are_refused_however_they_are_moved() -> None:
    flat = np.array([[0, 0, 0], [5, 5, 0.1], [0, 5, 0], [5, 0, 0]])
    for placing in (PointAlignment(), PointAlignment("box"), PointAlignment("box", "y")):
        with pytest.raises(GeometryError, match="do not lie where the asset does") as told:
            align_points(flat, [BOX], placing)
        assert told.value.remedy == "Export them in the frame of the asset, in metres."
    assert np.array_equal(align_points(flat, [BOX], PointAlignment("off")), flat)


def test_up_means_the_other_way_where_the_asset_says_it() -> None:
    upright = CORNERS[:, [0, 2, 1]] * [1, 1, -1]
    box = Aabb.of_points(upright)
    assert np.array_equal(align_points(upright, [box], PointAlignment(up="y"), up="y"), upright)
    assert align_points(CORNERS, [box], PointAlignment(up="z"), up="y") == pytest.approx(upright)
