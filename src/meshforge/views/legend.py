"""The words around a picture: title and caption above it, the legend below."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from meshforge.views.coloring import Coloring, Entry
from meshforge.views.palette import confidence_color, hexadecimal, rgb
from meshforge.views.text import FAINT, INK, font, shortened, unit, width_of

_ROWS = 3  # of a legend at most; what does not fit is counted
Chip = tuple[Entry, float, int]
"""An entry, where it begins in its row [px], and its row."""


def heading(draw: Any, size: tuple[int, int], title: str | None, caption: str | None) -> int:
    """Writes title (left) and caption (right, or left alone) along the top; returns the height it takes."""
    if not title and not caption:
        return 0
    u = unit(size)
    edge, large, small = round(16 * u), round(17 * u), round(13 * u)
    base = round(12 * u) + large
    room: float = size[0] - 2 * edge
    if title:
        caption_room = width_of(caption, small) + 2 * edge if caption else 0
        text = shortened(title, large, max(room - caption_room, room / 3))
        draw.text((edge, base), text, fill=INK, font=font(large), anchor="ls")
        room -= width_of(text, large) + edge
    if caption:
        text = shortened(caption, small, room)
        at, anchor = (size[0] - edge, "rs") if title else (edge, "ls")
        draw.text((at, base), text, fill=FAINT, font=font(small), anchor=anchor)
    return base + round(6 * u)


def legend_height(coloring: Coloring, size: tuple[int, int]) -> int:
    """The height that the legend takes at the bottom of a picture."""
    rows = 1 + max((row for _, _, row in _chips(coloring, size)), default=-1)
    u = unit(size)
    return round(rows * 24 * u + 12 * u) if rows or coloring.gradient else 0


def draw_legend(draw: Any, size: tuple[int, int], coloring: Coloring) -> None:
    """Draws colours with their names and counts along the bottom."""
    u = unit(size)
    small, box = round(13 * u), round(12 * u)
    top = size[1] - legend_height(coloring, size) + round(6 * u)
    if coloring.gradient:
        _draw_scale(draw, size, top)
    for entry, x, row in _chips(coloring, size):
        y = top + row * 24 * u
        if entry.color:
            draw.rounded_rectangle(
                (x, y, x + box, y + box), round(3 * u), fill=entry.color, outline=_darker(entry.color)
            )
        name = shortened(entry.name, small, size[0] / 3)
        after = x + (box + 6 * u if entry.color else 0)
        middle = y + box / 2
        draw.text((after, middle), name, fill=INK, font=font(small), anchor="lm")
        if entry.count is not None:
            beside = after + width_of(name + " ", small)
            draw.text((beside, middle), str(entry.count), fill=FAINT, font=font(small), anchor="lm")


def _chips(coloring: Coloring, size: tuple[int, int]) -> list[Chip]:
    """The entries laid out in rows, as many as fit."""
    u = unit(size)
    edge, right = 16 * u, size[0] - 16 * u
    x, row = edge + (_scale_width(size) if coloring.gradient else 0), 0
    placed: list[Chip] = []
    for k, entry in enumerate(coloring.legend):
        wide = _chip_width(entry, size)
        if x + wide > right and x > edge:
            x, row = edge, row + 1
        left = len(coloring.legend) - k
        if row == _ROWS:
            return _counted(placed, left)
        placed.append((entry, x, row))
        x += wide + 18 * u
    return placed


def _counted(placed: Sequence[Chip], left: int) -> list[Chip]:
    """The last entry replaced by the number of those left out."""
    _, x, row = placed[-1]
    return [*placed[:-1], (Entry("", f"and {left + 1} more"), x, row)]


def _chip_width(entry: Entry, size: tuple[int, int]) -> float:
    u = unit(size)
    small = round(13 * u)
    count = "" if entry.count is None else f" {entry.count}"
    return 18 * u + width_of(shortened(entry.name, small, size[0] / 3) + count, small)


def _scale_width(size: tuple[int, int]) -> float:
    return 300 * unit(size)


def _draw_scale(draw: Any, size: tuple[int, int], top: int) -> None:
    """The colours of confidence from 0 to 1."""
    u = unit(size)
    small, length, high = round(13 * u), round(150 * u), round(12 * u)
    x = round(16 * u)
    draw.text((x, top + high / 2), "unsure", fill=FAINT, font=font(small), anchor="lm")
    x += round(52 * u)
    for k in range(length):
        color = hexadecimal(confidence_color(k / max(length - 1, 1)))
        draw.line((x + k, top, x + k, top + high), fill=color)
    draw.text((x + length + 8 * u, top + high / 2), "certain", fill=FAINT, font=font(small), anchor="lm")


def _darker(color: str) -> str:
    return hexadecimal(rgb(color) * 0.72)
