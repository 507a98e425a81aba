"""Plain drawings, quick to make: lit surfaces and dark lines on white paper, without corners and shadows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats
from meshforge.views.camera import Camera
from meshforge.views.light import lit
from meshforge.views.outline import BORDER, CREASE, Lines, along, lines
from meshforge.views.stage import Hits, Stage

if TYPE_CHECKING:
    from PIL.Image import Image

Page = npt.NDArray[np.uint8]
"""Pixels (h, w, 4): red, green, blue, and one to spare."""
_INK = np.array([26, 31, 41], np.float32)
_STRENGTH = np.array([0, 70, 215, 235], np.uint16)  # of no line, a crease, a border, a silhouette; of 255


def shaded(hits: Hits, colors: Floats, stage: Stage, camera: Camera) -> Page:
    """What the pixels show; colors: (k, 3), sRGB in 0..1, of the scene's things."""
    scene = hits.scene
    height, width = hits.item.shape
    page = np.full((height, width), 0xFFFFFFFF, np.uint32)
    table = np.full((len(scene.item) + 1, 4), 255, np.uint8)
    if len(scene.item):
        bright = lit(np.asarray(colors, np.float64)[scene.item], scene.normals, camera, stage.upright)
        table[:-1, :3] = np.rint(bright * 255)
    page[hits.window] = table.view(np.uint32).ravel().take(hits.triangle[hits.window])
    return page.view(np.uint8).reshape(height, width, 4)


def ink(hits: Hits, width: int, steps: Any = None, smooth: Any = None) -> Lines:
    """How much of each pixel (h, w) the lines of a drawing cover, of 255; lines are `width` pixels wide and soft.

    steps: pixels (h, w) that are on a line besides; smooth: which things (k,) show no creases.
    """
    drawn = lines(hits, width)[hits.window]
    if smooth is not None:
        drawn[(drawn == CREASE) & np.append(smooth, False)[hits.item[hits.window]]] = 0
    if steps is not None:
        drawn[steps[hits.window] & (drawn < BORDER)] = BORDER
    share: Any = _STRENGTH[drawn]
    for axis in (0, 1):
        mixed = 2 * share
        here, there = along(axis)
        mixed[here] += share[there]
        mixed[there] += share[here]
        share = mixed >> 2
    whole = np.zeros(hits.item.shape, np.uint8)
    whole[hits.window] = share
    return whole


def drawn_over(page: Page, share: Lines, strength: float = 1.0) -> None:
    """Lays ink over a page, as much of it as `share` (h, w) of 255 says."""
    at = np.flatnonzero(share)
    flat: Any = page.reshape(-1, 4)
    part = share.ravel()[at, None] * np.float32(strength / 255)
    below = flat[at, :3]
    flat[at, :3] = np.rint(below + (_INK - below) * part)


def framed(page: Page, size: int, top: int) -> Image:
    """A page as a square picture, `top` pixels below its upper edge."""
    from PIL import Image

    whole = np.full((size, size, 4), 255, np.uint8)
    whole[top : top + len(page)] = page
    return Image.frombuffer("RGBX", (size, size), whole, "raw", "RGBX", 0, 1).convert("RGB")
