"""A small picture of the whole mesh in the corner of one from close up, that tells where that is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from meshforge.geometry import Aabb, Ints
from meshforge.views.camera import View
from meshforge.views.labelling.arrangement import Arrangement
from meshforge.views.labelling.flat import drawn_over, framed, ink, shaded
from meshforge.views.palette import PALE, rgb
from meshforge.views.text import INK

if TYPE_CHECKING:
    from PIL.Image import Image

_SHARE = 0.24  # of a picture's side
_LEAST = 9  # pixels along the frame that marks the place


def inset(arrangement: Arrangement, view: View, size: int) -> Image:
    """The whole mesh, pale, the hulls that an arrangement is about shining through, and a frame about what it shows.

    size: pixels along the sides of the picture that it is put on.
    """
    from PIL import ImageDraw

    sitter, side = arrangement.sitter, round(_SHARE * size)
    whole, about = Arrangement.in_place(sitter), Arrangement(sitter, arrangement.close, sitter.points)
    camera = whole.camera(view, (side, side))
    hits, shining = whole.cast_solid(camera), about.cast_solid(camera)
    page = shaded(hits, np.tile(rgb(PALE), (len(whole.solid), 1)), whole.view_frame, camera)
    drawn_over(page, ink(hits, 2), 0.6)
    lit = shaded(shining, sitter.colors[list(arrangement.close)], whole.view_frame, camera)
    page[shining.item >= 0] = lit[shining.item >= 0]
    image = framed(page, side, 0)
    draw = ImageDraw.Draw(image)
    seen = camera.to_pixels(whole.view_frame.to_unit(Aabb.of_points(arrangement.frame).corners))
    low, high = seen.min(axis=0), seen.max(axis=0)
    grown = np.maximum(_LEAST - (high - low), 0) / 2
    draw.rectangle([*(low - grown).tolist(), *(high + grown).tolist()], None, INK, 2)
    draw.rectangle((0, 0, side - 1, side - 1), None, INK, 1)
    return image


def free_corner(items: Ints, side: int) -> tuple[int, int]:
    """Column and row where a square of `side` pixels in a corner of a picture (h, w) covers fewest hulls."""
    height, width = items.shape
    corners = [(column, row) for row in (0, height - side) for column in (width - side, 0)]
    return min(corners, key=lambda at: int((items[at[1] : at[1] + side, at[0] : at[0] + side] >= 0).sum()))
