"""Numbers on pictures: where they stand, and that none covers another. The middle of what is seen of a thing."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import Floats, Ints
from meshforge.rendering.annotation import find_label_anchors
from meshforge.rendering.placement import (
    LEAST_PIXELS,
    NumberPlace,
    find_box_crossings,
    find_box_overlaps,
    find_line_crossings,
    place_numbers,
)
from tests.examples import examples

SIZES = {22: (34.0, 24.0), 17: (27.0, 19.0)}
SHAPE = (260, 320)


def picture(rectangles: list[tuple[int, int, int, int]]) -> Ints:
    """Rectangles (left, top, width, height), each over those before it."""
    items = np.full(SHAPE, -1)
    for k, (left, top, width, height) in enumerate(rectangles):
        items[top : top + height, left : left + width] = k
    return items


def put(items: Ints) -> dict[int, NumberPlace]:
    return {place.item: place for place in place_numbers(items, dict.fromkeys(range(int(items.max()) + 1), SIZES))}


RECTANGLES = st.tuples(st.integers(10, 280), st.integers(10, 220), st.integers(3, 150), st.integers(3, 120))


@examples(60)
@given(st.lists(RECTANGLES, min_size=1, max_size=40))
def test_numbers_never_cover_each_other_nor_the_lines_to_them(rectangles: list[tuple[int, int, int, int]]) -> None:
    items = picture(rectangles)
    places = list(put(items).values())
    boxes = np.array([place.box for place in places]).reshape(-1, 4)
    assert (boxes[:, :2] >= 0).all()
    assert (boxes[:, 2:] <= SHAPE[::-1]).all()
    assert not (find_box_overlaps(boxes, boxes, 0) & ~np.eye(len(boxes), dtype=bool)).any()
    led = [place for place in places if place.spot]
    lines = np.array([(*place.spot, *place.center) for place in led if place.spot]).reshape(-1, 4)
    own = np.array([[place is other for other in places] for place in led], bool).reshape(len(led), len(places))
    assert not (find_box_crossings(lines, boxes) & ~own).any()
    assert not find_line_crossings(lines, lines).any()
    for place in places:
        column, row = place.spot or (round(place.center[0]), round(place.center[1]))
        if place.spot:
            assert items[row, column] == place.item, "the line leads to a pixel of its hull"
        else:
            left, top, right, bottom = (round(v) for v in place.box)
            below = items[top:bottom, left:right]
            assert (below == place.item).mean() >= 0.4
            assert ((below >= 0) & (below != place.item)).mean() <= 0.12


def test_a_number_stands_large_in_the_middle_of_a_large_hull() -> None:
    place = put(picture([(20, 40, 200, 100)]))[0]
    assert place.spot is None
    assert place.height == 22
    assert abs(place.center[0] - 120) <= 4
    assert abs(place.center[1] - 90) <= 4


def test_a_number_is_written_smaller_before_it_is_led_to() -> None:
    assert put(picture([(20, 40, 200, 180), (50, 60, 28, 19)]))[1].height == 17
    led = put(picture([(20, 40, 200, 180), (50, 60, 12, 12)]))[1]
    assert led.spot == (55, 65) or led.spot == (56, 66)
    assert led.center != led.spot


def test_a_number_beside_its_hull_goes_to_free_paper() -> None:
    items = picture([(20, 40, 200, 180), (205, 60, 12, 12)])
    left, top, right, bottom = (round(v) for v in put(items)[1].box)
    assert (items[top:bottom, left:right] == -1).all()


def test_hulls_hardly_seen_have_no_number() -> None:
    items = picture([(100, 100, 4, 5)])
    assert LEAST_PIXELS > 20
    assert not place_numbers(items, {0: SIZES, 1: SIZES})


BOX = st.tuples(*[st.integers(0, 30)] * 4).map(lambda b: (b[0], b[1], b[0] + 1 + b[2] // 3, b[1] + 1 + b[3] // 3))
LINE = st.tuples(*[st.integers(0, 40)] * 4).filter(lambda v: v[:2] != v[2:])


@given(st.lists(LINE, min_size=1, max_size=6), st.lists(BOX, min_size=1, max_size=6))
def test_lines_cut_the_boxes_that_have_some_points(lines: list[tuple[int, ...]], boxes: list[tuple[int, ...]]) -> None:
    found = find_box_crossings(np.array(lines, float), np.array(boxes, float))
    for (a, line), (b, box) in ((x, y) for x in enumerate(lines) for y in enumerate(boxes)):
        points = between(line)
        inside = (points > np.array(box[:2]) + 1e-6).all(axis=1) & (points < np.array(box[2:]) - 1e-6).all(axis=1)
        touches = (points >= np.array(box[:2])).all(axis=1) & (points <= np.array(box[2:])).all(axis=1)
        assert found[a, b] >= inside.any()
        assert found[a, b] <= touches.any() or short(line, box)


def between(line: tuple[int, ...]) -> Floats:
    share = np.linspace(0, 1, 4001)[:, None]
    points: Floats = np.array(line[:2]) * (1 - share) + np.array(line[2:]) * share
    return points


def short(line: tuple[int, ...], box: tuple[int, ...]) -> bool:
    """Whether a line cuts so little of a box that no sampled point is in it."""
    near = between(line)
    gap = np.maximum(np.array(box[:2]) - near, near - np.array(box[2:])).max(axis=1)
    return bool(gap.min() < 0.02)


@given(LINE, LINE)
def test_crossing_is_mutual_and_lines_with_one_end_do_not_cross(line: tuple[int, ...], other: tuple[int, ...]) -> None:
    one, two = np.array([line], float), np.array([other], float)
    assert find_line_crossings(one, two)[0, 0] == find_line_crossings(two, one)[0, 0]
    assert not find_line_crossings(one, np.array([(*line[:2], *other[2:])], float))[0, 0]


def test_crossing_lines_are_found() -> None:
    plus = np.array([[0, 5, 10, 5], [5, 0, 5, 10], [6, 6, 9, 9]], float)
    assert find_line_crossings(plus, plus).tolist() == [
        [False, True, False],
        [True, False, False],
        [False, False, False],
    ]


def test_the_middle_of_a_rectangle_is_its_centre() -> None:
    items = np.full((400, 500), -1)
    items[100:200, 50:450] = 7
    middle = find_label_anchors(items)[7]
    assert abs(middle.row - 150) <= 4
    assert abs(middle.column - 250) <= 8
    assert abs(middle.room - 50) <= 4


def test_the_middle_of_a_ring_is_on_it() -> None:
    rows, columns = np.indices((300, 300))
    far = np.hypot(rows - 150, columns - 150)
    items = np.where((far > 80) & (far < 120), 0, -1)
    middle = find_label_anchors(items)[0]
    assert items[middle.row, middle.column] == 0
    assert abs(middle.room - 20) <= 4


def test_a_thin_slanting_line_has_a_middle_too() -> None:
    items = np.full((900, 900), -1)
    items[np.arange(1, 900, 1), np.arange(0, 899)] = 0
    middle = find_label_anchors(items)[0]
    assert items[middle.row, middle.column] == 0


def test_only_what_is_wanted_and_seen_enough_has_one_most_room_first() -> None:
    items = np.full((50, 50), -1)
    items[0:10, 0:10], items[20:45, 20:45], items[40:50, 0:2], items[0:20, 30:50] = 0, 1, 2, 3
    assert list(find_label_anchors(items)) == [1, 3, 0, 2]
    assert list(find_label_anchors(items, {0, 2, 3}, least=21)) == [3, 0]
    assert find_label_anchors(np.full((5, 5), -1)) == {}


@given(st.integers(1, 6), st.integers(0, 2**31))
def test_every_thing_that_is_seen_has_its_middle_on_itself(count: int, seed: int) -> None:
    items: Ints = np.random.default_rng(seed).integers(-1, count, (12, 9)).repeat(7, axis=0).repeat(5, axis=1)
    found = find_label_anchors(items)
    assert set(found) == set(np.unique(items[items >= 0]).tolist())
    assert all(items[middle.row, middle.column] == k for k, middle in found.items())
