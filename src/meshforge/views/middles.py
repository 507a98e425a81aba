"""The middle of each thing in a picture: where most of it is seen around."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.geometry import Ints

_CELLS = 64  # along each side of a thing, in which its middle is looked for
_PULL = 0.03  # room that is given up for each pixel nearer the centre


@dataclass(frozen=True, slots=True)
class Middle:
    """A pixel that shows a thing; room: how far it is from what is not that thing [px]."""

    column: int
    row: int
    room: float


def middles(items: Ints, wanted: Collection[int] | None = None, least: int = 1) -> dict[int, Middle]:
    """The middle of each wanted item, by default of all, that at least so many pixels (h, w) show; most room first."""
    from scipy.ndimage import find_objects

    counts = pixels_of(items)
    boxes: Any = find_objects((items + 1).astype(np.int32))
    found = {
        int(k): _middle(items[boxes[k]], int(k), boxes[k])
        for k in np.nonzero(counts >= least)[0]
        if wanted is None or k in wanted
    }
    return dict(sorted(found.items(), key=lambda row: (-row[1].room, row[0])))


def pixels_of(items: Ints, count: int = 0) -> Ints:
    """How many pixels (h, w) show each item, for `count` items at least; -1 is none."""
    counts: Ints = np.bincount(items.ravel() + 1, minlength=count + 1)[1:]
    return counts


def _middle(part: Ints, item: int, where: tuple[slice, slice]) -> Middle:
    """The middle of an item that a part of a picture shows, which lies at `where`."""
    from scipy.ndimage import distance_transform_edt

    steps = [max(1, -(-n // _CELLS)) for n in part.shape]
    cells = part[:: steps[0], :: steps[1]] == item
    if not cells.any():  # too thin
        steps, cells = [1, 1], part == item
    room = distance_transform_edt(np.pad(cells, 1), sampling=steps)[1:-1, 1:-1]
    rows, columns = (places * step for places, step in zip(np.nonzero(cells), steps, strict=True))
    aside = np.hypot(rows - rows.mean(), columns - columns.mean())
    depth = room[cells]
    best = int(np.argmax(depth - _PULL * aside))
    return Middle(where[1].start + int(columns[best]), where[0].start + int(rows[best]), float(depth[best]))
