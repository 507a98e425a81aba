"""Words and numbers on pictures: fonts, title, legend, and the place on each hull where its number stands."""

from collections.abc import Collection
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from meshforge.geometry import Ints
from meshforge.rendering.colors import HullColors, LegendEntry, hexadecimal, rgb

INK = "#1F2530"
FAINT = "#6B7482"

_ROWS = 3  # of a legend at most; what does not fit is counted
Chip = tuple[LegendEntry, float, int]
"""An entry, where it begins in its row [px], and its row."""

_CELLS = 64  # along each side of a thing, in which its middle is looked for
_PULL = 0.03  # room that is given up for each pixel nearer the centre

PixelBox = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""


@cache
def font(size: int) -> Any:
    """Return the scalable default font at a size in pixels."""
    from PIL import ImageFont  # lazy: 0.03 s, only words on pictures need it

    return ImageFont.load_default(size)


def text_scale(size: tuple[int, int]) -> float:
    """Return how large words and gaps are in a picture of this size; 1 at 800 by 600."""
    width, height = size
    return min(max(min(width / 800, height / 600), 0.62), 4.0)


def text_width(text: str, size: int) -> float:
    """Return the width of one line of text in pixels."""
    return float(font(size).getlength(text))


def shorten(text: str, size: int, room: float) -> str:
    """Return the text, its end replaced by an ellipsis where it is wider than `room` pixels."""
    text = " ".join(text.split())
    if text_width(text, size) <= room:
        return text
    while text and text_width(text + "…", size) > room:
        text = text[:-1]
    return text + "…"


def draw_heading(draw: Any, size: tuple[int, int], title: str | None, caption: str | None) -> int:
    """Write title (left) and caption (right, or left alone) along the top; returns the height it takes."""
    if not title and not caption:
        return 0
    u = text_scale(size)
    edge, large, small = round(16 * u), round(17 * u), round(13 * u)
    base = round(12 * u) + large
    room: float = size[0] - 2 * edge
    if title:
        caption_room = text_width(caption, small) + 2 * edge if caption else 0
        text = shorten(title, large, max(room - caption_room, room / 3))
        draw.text((edge, base), text, fill=INK, font=font(large), anchor="ls")
        room -= text_width(text, large) + edge
    if caption:
        text = shorten(caption, small, room)
        at, anchor = (size[0] - edge, "rs") if title else (edge, "ls")
        draw.text((at, base), text, fill=FAINT, font=font(small), anchor=anchor)
    return base + round(6 * u)


def legend_height(coloring: HullColors, size: tuple[int, int]) -> int:
    """Return the height that the legend takes at the bottom of a picture."""
    rows = 1 + max((row for _, _, row in _lay_out_entries(coloring, size)), default=-1)
    u = text_scale(size)
    return round(rows * 24 * u + 12 * u) if rows else 0


def draw_legend(draw: Any, size: tuple[int, int], coloring: HullColors) -> None:
    """Draw colours with their names and counts along the bottom."""
    u = text_scale(size)
    small, box = round(13 * u), round(12 * u)
    top = size[1] - legend_height(coloring, size) + round(6 * u)
    for entry, x, row in _lay_out_entries(coloring, size):
        y = top + row * 24 * u
        if entry.color:
            outline = hexadecimal(rgb(entry.color) * 0.72)
            draw.rounded_rectangle((x, y, x + box, y + box), round(3 * u), fill=entry.color, outline=outline)
        name = shorten(entry.name, small, size[0] / 3)
        after = x + (box + 6 * u if entry.color else 0)
        middle = y + box / 2
        draw.text((after, middle), name, fill=INK, font=font(small), anchor="lm")
        if entry.count is not None:
            beside = after + text_width(name + " ", small)
            draw.text((beside, middle), str(entry.count), fill=FAINT, font=font(small), anchor="lm")


def _lay_out_entries(coloring: HullColors, size: tuple[int, int]) -> list[Chip]:
    """The entries laid out in rows, as many as fit; where some do not, the last place has the number of the rest."""
    u = text_scale(size)
    edge, right, small = 16 * u, size[0] - 16 * u, round(13 * u)
    x, row = edge, 0
    placed: list[Chip] = []
    for k, entry in enumerate(coloring.legend):
        count = "" if entry.count is None else f" {entry.count}"
        wide = 18 * u + text_width(shorten(entry.name, small, size[0] / 3) + count, small)
        if x + wide > right and x > edge:
            x, row = edge, row + 1
        if row == _ROWS:
            _, last, row = placed[-1]
            return [*placed[:-1], (LegendEntry("", f"and {len(coloring.legend) - k + 1} more"), last, row)]
        placed.append((entry, x, row))
        x += wide + 18 * u
    return placed


@dataclass(frozen=True, slots=True)
class LabelAnchor:
    """A pixel that shows a thing; room: how far it is from what is not that thing [px]."""

    column: int
    row: int
    room: float


def find_label_anchors(items: Ints, wanted: Collection[int] | None = None, least: int = 1) -> dict[int, LabelAnchor]:
    """Return the middle of each wanted item, or of all, that so many pixels (h, w) or more show; most room first."""
    from scipy.ndimage import find_objects  # lazy: 0.3 s, only pictures need it

    counts = count_pixels(items)
    boxes: Any = find_objects((items + 1).astype(np.int32))
    found = {
        int(k): _find_anchor(items[boxes[k]], int(k), boxes[k])
        for k in np.nonzero(counts >= least)[0]
        if wanted is None or k in wanted
    }
    return dict(sorted(found.items(), key=lambda row: (-row[1].room, row[0])))


def count_pixels(items: Ints, count: int = 0) -> Ints:
    """Return how many pixels (h, w) show each item, for `count` items at least; -1 is none."""
    return np.bincount(items.ravel() + 1, minlength=count + 1)[1:]


def _find_anchor(part: Ints, item: int, where: tuple[slice, slice]) -> LabelAnchor:
    """The middle of an item that a part of a picture shows, which lies at `where`."""
    from scipy.ndimage import distance_transform_edt  # lazy: 0.3 s, only pictures need it

    steps = [max(1, -(-n // _CELLS)) for n in part.shape]
    cells = part[:: steps[0], :: steps[1]] == item
    if not cells.any():  # too thin
        steps, cells = [1, 1], part == item
    room = distance_transform_edt(np.pad(cells, 1), sampling=steps)[1:-1, 1:-1]
    rows, columns = (places * step for places, step in zip(np.nonzero(cells), steps, strict=True))
    aside = np.hypot(rows - rows.mean(), columns - columns.mean())
    depth = room[cells]
    best = int(np.argmax(depth - _PULL * aside))
    return LabelAnchor(where[1].start + int(columns[best]), where[0].start + int(rows[best]), float(depth[best]))
