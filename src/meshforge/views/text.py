"""Words in pictures, in the font that comes with Pillow; it has Latin, not arrows or other scripts."""

from __future__ import annotations

from functools import cache
from typing import Any

INK = "#1F2530"
FAINT = "#6B7482"


@cache
def font(size: int) -> Any:
    """The scalable default font at a size in pixels."""
    from PIL import ImageFont

    return ImageFont.load_default(size)


def unit(size: tuple[int, int]) -> float:
    """How large words and gaps are in a picture of this size; 1 at 800 by 600."""
    width, height = size
    return min(max(min(width / 800, height / 600), 0.62), 4.0)


def width_of(text: str, size: int) -> float:
    """The width of one line of text in pixels."""
    return float(font(size).getlength(text))


def shortened(text: str, size: int, room: float) -> str:
    """The text, its end replaced by an ellipsis where it is wider than `room` pixels."""
    text = " ".join(text.split())
    if width_of(text, size) <= room:
        return text
    while text and width_of(text + "…", size) > room:
        text = text[:-1]
    return text + "…"
