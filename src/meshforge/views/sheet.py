"""Contact sheets: several pictures on one, with a line of text below each."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from meshforge.errors import UsageError
from meshforge.views.coloring import Coloring, Entry
from meshforge.views.legend import draw_legend, legend_height
from meshforge.views.text import INK, font, shortened, unit

if TYPE_CHECKING:
    from PIL.Image import Image

_PAPER = "#FFFFFF"
_FRAME = "#DDE2E8"
_NONE: Mapping[str, str] = MappingProxyType({})


def sheet(
    images: Sequence[Image], columns: int | None = None, titles: Sequence[str] = (), colors: Mapping[str, str] = _NONE
) -> Image:
    """Pictures in rows, `columns` in each (about as many as rows by default), centred in cells of equal size.

    titles: a line below each picture; none, or one each. colors: what the legend at the bottom says, a colour
    `#rrggbb` by its meaning. Raises UsageError where there is no picture.
    """
    from PIL import Image, ImageDraw

    if not images or (titles and len(titles) != len(images)):
        raise UsageError(f"a sheet of {len(images)} pictures with {len(titles)} titles cannot be made")
    columns = columns or math.ceil(math.sqrt(len(images)))
    cell = max(i.width for i in images), max(i.height for i in images)
    gap, words = _spacing(cell, bool(titles))
    rows = -(-len(images) // columns)
    size = gap + columns * (cell[0] + gap), gap + rows * (cell[1] + words + gap)
    legend = Coloring(np.zeros((0, 3)), tuple(Entry(color, name) for name, color in colors.items()))
    size = size[0], size[1] + legend_height(legend, size)
    paper = Image.new("RGB", size, _PAPER)
    draw = ImageDraw.Draw(paper)
    draw_legend(draw, size, legend)
    for k, image in enumerate(images):
        x, y = gap + k % columns * (cell[0] + gap), gap + k // columns * (cell[1] + words + gap)
        at = x + (cell[0] - image.width) // 2, y + (cell[1] - image.height) // 2
        paper.paste(image, at, image if image.mode == "RGBA" else None)
        draw.rectangle((x - 1, y - 1, x + cell[0], y + cell[1]), outline=_FRAME)
        if titles:
            small = round(15 * unit(cell))
            text = shortened(titles[k], small, cell[0])
            draw.text((x + cell[0] // 2, y + cell[1] + words // 2), text, INK, font(small), "mm")
    return paper


def _spacing(cell: tuple[int, int], titled: bool) -> tuple[int, int]:
    """The gap between cells, and the height of a title [px]."""
    u = unit(cell)
    return max(4, round(10 * u)), round(28 * u) if titled else 0
