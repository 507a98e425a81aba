"""Heat maps: surfaces in bands of colour by a length that is measured at every pixel."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from meshforge.asset import Surface
from meshforge.geometry import Floats, Ints, Shape
from meshforge.symbolic import SymbolicMesh
from meshforge.views.camera import Up, View
from meshforge.views.canvas import Canvas
from meshforge.views.coloring import Coloring, Entry
from meshforge.views.palette import UNLABELLED, rgb
from meshforge.views.roundness import skin
from meshforge.views.stage import Layer
from meshforge.views.subject import Subject, draw, framed, up_axis

if TYPE_CHECKING:
    from PIL.Image import Image

BANDS = ("#E4E8EC", "#F6D55C", "#F29E4C", "#E5573F", "#B3164B", "#5B0F5E")
"""The colours of lengths, from nothing to most."""


def heat(
    mesh: SymbolicMesh,
    things: Sequence[Shape | Surface],
    measure: Callable[[Floats, Ints], Floats],
    most: float,
    *,
    ghost: Sequence[Shape | Surface] = (),
    view: View = "iso",
    size: tuple[int, int] = (800, 600),
    title: str | None = None,
    caption: str | None = None,
    background: str | None = "light",
    up: Up | None = None,
) -> Image:
    """Things coloured by `measure`, a length [m] at points (n, 3) of things of these numbers (n,), in six bands.

    most: where the last band begins [m], the first is a quarter of it wide; ghost: what is shown as a grey shell
    around; mesh: tells what is up.
    """
    edges = band_edges(most)
    colors = np.array([rgb(color) for color in BANDS])

    def tint(points: Floats, items: Ints) -> Floats:
        tinted: Floats = colors[np.searchsorted(edges, measure(points, items))]
        return tinted

    skins = [skin(thing) for thing in things]
    shells = [skin(thing) for thing in ghost]
    layers = [Layer(skins, np.tile(colors[0], (len(skins), 1)), tint=tint)]
    if shells:
        layers.append(Layer(shells, np.tile(rgb(UNLABELLED), (len(shells), 1)), before=0.2))
    what = Subject(tuple(layers), framed(skins, shells), up_axis(mesh, up))
    canvas = Canvas(size, background, title, caption, Coloring(colors, _legend(edges)))
    left, top, right, bottom = canvas.room
    canvas.paste_drawing(draw(what, None, view, (right - left, bottom - top)).pixels, (left, top))
    return canvas.image


def band_edges(most: float) -> Floats:
    """Where the bands (5,) begin after the first [m]."""
    edges: Floats = np.maximum(most, 1e-9) * np.array([0.25, 0.4, 0.6, 0.8, 1.0])
    return edges


def _legend(edges: Floats) -> tuple[Entry, ...]:
    unit, name = (1e3, "mm") if edges[-1] < 0.1 else (1.0, "m")
    told = [f"{edge * unit:.3g}" for edge in edges]
    between = [f"{a} to {b}" for a, b in itertools.pairwise(told)]
    words = [f"below {told[0]} {name}", *between, f"above {told[-1]}"]
    return tuple(Entry(color, word) for color, word in zip(BANDS, words, strict=True))
