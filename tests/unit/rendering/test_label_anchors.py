"""The middle of what is seen of a thing."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import Ints
from meshforge.rendering.annotation import find_label_anchors


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
