"""Where the numbers or names of hulls go: onto what is seen of each, or beside it with a line that leads there."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.rendering.annotation import INK, LabelAnchor, PixelBox, count_pixels, find_label_anchors, font
from meshforge.rendering.colors import hexadecimal

LEAST_PIXELS = 24
"""Pixels of a hull that must be seen for it to be numbered."""
_OWN, _OTHERS = 0.4, 0.12  # the least of a number's box that its own hull fills, and the most that others do
_GAP = 3  # pixels between numbers
_CELL = 4  # pixels along the cells in which free paper is looked for
_TURNS = np.arange(32) * (np.pi / 16)
_AWAY = np.concatenate([np.arange(1.2, 4, 0.4), np.arange(4, 18, 1.0)])  # how far from its hull, in heights of a number
_COVERED, _DISTANT = 2.0, 1 / 6  # what it costs to cover hulls wholly, and to be a height farther away
_FEW = 48  # places that are looked at together, the cheapest first
_SMALL = 4.0  # hulls no larger than this many numbers are not to be covered

TextSize = tuple[float, float]
"""Width and height [px]."""


@dataclass(frozen=True, slots=True)
class NumberPlace:
    """Where the number of a hull stands; spot: column and row that a line leads to from a number beside the hull."""

    item: int
    box: PixelBox
    height: int
    spot: tuple[int, int] | None = None

    @property
    def center(self) -> tuple[float, float]:
        left, top, right, bottom = self.box
        return (left + right) / 2, (top + bottom) / 2


def place_numbers(items: Ints, sizes: Mapping[int, Mapping[int, TextSize]]) -> list[NumberPlace]:
    """Return places for the numbers of hulls as far as they are seen and fit; none covers another.

    items: (h, w), what each pixel shows; sizes: of each number to be placed, the room it takes for each height of
    type [px] that it may be written in, the one liked best first.
    """
    found = find_label_anchors(items, sizes, LEAST_PIXELS)
    places: list[NumberPlace] = []
    for item, middle in found.items():
        place = _place_inside(items, item, middle, sizes[item], places)
        if place:
            places.append(place)
    led = [item for item in found if item not in {place.item for place in places}]
    if led:
        smallest = {item: list(sizes[item].items())[-1] for item in led}
        page = _FreeSpace(items, places, [found[item] for item in led], max(w * h for _, (w, h) in smallest.values()))
        for item in led:
            page.place_beside(item, found[item], *smallest[item])
        places = page.places
    return places


def _place_inside(
    items: Ints, item: int, middle: LabelAnchor, sizes: Mapping[int, TextSize], places: Sequence[NumberPlace]
) -> NumberPlace | None:
    taken = np.array([p.box for p in places]).reshape(-1, 4)
    for height, (wide, high) in sizes.items():
        left, top = round(middle.column - wide / 2), round(middle.row - high / 2)
        box = (left, top, left + round(wide), top + round(high))
        is_inside = left >= 0 and top >= 0 and box[2] <= items.shape[1] and box[3] <= items.shape[0]
        if not is_inside or find_box_overlaps(np.array([box]), taken, _GAP).any():
            continue
        below = items[top : box[3], left : box[2]]
        own, others = (below == item).mean(), ((below >= 0) & (below != item)).mean()
        if own >= _OWN and others <= _OTHERS:
            return NumberPlace(item, box, height)
    return None


class _FreeSpace:
    """A picture that numbers are put on one by one, away from their hulls.

    kept: what is not to be covered; area: of a number [px].
    """

    def __init__(self, items: Ints, places: Sequence[NumberPlace], kept: Sequence[LabelAnchor], area: float) -> None:
        self.places = list(places)
        self._size = items.shape[1], items.shape[0]
        cells = items[::_CELL, ::_CELL]
        counts = np.append(count_pixels(items), 0)
        self._taken = _integral_image(cells >= 0)
        self._small = _integral_image((cells >= 0) & (counts[cells] < _SMALL * area))
        self._kept = np.array([(s.column - 4, s.row - 4, s.column + 4, s.row + 4) for s in kept], np.float64)

    def place_beside(self, item: int, middle: LabelAnchor, height: int, size: TextSize) -> None:
        """Places a number near its hull, on free paper if there is any; not at all where no room is."""
        boxes, away = self._candidate_boxes(middle, size)
        cost = _COVERED * self._share_covered(self._taken, boxes) + _DISTANT * away / size[1]
        cost += 2 * _COVERED * self._share_covered(self._small, boxes)
        order = np.argsort(cost, kind="stable")
        for few in np.split(order, range(_FEW, len(order), _FEW)):
            free = few[~self._is_blocked(boxes[few], middle)]
            if len(free):
                left, top, right, bottom = boxes[free[0]].tolist()
                self.places.append(NumberPlace(item, (left, top, right, bottom), height, (middle.column, middle.row)))
                return

    def _candidate_boxes(self, middle: LabelAnchor, size: TextSize) -> tuple[Floats, Floats]:
        """Boxes (n, 4) about a middle that lie in the picture, and how far away each is [px]."""
        away = np.repeat(_AWAY, len(_TURNS)) * size[1]
        turn = np.tile(_TURNS, len(_AWAY))
        left = np.rint(middle.column + away * np.cos(turn) - size[0] / 2)
        top = np.rint(middle.row + away * np.sin(turn) - size[1] / 2)
        boxes = np.column_stack([left, top, left + round(size[0]), top + round(size[1])])
        inside = (boxes[:, :2] >= 0).all(axis=1) & (boxes[:, 2:] <= self._size).all(axis=1)
        return boxes[inside], away[inside]

    def _is_blocked(self, boxes: Floats, middle: LabelAnchor) -> Any:
        """Which boxes (n, 4) cover a number or a spot, or are led to by a line that meets one or another line."""
        spot = np.array([middle.column, middle.row], np.float64)
        lines = np.column_stack([np.broadcast_to(spot, (len(boxes), 2)), (boxes[:, :2] + boxes[:, 2:]) / 2])
        taken = np.array([p.box for p in self.places]).reshape(-1, 4)
        led = np.array([(*p.spot, *p.center) for p in self.places if p.spot]).reshape(-1, 4)
        others = self._kept[~((self._kept[:, :2] < spot) & (spot < self._kept[:, 2:])).all(axis=1)]
        bad = find_box_overlaps(boxes, taken, _GAP).any(axis=1) | find_box_crossings(lines, taken).any(axis=1)
        bad |= find_line_crossings(lines, led).any(axis=1) | find_box_crossings(led, boxes).any(axis=0)
        return bad | find_box_overlaps(boxes, others, 0).any(axis=1)

    def _share_covered(self, summed: Ints, boxes: Floats) -> Floats:
        left, top, right, bottom = (boxes // _CELL).astype(int).T
        right, bottom = right + 1, bottom + 1
        right, bottom = np.minimum(right, summed.shape[1] - 1), np.minimum(bottom, summed.shape[0] - 1)
        inside = summed[bottom, right] - summed[top, right] - summed[bottom, left] + summed[top, left]
        shares: Floats = inside / np.maximum((right - left) * (bottom - top), 1)
        return shares


def draw_texts(
    draw: Any, places: Sequence[NumberPlace], texts: Mapping[int, str], colors: Floats, corner: tuple[int, int]
) -> None:
    """Write the texts of hulls at their places in a drawing; colors: (n, 3); corner: where the drawing lies [px]."""
    right, down = corner
    for place in places:
        if place.spot:
            ends = [(x + right, y + down) for x, y in (place.spot, place.center)]
            draw.line(ends, "white", 5)
            draw.line(ends, INK, 2)
    for place in places:
        (left, above, beyond, below), (x, y) = place.box, place.center
        text, type_, middle = texts[place.item], font(place.height), (x + right, y + down)
        if place.spot:
            x, y, dot = place.spot[0] + right, place.spot[1] + down, max(3, place.height // 7)
            draw.ellipse((x - dot, y - dot, x + dot, y + dot), INK, "white", 1)
            box = left + right, above + down, beyond + right, below + down
            edge = hexadecimal(colors[place.item] * 0.8)
            draw.rounded_rectangle(box, place.height // 4, "white", edge, 2)
            draw.text(middle, text, INK, type_, "mm")
        else:
            draw.text(middle, text, INK, type_, "mm", stroke_width=max(2, place.height // 6), stroke_fill="white")


def _integral_image(mask: Any) -> Ints:
    """How many cells (h + 1, w + 1) above and left of each corner are set."""
    total = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), np.int64)
    total[1:, 1:] = mask.cumsum(axis=0).cumsum(axis=1)
    return total


def find_box_overlaps(boxes: Floats, others: Floats, gap: float) -> Any:
    """Return which boxes (n, 4) come nearer than `gap` to which (m, 4): (n, m); left, top, right, bottom [px]."""
    (left, top, right, bottom), (west, north, east, south) = _columns(boxes), _rows(others)
    return (left - gap < east) & (west - gap < right) & (top - gap < south) & (north - gap < bottom)


def find_box_crossings(lines: Floats, boxes: Floats) -> Any:
    """Return which lines (n, 4), from one point to another, enter which boxes (m, 4): (n, m) (Liang and Barsky)."""
    (x, y, end_x, end_y), (left, top, right, bottom) = _columns(lines), _rows(boxes)
    step_x, step_y = _avoid_zero(end_x - x), _avoid_zero(end_y - y)
    a, b, c, d = (left - x) / step_x, (right - x) / step_x, (top - y) / step_y, (bottom - y) / step_y
    enter = np.maximum(np.minimum(a, b), np.minimum(c, d))
    return np.maximum(enter, 0) < np.minimum(np.minimum(np.maximum(a, b), np.maximum(c, d)), 1)


def find_line_crossings(lines: Floats, others: Floats) -> Any:
    """Return which lines (n, 4) cross which others (m, 4): (n, m)."""
    (ax, ay, bx, by), (cx, cy, dx, dy) = _columns(lines), _rows(others)
    apart = _side_of(ax, ay, bx, by, cx, cy) * _side_of(ax, ay, bx, by, dx, dy) < 0
    return apart & (_side_of(cx, cy, dx, dy, ax, ay) * _side_of(cx, cy, dx, dy, bx, by) < 0)


def _side_of(ax: Floats, ay: Floats, bx: Floats, by: Floats, x: Floats, y: Floats) -> Floats:
    """On which side of the line from a to b a point lies, by its sign."""
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax)


def _avoid_zero(step: Floats) -> Floats:
    return np.where(np.abs(step) < 1e-9, 1e-9, step)


def _columns(rows: Floats) -> Floats:
    """The parts (4, n, 1) of boxes or lines (n, 4)."""
    return np.ascontiguousarray(rows.T)[:, :, None]


def _rows(rows: Floats) -> Floats:
    return np.ascontiguousarray(rows.T)[:, None]
