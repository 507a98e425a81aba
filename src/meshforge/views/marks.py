"""Numbers on hulls, each where most of its hull is seen around it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from meshforge.geometry import Ints
from meshforge.views.middles import middles
from meshforge.views.text import INK, font, unit

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""
_LEAST = 10  # pixels of a hull that must be seen for it to be marked


def draw_marks(
    draw: Any, items: Ints, marks: Mapping[int, str], corner: tuple[int, int], size: tuple[int, int]
) -> None:
    """Writes the marks of items on a picture; items: (h, w), what each pixel shows; corner: where that part lies.

    Items with the most room come first; a mark that would cover another is written smaller, or left out.
    """
    taken: list[Box] = []
    for item, middle in middles(items, marks, _LEAST).items():
        for height in (round(14 * unit(size)), round(10 * unit(size))):
            at, height = (corner[0] + middle.column, corner[1] + middle.row), max(8, height)
            halo = max(1, height // 5)
            box = draw.textbbox(at, marks[item], font(height), "mm", stroke_width=halo)
            if not any(_overlap(box, other) for other in taken):
                draw.text(at, marks[item], INK, font(height), "mm", stroke_width=halo, stroke_fill="white")
                taken.append(box)
                break


def _overlap(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
