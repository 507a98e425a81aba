"""What is written about a drawing: its name, which way is up, the numbers, and the colour of each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from meshforge.geometry import Floats
from meshforge.views.camera import Camera
from meshforge.views.labelling.placing import Place, Size
from meshforge.views.palette import hexadecimal
from meshforge.views.text import INK, font, shortened, width_of

_FLAT = 0.3  # up is drawn as a ring when it is seen this short, as seen along its axis


def type_sizes(texts: Mapping[int, str], size: int) -> dict[int, dict[int, Size]]:
    """The room that each number takes, for the two heights [px] it may be written in."""
    share = 0.0265 if len(texts) <= 45 else 0.0225 if len(texts) <= 90 else 0.019
    heights = [max(11, round(part * share * size)) for part in (1.0, 0.8)]
    return {
        item: {high: (width_of(text, high) + 0.5 * high, 1.1 * high) for high in heights}
        for item, text in texts.items()
    }


def head_height(size: int) -> int:
    """The height of the line along the top [px]."""
    return round(0.045 * size)


def draw_head(draw: Any, size: int, name: str, camera: Camera, upright: Floats) -> None:
    """Writes along the top what is seen, and draws at its end where up is."""
    middle = head_height(size) / 2
    big, small = max(11, round(0.021 * size)), max(10, round(0.017 * size))
    _draw_up(draw, camera, upright, (size - 0.03 * size, middle), size, small)
    draw.text((round(0.016 * size), middle), shortened(name, big, 0.72 * size), INK, font(big), "lm")


def _draw_up(draw: Any, camera: Camera, upright: Floats, at: tuple[float, float], size: int, small: int) -> None:
    x, y = at
    wide, arm = max(2, round(0.0028 * size)), 0.009 * size
    if camera.axes[1] @ upright > _FLAT:
        high = 0.016 * size
        draw.line((x, y + high, x, y - high + arm), INK, wide)
        draw.polygon([(x, y - high - arm / 2), (x - arm * 0.75, y - high + arm), (x + arm * 0.75, y - high + arm)], INK)
        draw.text((x - 1.6 * arm, y), "up", INK, font(small), "rm")
        return
    draw.ellipse((x - arm, y - arm, x + arm, y + arm), None, INK, wide)
    towards = bool(camera.axes[2] @ upright > 0)
    if towards:
        draw.ellipse((x - arm / 3, y - arm / 3, x + arm / 3, y + arm / 3), INK)
    else:
        for turn in (0.6, -0.6):
            draw.line((x - 0.6 * arm, y - turn * arm, x + 0.6 * arm, y + turn * arm), INK, wide)
    draw.text((x - 1.6 * arm, y), "up, towards you" if towards else "up, away from you", INK, font(small), "rm")


def draw_numbers(draw: Any, places: Sequence[Place], texts: Mapping[int, str], colors: Floats, top: int) -> None:
    """Writes numbers at their places in a drawing that lies `top` pixels below the upper edge; colors: (n, 3)."""
    for place in places:
        if place.spot:
            x, y = place.spot[0], place.spot[1] + top
            middle = place.center[0], place.center[1] + top
            draw.line((x, y, *middle), "white", 5)
            draw.line((x, y, *middle), INK, 2)
    for place in places:
        left, above, right, below = place.box
        middle = place.center[0], place.center[1] + top
        text, type_ = texts[place.item], font(place.height)
        if place.spot:
            x, y, dot = place.spot[0], place.spot[1] + top, max(3, place.height // 7)
            draw.ellipse((x - dot, y - dot, x + dot, y + dot), INK, "white", 1)
            edge = hexadecimal(colors[place.item] * 0.8)
            draw.rounded_rectangle((left, above + top, right, below + top), place.height // 4, "white", edge, 2)
            draw.text(middle, text, INK, type_, "mm")
        else:
            draw.text(middle, text, INK, type_, "mm", stroke_width=max(2, place.height // 6), stroke_fill="white")


class Key:
    """The legend: each number beside its colour, in rows along the bottom, with room for all of `texts`."""

    def __init__(self, texts: Mapping[int, str], size: int) -> None:
        self._texts, self._size = texts, size
        share = 0.017 if len(texts) <= 60 else 0.0135
        self._small = max(10, round(share * size))
        widest = max((width_of(text, self._small) for text in texts.values()), default=0)
        self._cell = widest + 1.9 * self._small
        self._columns = max(1, int(0.97 * size // self._cell))
        self._row = 1.3 * self._small
        rows = -(-len(texts) // self._columns)
        self.height = round(rows * self._row + 0.01 * size)

    def draw(self, draw: Any, items: Sequence[int], colors: Floats) -> None:
        """Lists some of the hulls."""
        box = 0.75 * self._small
        for k, item in enumerate(items):
            x = 0.015 * self._size + k % self._columns * self._cell
            y = self._size - self.height + (k // self._columns + 0.5) * self._row
            draw.rectangle(
                (x, y - box / 2, x + box, y + box / 2), hexadecimal(colors[item]), hexadecimal(colors[item] * 0.6)
            )
            draw.text((x + 1.4 * box, y), self._texts[item], INK, font(self._small), "lm")
