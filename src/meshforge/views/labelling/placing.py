"""Where the numbers of hulls go: onto what is seen of each, or beside it with a line that leads there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.views.labelling.lines import crosses, cuts, overlaps
from meshforge.views.marks import Box
from meshforge.views.middles import Middle, middles, pixels_of

LEAST = 24
"""Pixels of a hull that must be seen for it to be numbered."""
_NOTHING = -1  # what stands on a box that is taken
_OWN, _OTHERS = 0.4, 0.12  # the least of a number's box that its own hull fills, and the most that others do
_GAP = 3  # pixels between numbers
_CELL = 4  # pixels along the cells in which free paper is looked for
_TURNS = np.arange(32) * (np.pi / 16)
_AWAY = np.concatenate([np.arange(1.2, 4, 0.4), np.arange(4, 18, 1.0)])  # how far from its hull, in heights of a number
_COVERED, _DISTANT = 2.0, 1 / 6  # what it costs to cover hulls wholly, and to be a height farther away
_FEW = 48  # places that are looked at together, the cheapest first
_SMALL = 4.0  # hulls no larger than this many numbers are not to be covered

Size = tuple[float, float]
"""Width and height [px]."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where the number of a hull stands; spot: column and row that a line leads to from a number beside the hull."""

    item: int
    box: Box
    height: int
    spot: tuple[int, int] | None = None

    @property
    def center(self) -> tuple[float, float]:
        left, top, right, bottom = self.box
        return (left + right) / 2, (top + bottom) / 2


def placed(
    items: Ints,
    sizes: Mapping[int, Mapping[int, Size]],
    known: Mapping[int, Middle] | None = None,
    taken: Sequence[Box] = (),
) -> list[Place]:
    """Places for the numbers of hulls as far as they are seen and fit; none covers another, or a box that is taken.

    items: (h, w), what each pixel shows; sizes: of each number to be placed, the room it takes for each height of
    type [px] that it may be written in, the one liked best first; known: where hulls are that hardly any pixel shows.
    """
    found = {**middles(items, sizes, LEAST), **(known or {})}
    places = [Place(_NOTHING, box, 0) for box in taken]
    for item, middle in found.items():
        place = _within(items, item, middle, sizes[item], places)
        if place:
            places.append(place)
    led = [item for item in found if item not in {place.item for place in places}]
    if led:
        smallest = {item: list(sizes[item].items())[-1] for item in led}
        page = _Page(items, places, [found[item] for item in led], max(w * h for _, (w, h) in smallest.values()))
        for item in led:
            page.place_beside(item, found[item], *smallest[item])
        places = page.places
    return places[len(taken) :]


def _within(items: Ints, item: int, middle: Middle, sizes: Mapping[int, Size], places: Sequence[Place]) -> Place | None:
    """The number on its hull, as large as fits there."""
    taken = np.array([p.box for p in places]).reshape(-1, 4)
    for height, (wide, high) in sizes.items():
        left, top = round(middle.column - wide / 2), round(middle.row - high / 2)
        box = (left, top, left + round(wide), top + round(high))
        if _fits(items, item, box) and not overlaps(np.array([box]), taken, _GAP).any():
            return Place(item, box, height)
    return None


def _fits(items: Ints, item: int, box: tuple[int, int, int, int]) -> bool:
    """Whether a box lies in the picture and on its own hull well enough, and hardly on others."""
    left, top, right, bottom = box
    if left < 0 or top < 0 or right > items.shape[1] or bottom > items.shape[0]:
        return False
    below = items[top:bottom, left:right]
    own, others = (below == item).mean(), ((below >= 0) & (below != item)).mean()
    return bool(own >= _OWN and others <= _OTHERS)


class _Page:
    """A picture that numbers are put on one by one, away from their hulls.

    kept: what is not to be covered; area: of a number [px].
    """

    def __init__(self, items: Ints, places: Sequence[Place], kept: Sequence[Middle], area: float) -> None:
        self.places = list(places)
        self._size = items.shape[1], items.shape[0]
        cells = items[::_CELL, ::_CELL]
        counts = np.append(pixels_of(items), 0)
        self._taken = _summed(cells >= 0)
        self._small = _summed((cells >= 0) & (counts[cells] < _SMALL * area))
        self._kept = np.array([(s.column - 4, s.row - 4, s.column + 4, s.row + 4) for s in kept], np.float64)

    def place_beside(self, item: int, middle: Middle, height: int, size: Size) -> None:
        """Places a number near its hull, on free paper if there is any; not at all where no room is."""
        boxes, away = self._candidate_boxes(middle, size)
        cost = _COVERED * self._share_covered(self._taken, boxes) + _DISTANT * away / size[1]
        cost += 2 * _COVERED * self._share_covered(self._small, boxes)
        order = np.argsort(cost, kind="stable")
        for few in np.split(order, range(_FEW, len(order), _FEW)):
            free = few[~self._is_blocked(boxes[few], middle)]
            if len(free):
                left, top, right, bottom = boxes[free[0]].tolist()
                self.places.append(Place(item, (left, top, right, bottom), height, (middle.column, middle.row)))
                return

    def _candidate_boxes(self, middle: Middle, size: Size) -> tuple[Floats, Floats]:
        """Boxes (n, 4) about a middle that lie in the picture, and how far away each is [px]."""
        away = np.repeat(_AWAY, len(_TURNS)) * size[1]
        turn = np.tile(_TURNS, len(_AWAY))
        left = np.rint(middle.column + away * np.cos(turn) - size[0] / 2)
        top = np.rint(middle.row + away * np.sin(turn) - size[1] / 2)
        boxes = np.column_stack([left, top, left + round(size[0]), top + round(size[1])])
        inside = (boxes[:, :2] >= 0).all(axis=1) & (boxes[:, 2:] <= self._size).all(axis=1)
        return boxes[inside], away[inside]

    def _is_blocked(self, boxes: Floats, middle: Middle) -> Any:
        """Which boxes (n, 4) cover a number or a spot, or are led to by a line that meets one or another line."""
        spot = np.array([middle.column, middle.row], np.float64)
        lines = np.column_stack([np.broadcast_to(spot, (len(boxes), 2)), (boxes[:, :2] + boxes[:, 2:]) / 2])
        taken = np.array([p.box for p in self.places]).reshape(-1, 4)
        led = np.array([(*p.spot, *p.center) for p in self.places if p.spot]).reshape(-1, 4)
        others = self._kept[~((self._kept[:, :2] < spot) & (spot < self._kept[:, 2:])).all(axis=1)]
        bad = overlaps(boxes, taken, _GAP).any(axis=1) | cuts(lines, taken).any(axis=1)
        bad |= crosses(lines, led).any(axis=1) | cuts(led, boxes).any(axis=0)
        return bad | overlaps(boxes, others, 0).any(axis=1)

    def _share_covered(self, summed: Ints, boxes: Floats) -> Floats:
        """How much of each box (n, 4) is covered by what is summed up."""
        left, top, right, bottom = (boxes // _CELL).astype(int).T
        right, bottom = right + 1, bottom + 1
        right, bottom = np.minimum(right, summed.shape[1] - 1), np.minimum(bottom, summed.shape[0] - 1)
        inside = summed[bottom, right] - summed[top, right] - summed[bottom, left] + summed[top, left]
        shares: Floats = inside / np.maximum((right - left) * (bottom - top), 1)
        return shares


def _summed(mask: Any) -> Ints:
    """How many cells (h + 1, w + 1) above and left of each corner are set."""
    total = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), np.int64)
    total[1:, 1:] = mask.cumsum(axis=0).cumsum(axis=1)
    return total
