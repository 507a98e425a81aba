"""Numbers on hulls, each where most of its hull is seen around it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from meshforge.geometry import Ints
from meshforge.views.outline import along
from meshforge.views.text import INK, font, unit

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""
_PULL = 0.03  # room that is given up for each pixel nearer the middle
_LEAST = 10  # pixels of a hull that must be seen for it to be marked


def draw_marks(
    draw: Any, items: Ints, marks: Mapping[int, str], corner: tuple[int, int], size: tuple[int, int]
) -> None:
    """Writes the marks of items on a picture; items: (h, w), what each pixel shows; corner: where that part lies.

    Items with the most room come first; a mark that would cover another is written smaller, or left out.
    """
    taken: list[Box] = []
    for item, (row, column) in places(items).items():
        for height in (round(14 * unit(size)), round(10 * unit(size))) if item in marks else ():
            at, height = (corner[0] + column, corner[1] + row), max(8, height)
            halo = max(1, height // 5)
            box = draw.textbbox(at, marks[item], font(height), "mm", stroke_width=halo)
            if not any(_overlap(box, other) for other in taken):
                draw.text(at, marks[item], INK, font(height), "mm", stroke_width=halo, stroke_fill="white")
                taken.append(box)
                break


def _overlap(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def places(items: Ints) -> dict[int, tuple[int, int]]:
    """Row and column of the pixel of each item that is farthest from any other, the middle one of several such.

    Those with the most room come first. Items seen too little are left out.
    """
    from scipy.ndimage import center_of_mass, distance_transform_edt, maximum_position

    counts = np.bincount(items[items >= 0].ravel())
    seen = np.nonzero(counts >= _LEAST)[0]
    if len(seen) == 0:
        return {}
    depth = distance_transform_edt(_inner(items))
    middles = np.zeros((len(counts), 2))
    middles[seen] = center_of_mass(np.ones(items.shape), items, seen)
    off_center = np.hypot(*(np.indices(items.shape) - np.moveaxis(middles[items], 2, 0)))
    spots = maximum_position(depth - _PULL * off_center, items, seen)
    found = [(int(k), (int(r), int(c))) for k, (r, c) in zip(seen, spots, strict=True)]
    return dict(sorted(found, key=lambda place: (-depth[place[1]], place[0])))


def _inner(items: Ints) -> Any:
    """The pixels (h, w) whose neighbours all show the same item; none at the picture's edge."""
    inner = np.ones(items.shape, dtype=bool)
    inner[[0, -1]] = False
    inner[:, [0, -1]] = False
    for axis in (0, 1):
        a, b = along(axis)
        differ = items[a] != items[b]
        inner[a] &= ~differ
        inner[b] &= ~differ
    return inner
