"""The names of hulls on a picture; where they do not fit, numbers, and a legend below that says which name each is."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.rendering.annotation import FAINT, INK, count_pixels, font, text_scale, text_width
from meshforge.rendering.colors import hexadecimal
from meshforge.rendering.placement import LEAST_PIXELS, NumberPlace, TextSize, draw_texts, place_numbers

if TYPE_CHECKING:
    from PIL.Image import Image

_MOST_COVERED = 0.3  # of the area of names that lead to their hulls, at most so much may lie on hulls
_MOST_NAMES = 16  # names on one drawing, beyond which it is hard to read
_NUMBERS_NOTE = "In commands a hull is its name or its number, as #0."

DrawnView = tuple[Ints, tuple[int, int]]
"""What the pixels (h, w) of a drawing show, and where its corner lies on the picture [px]."""


def write_hull_names(image: Image, views: Sequence[DrawnView], names: Sequence[str], colors: Floats) -> Image:
    """Return the picture with the names of hulls on it, or with their numbers, which count from 0 in the order of
    `names`.

    Numbers stand there where the names would not fit; a legend below the picture then has the name of each. Hulls that
    are hidden, or too small for a text, in all views are listed there in any case. colors: (n, 3), of the hulls.
    """
    from PIL import ImageDraw  # lazy: 0.01 s, only pictures need it

    draw, texts = ImageDraw.Draw(image), dict(enumerate(names))
    placed = [place_texts(items, texts, image.size) for items, _ in views]
    is_named = all(_is_readable(places, items) for places, (items, _) in zip(placed, views, strict=True))
    if not is_named:
        texts = {k: str(k) for k in texts}
        placed = [place_texts(items, texts, image.size) for items, _ in views]
    for places, (_, corner) in zip(placed, views, strict=True):
        draw_texts(draw, places, texts, colors, corner)
    shown = {place.item for places in placed for place in places}
    hidden = [k for k in texts if k not in shown]
    listed = hidden if is_named else list(texts)
    if not listed:
        return image
    notes = [] if is_named else [_NUMBERS_NOTE]
    notes += ["Hidden or too small here:" if is_named else "Grey: hidden or too small here."] if hidden else []
    return _add_legend(image, " ".join(notes), {k: f"#{k}  {names[k]}" for k in listed}, colors, set(hidden))


def place_texts(items: Ints, texts: Mapping[int, str], size: tuple[int, int]) -> list[NumberPlace]:
    """Return where texts go in a drawing, none over another; items: (h, w), what each pixel shows; size: of the
    picture."""
    u = text_scale(size)
    heights = [max(11, round(share * u)) for share in (14, 11)]
    sizes: dict[int, dict[int, TextSize]] = {
        item: {high: (text_width(text, high) + 0.6 * high, 1.25 * high) for high in heights}
        for item, text in texts.items()
    }
    return place_numbers(items, sizes)


def _is_readable(places: Sequence[NumberPlace], items: Ints) -> bool:
    """Whether each hull that is seen has its name, and the names leave the drawing to be seen."""
    seen = int((count_pixels(items) >= LEAST_PIXELS).sum())
    if len(places) < seen or len(places) > _MOST_NAMES:
        return False
    boxes = [[round(side) for side in place.box] for place in places if place.spot]
    covered = [float((items[top:bottom, left:right] >= 0).mean()) for left, top, right, bottom in boxes]
    return not covered or float(np.mean(covered)) <= _MOST_COVERED


def _add_legend(image: Image, note: str, entries: Mapping[int, str], colors: Floats, hidden: Collection[int]) -> Image:
    """The picture, made higher by a list of hulls in columns, those that are hidden in grey."""
    from PIL import Image as Images  # lazy: 0.01 s, only pictures need it
    from PIL import ImageDraw  # lazy: 0.01 s, only pictures need it

    u = text_scale(image.size)
    small, edge = max(11, round(13 * u)), round(16 * u)
    row, box = round(1.5 * small), round(0.85 * small)
    wide = max(text_width(text, small) for text in entries.values()) + 2.8 * small
    columns = max(1, min(len(entries), int((image.width - 2 * edge + small) // wide)))
    rows = -(-len(entries) // columns)
    below: Any = image.getpixel((0, image.height - 1))
    paper = Images.new(image.mode, (image.width, image.height + (rows + 1) * row + edge), below)
    paper.paste(image, (0, 0))
    draw = ImageDraw.Draw(paper)
    draw.text((edge, image.height + row / 2), note, FAINT, font(small), "lm")
    for place, (item, text) in enumerate(entries.items()):
        x, y = edge + place // rows * wide, image.height + (place % rows + 1.5) * row
        fill = None if item in hidden else hexadecimal(colors[item])
        draw.rounded_rectangle(
            (x, y - box / 2, x + box, y + box / 2), box // 4, fill, hexadecimal(colors[item] * 0.72), 1
        )
        draw.text((x + 1.5 * small, y), text, FAINT if item in hidden else INK, font(small), "lm")
    return paper
