"""A page: a plain, quick drawing of lit surfaces and dark lines, with the name, the numbers and the legend around
it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats
from meshforge.rendering.annotation import INK, font, shorten, text_width
from meshforge.rendering.camera import Camera
from meshforge.rendering.colors import hexadecimal
from meshforge.rendering.light import shade
from meshforge.rendering.paint import BORDER, CREASE, LineStrengths, trace_lines
from meshforge.rendering.placement import TextSize
from meshforge.rendering.raycast import RayHits, ViewFrame, neighbour_slices

if TYPE_CHECKING:
    from PIL.Image import Image


PagePixels = npt.NDArray[np.uint8]
"""Pixels (h, w, 4): red, green, blue, and one to spare."""
_INK = np.array([26, 31, 41], np.float32)
_STRENGTH = np.array([0, 70, 215, 235], np.uint16)  # of no line, a crease, a border, a silhouette; of 255

_FLAT = 0.3  # up is drawn as a ring when it is seen this short, as seen along its axis


def draw_surfaces(hits: RayHits, colors: Floats, view_frame: ViewFrame, camera: Camera) -> PagePixels:
    """Return what the pixels show; colors: (k, 3), sRGB in 0..1, of the scene's things."""
    scene = hits.scene
    height, width = hits.item.shape
    page = np.full((height, width), 0xFFFFFFFF, np.uint32)
    table = np.full((len(scene.item) + 1, 4), 255, np.uint8)
    if len(scene.item):
        bright = shade(np.asarray(colors, np.float64)[scene.item], scene.normals, camera, view_frame.upright)
        table[:-1, :3] = np.rint(bright * 255)
    page[hits.window] = table.view(np.uint32).ravel().take(hits.triangle[hits.window])
    return page.view(np.uint8).reshape(height, width, 4)


def trace_ink(hits: RayHits, width: int, steps: Any = None, smooth: Any = None) -> LineStrengths:
    """Return how much of each pixel (h, w) the lines of a drawing cover, of 255; lines are `width` pixels wide and
    soft.

    steps: pixels (h, w) that are on a line besides; smooth: which things (k,) show no creases.
    """
    drawn = trace_lines(hits, width)[hits.window]
    if smooth is not None:
        drawn[(drawn == CREASE) & np.append(smooth, False)[hits.item[hits.window]]] = 0
    if steps is not None:
        drawn[steps[hits.window] & (drawn < BORDER)] = BORDER
    share: Any = _STRENGTH[drawn]
    for axis in (0, 1):
        mixed = 2 * share
        here, there = neighbour_slices(axis)
        mixed[here] += share[there]
        mixed[there] += share[here]
        share = mixed >> 2
    whole = np.zeros(hits.item.shape, np.uint8)
    whole[hits.window] = share
    return whole


def lay_ink(page: PagePixels, share: LineStrengths, strength: float = 1.0) -> None:
    """Lay ink over a page, as much of it as `share` (h, w) of 255 says."""
    at = np.flatnonzero(share)
    flat: Any = page.reshape(-1, 4)
    part = share.ravel()[at, None] * np.float32(strength / 255)
    below = flat[at, :3]
    flat[at, :3] = np.rint(below + (_INK - below) * part)


def to_square_image(page: PagePixels, size: int, top: int) -> Image:
    """Return a page as a square picture, `top` pixels below its upper edge."""
    from PIL import Image  # lazy: 0.01 s, only pictures need it

    whole = np.full((size, size, 4), 255, np.uint8)
    whole[top : top + len(page)] = page
    return Image.frombuffer("RGBX", (size, size), whole, "raw", "RGBX", 0, 1).convert("RGB")


def number_sizes(texts: Mapping[int, str], size: int) -> dict[int, dict[int, TextSize]]:
    """Return the room that each number takes, for the two heights [px] it may be written in."""
    share = 0.0265 if len(texts) <= 45 else 0.0225 if len(texts) <= 90 else 0.019
    heights = [max(11, round(part * share * size)) for part in (1.0, 0.8)]
    return {
        item: {high: (text_width(text, high) + 0.5 * high, 1.1 * high) for high in heights}
        for item, text in texts.items()
    }


def head_height(size: int) -> int:
    """Return the height of the line along the top [px]."""
    return round(0.045 * size)


def draw_head(draw: Any, size: int, name: str, camera: Camera, upright: Floats) -> None:
    """Write along the top what is seen, and draws at its end where up is."""
    middle = head_height(size) / 2
    big, small = max(11, round(0.021 * size)), max(10, round(0.017 * size))
    _draw_up_arrow(draw, camera, upright, (size - 0.03 * size, middle), size, small)
    draw.text((round(0.016 * size), middle), shorten(name, big, 0.72 * size), INK, font(big), "lm")


def _draw_up_arrow(draw: Any, camera: Camera, upright: Floats, at: tuple[float, float], size: int, small: int) -> None:
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


class NumberLegend:
    """The legend: each number beside its colour, in rows along the bottom, with room for all of `texts`."""

    def __init__(self, texts: Mapping[int, str], size: int) -> None:
        self._texts, self._size = texts, size
        share = 0.017 if len(texts) <= 60 else 0.0135
        self._small = max(10, round(share * size))
        widest = max((text_width(text, self._small) for text in texts.values()), default=0)
        self._cell = widest + 1.9 * self._small
        self._columns = max(1, int(0.97 * size // self._cell))
        self._row = 1.3 * self._small
        rows = -(-len(texts) // self._columns)
        self.height = round(rows * self._row + 0.01 * size)

    def draw(self, draw: Any, items: Sequence[int], colors: Floats) -> None:
        """List some of the hulls."""
        box = 0.75 * self._small
        for k, item in enumerate(items):
            x = 0.015 * self._size + k % self._columns * self._cell
            y = self._size - self.height + (k // self._columns + 0.5) * self._row
            draw.rectangle(
                (x, y - box / 2, x + box, y + box / 2), hexadecimal(colors[item]), hexadecimal(colors[item] * 0.6)
            )
            draw.text((x + 1.4 * box, y), self._texts[item], INK, font(self._small), "lm")
