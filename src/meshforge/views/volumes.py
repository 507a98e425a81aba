"""Pictures that mark parts of space in colours, with the hulls around them as pale shells."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from meshforge.asset import Surface
from meshforge.symbolic import SymbolicMesh
from meshforge.views.camera import Up, View
from meshforge.views.canvas import Canvas
from meshforge.views.coloring import Coloring, Entry
from meshforge.views.palette import UNLABELLED, rgb
from meshforge.views.roundness import skin
from meshforge.views.stage import Layer
from meshforge.views.subject import Subject, draw, framed, skins_of, up_axis

if TYPE_CHECKING:
    from PIL.Image import Image

Marked = tuple[str, str, Surface]
"""What a part of space is called, its colour `#rrggbb`, and its surface."""


def volumes(
    mesh: SymbolicMesh,
    marked: Sequence[Marked],
    *,
    view: View = "iso",
    size: tuple[int, int] = (800, 600),
    title: str | None = None,
    caption: str | None = None,
    background: str | None = "light",
    up: Up | None = None,
) -> Image:
    """The marked parts of space, solid, within the hulls of a mesh as grey shells; of one size with every view."""
    parts, shells = [skin(surface) for _, _, surface in marked], skins_of(mesh.hulls)
    colors = np.array([rgb(color) for _, color, _ in marked]).reshape(-1, 3)
    names = dict.fromkeys((color, name) for name, color, _ in marked)
    legend = tuple(Entry(color, name) for color, name in names)
    pale = Layer(shells, np.tile(rgb(UNLABELLED), (len(shells), 1)), before=0.28, behind=0.28)
    what = Subject((Layer(parts, colors), pale), framed(parts, shells), up_axis(mesh, up))
    canvas = Canvas(size, background, title, caption, Coloring(colors, legend))
    left, top, right, bottom = canvas.room
    canvas.paste_drawing(draw(what, None, view, (right - left, bottom - top)).pixels, (left, top))
    return canvas.image
