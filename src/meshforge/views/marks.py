"""Numbers on hulls, each where most of its hull is seen around it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from meshforge.geometry import Ints
from meshforge.views.outline import along
from meshforge.views.text import INK, font, unit

_LEAST = 10  # pixels of a hull that must be seen for it to be marked


def draw_marks(
    draw: Any, items: Ints, marks: Mapping[int, str], corner: tuple[int, int], size: tuple[int, int]
) -> None:
    """Writes the marks of items on a picture; items: (h, w), what each pixel shows; corner: where that part lies."""
    height = max(9, round(14 * unit(size)))
    halo = max(1, height // 5)
    for item, (row, column) in places(items).items():
        if item in marks:
            at = (corner[0] + column, corner[1] + row)
            draw.text(at, marks[item], INK, font(height), "mm", stroke_width=halo, stroke_fill="white")


def places(items: Ints) -> dict[int, tuple[int, int]]:
    """Row and column of the pixel of each item that is farthest from any other; items seen too little are left out."""
    from scipy.ndimage import distance_transform_edt, maximum_position

    counts = np.bincount(items[items >= 0].ravel())
    seen = np.nonzero(counts >= _LEAST)[0]
    if len(seen) == 0:
        return {}
    depth = distance_transform_edt(_inner(items))
    found = maximum_position(depth, items, seen)
    return {int(k): (int(r), int(c)) for k, (r, c) in zip(seen, found, strict=True)}


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
