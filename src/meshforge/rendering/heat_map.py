"""Pictures of measurements: surfaces in bands of colour by a length, and parts of space within pale hulls."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from meshforge.geometry import Floats, Ints, Shape
from meshforge.rendering.canvas import Canvas
from meshforge.rendering.colors import UNLABELLED, HullColors, LegendEntry, rgb
from meshforge.rendering.picture import Subject, draw_on_canvas, points_to_frame, render_meshes_of, up_axis
from meshforge.rendering.raycast import DrawLayer
from meshforge.rendering.scene import to_render_mesh
from meshforge.symbolic import Surface, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image


BANDS = ("#E4E8EC", "#F6D55C", "#F29E4C", "#E5573F", "#B3164B", "#5B0F5E")
"""The colours of lengths, from nothing to most."""

VolumeMark = tuple[str, str, Surface]
"""What a part of space is called, its colour `#rrggbb`, and its surface."""


def draw_heat_map(
    mesh: SymbolicMesh,
    things: Sequence[Shape | Surface],
    measure: Callable[[Floats, Ints], Floats],
    most: float,
    *,
    size: tuple[int, int],
    title: str,
) -> Image:
    """Things coloured by `measure`, a length [m] at points (n, 3) of things of these numbers (n,), in six bands.

    most: where the last band begins [m], the first is a quarter of it wide; mesh: says which axis points up.
    """
    edges: Floats = np.maximum(most, 1e-9) * np.array([0.25, 0.4, 0.6, 0.8, 1.0])  # after the first band
    colors = np.array([rgb(color) for color in BANDS])

    def tint(points: Floats, items: Ints) -> Floats:
        tinted: Floats = colors[np.searchsorted(edges, measure(points, items))]
        return tinted

    render_meshes = [to_render_mesh(thing) for thing in things]
    layer = DrawLayer(render_meshes, np.tile(colors[0], (len(render_meshes), 1)), tint=tint)
    subject = Subject((layer,), points_to_frame(render_meshes, ()), up_axis(mesh))
    canvas = Canvas(size, "light", title, None, HullColors(colors, _band_legend(edges)))
    draw_on_canvas(canvas, subject)
    return canvas.image


def _band_legend(edges: Floats) -> tuple[LegendEntry, ...]:
    unit, name = (1e3, "mm") if edges[-1] < 0.1 else (1.0, "m")
    texts = [f"{edge * unit:.3g}" for edge in edges]
    between = [f"{a} to {b}" for a, b in itertools.pairwise(texts)]
    words = [f"below {texts[0]} {name}", *between, f"above {texts[-1]}"]
    return tuple(LegendEntry(color, word) for color, word in zip(BANDS, words, strict=True))


def draw_volumes(mesh: SymbolicMesh, marked: Sequence[VolumeMark], *, size: tuple[int, int], title: str) -> Image:
    """The marked parts of space, solid, within the hulls of a mesh as grey shells."""
    parts, shells = [to_render_mesh(surface) for _, _, surface in marked], render_meshes_of(mesh.hulls)
    colors = np.array([rgb(color) for _, color, _ in marked]).reshape(-1, 3)
    names = dict.fromkeys((color, name) for name, color, _ in marked)
    legend = tuple(LegendEntry(color, name) for color, name in names)
    pale = DrawLayer(shells, np.tile(rgb(UNLABELLED), (len(shells), 1)), before=0.28, behind=0.28)
    subject = Subject((DrawLayer(parts, colors), pale), points_to_frame(parts, shells), up_axis(mesh))
    canvas = Canvas(size, "light", title, None, HullColors(colors, legend))
    draw_on_canvas(canvas, subject)
    return canvas.image
