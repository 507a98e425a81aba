"""Laws of convex pieces that are joined where a hull around them adds little, and of pieces drawn within a solid."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import Box, Floats, Ints, Polytope, Pose, convex_hull, merge_pieces, volume_of_union
from meshforge.geometry.interior import Interior

sizes = st.floats(0.05, 0.5).map(lambda x: round(x, 3))
places = st.floats(-1, 1).map(lambda x: round(x, 3))
boxes = st.builds(lambda a, b, c, x, y, z: box((x, y, z), (a, b, c)), *[sizes] * 3, *[places] * 3)


def box(middle: tuple[float, float, float], half: tuple[float, float, float]) -> Polytope:
    return Box(Pose(np.eye(3), np.array(middle, dtype=float)), np.array(half, dtype=float)).tessellate()


@given(st.lists(boxes, min_size=1, max_size=7), st.data())
def test_each_piece_is_in_one_group_of_its_kind_within_its_hull(pieces: list[Polytope], data: st.DataObject) -> None:
    kinds = np.array([data.draw(st.integers(0, 1)) for _ in pieces])
    groups = merge_pieces(pieces, kinds)
    assert sorted(place for group in groups for place in group.members) == list(range(len(pieces)))
    for group in groups:
        assert {int(kinds[place]) for place in group.members} == {group.kind}
        own = [pieces[place] for place in group.members]
        assert volume_of_union([group.shape, *own]) == pytest.approx(group.shape.volume, rel=1e-6)
        assert volume_of_union(own) >= 0.85 * group.shape.volume * (1 - 1e-6), "a hull adds little"


@given(boxes, st.integers(2, 5), st.integers(0, 2))
def test_a_box_in_slices_of_one_kind_is_one_box_again(whole: Polytope, count: int, axis: int) -> None:
    low, high = whole.aabb.min, whole.aabb.max
    ends = np.linspace(low[axis], high[axis], count + 1)
    slices = [_slice(low, high, axis, a, b) for a, b in pairwise(ends)]
    (group,) = merge_pieces(slices, np.zeros(count, np.int64))
    assert group.shape.volume == pytest.approx(whole.volume, rel=1e-6)
    apart = merge_pieces(slices, np.arange(count))
    assert [one.members for one in apart] == [(k,) for k in range(count)], "kinds stay apart"


def _slice(low: Floats, high: Floats, axis: int, start: float, end: float) -> Polytope:
    corners = np.array([low, high])
    corners[:, axis] = start, end
    return box(tuple(corners.mean(axis=0)), tuple(np.ptp(corners, axis=0) / 2))


def test_no_hull_takes_what_is_of_another_kind() -> None:
    left, right = box((-0.25, 0, 0), (0.2, 0.2, 0.2)), box((0.25, 0, 0), (0.2, 0.2, 0.2))
    between = box((0, 0, 0), (0.05, 0.2, 0.2))
    touch = box((0, 0, -0.21), (0.45, 0.2, 0.01))  # so that left, right and it would fill their hull but for `between`
    groups = merge_pieces([left, right, between, touch], np.array([0, 0, 1, 0]))
    assert not any(len(group.members) == 3 for group in groups)
    for group in groups:
        if group.kind == 0:
            assert volume_of_union([group.shape, between]) == pytest.approx(group.shape.volume + between.volume)


@pytest.mark.parametrize(
    ("label", "height", "joins"),
    [("same", 0.3, True), ("same", 0.9, False), ("other", 0.03, True), ("other", 0.3, False)],
)
def test_a_sliver_joins_a_neighbour_whose_hull_grows_by_little(label: str, height: float, joins: bool) -> None:
    """On a block of 1 m lies a plate of a quarter of its top: the hull grows by a third of its height beside it."""
    block, plate = box((0, 0, -0.5), (0.5, 0.5, 0.5)), box((0, 0, height / 2), (0.25, 0.25, height / 2))
    labels = np.array([0, 0 if label == "same" else 1])
    groups = merge_pieces([block, plate], np.arange(2), 0.5, labels)
    assert [group.members for group in groups] == ([(0, 1)] if joins else [(0,), (1,)])
    assert len(merge_pieces([block, plate], np.arange(2), 0.2 * plate.volume, labels)) == 2, "no sliver"


def test_no_pieces_are_no_groups() -> None:
    assert merge_pieces([], np.zeros(0, np.int64)) == ()


@given(boxes, boxes)
def test_what_a_shape_has_of_a_solid_is_held_and_nothing_beyond(solid: Polytope, shape: Polytope) -> None:
    found = Interior(solid.vertices, solid.faces).list_hulls([shape])
    common = volume_of_union([solid]) + shape.volume - volume_of_union([solid, shape])
    assert sum(one.volume for one in found) >= common * (1 - 1e-3) - 1e-9
    if found:
        assert volume_of_union([shape, *found]) == pytest.approx(shape.volume, rel=1e-6)
        assert found == [shape] or volume_of_union(found) == pytest.approx(common, rel=1e-6)


def test_two_legs_in_one_shape_are_two_pieces_and_the_gap_is_free() -> None:
    legs = [box((x, 0, 0), (0.1, 0.1, 0.5)) for x in (-0.4, 0.4)]
    vertices, faces = _stack(legs)
    around = convex_hull(np.concatenate([leg.vertices for leg in legs]))
    found = Interior(vertices, faces).list_hulls([around])
    assert [one.volume for one in found] == pytest.approx([leg.volume for leg in legs])


def _stack(solids: list[Polytope]) -> tuple[Floats, Ints]:
    starts = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    faces = [solid.faces + start for solid, start in zip(solids, starts, strict=False)]
    return np.concatenate([solid.vertices for solid in solids]), np.concatenate(faces)


def test_a_sliver_joins_its_neighbour_though_another_one_has_grown_meanwhile() -> None:
    """Two slivers make one piece that is none, before it is the turn of the third."""
    small = [box((0.45, 0.5, 0.5), (0.45, 0.5, 0.5)), box((1.38, 0.5, 0.5), (0.48, 0.5, 0.5))]
    third = [box((10.485, 0.5, 0.5), (0.485, 0.5, 0.5)), box((25.485, 0.5, 0.5), (14.515, 0.5, 0.5))]
    together = merge_pieces([*small, *third], np.arange(4), 1.0, np.zeros(4, np.int64))
    assert [group.members for group in together] == [(0, 1), (2, 3)]
