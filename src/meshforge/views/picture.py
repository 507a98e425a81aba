"""Pictures of symbolic meshes, without a display."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from meshforge.asset import Surface
from meshforge.errors import UsageError
from meshforge.geometry import Aabb
from meshforge.symbolic import SymbolicMesh
from meshforge.views.camera import VIEWS, Up, View
from meshforge.views.canvas import Canvas
from meshforge.views.coloring import COLOR_BY, ColorBy, Coloring, color_hulls, highlighted
from meshforge.views.subject import Subject, draw, subject
from meshforge.words import counted

if TYPE_CHECKING:
    from PIL.Image import Image

SIZES = range(16, 8193)


def render(
    mesh: SymbolicMesh,
    *,
    views: Sequence[View] = ("iso",),
    color_by: ColorBy = "hull",
    size: tuple[int, int] = (800, 600),
    highlight: frozenset[str] | None = None,
    ghost: tuple[Surface, ...] | None = None,
    legend: bool = True,
    title: str | None = None,
    caption: str | None = None,
    background: str | None = "light",
    labels: bool | Mapping[str, str] = False,
    bounds: Aabb | None = None,
    vocabulary: Sequence[str] = (),
    up: Up | None = None,
) -> Image:
    """A picture of a mesh, of `size` (width, height); several views share it in a grid. Same input, same bytes.

    highlight: hulls of these names in a strong colour, seen through others, the rest pale.
    ghost: surfaces shown as grey shells; None shows the asset's opaque pieces.
    legend: names of colours and counts of hulls; without it the picture fills the whole size, but for a title.
    background: `light`, a colour `#rrggbb`, or None for transparent.
    labels: the number of each hull on it, counted from 0, or other short texts by hull name; what would cover
    another, or a hull that is hardly seen, is left out.
    bounds: the box that the camera is framed on, to compare pictures; None frames the mesh.
    vocabulary: the order in which labels take their colours.
    up: the axis that points up in the picture, by default that of the mesh's file, or Z.
    Raises UsageError for an unknown view or colouring, or an impossible size.
    """
    _check(views, color_by, size)
    coloring = color_hulls(mesh, color_by, vocabulary) if highlight is None else highlighted(mesh, highlight)
    opaque = tuple(o.surface for o in mesh.asset.opaque if o.surface) if mesh.asset else ()
    what = subject(mesh, coloring, opaque if ghost is None else ghost, highlight or frozenset(), up)
    if caption is None and legend:
        caption = _count(mesh, highlight)
    canvas = Canvas(size, background, title, caption, coloring if legend else Coloring(coloring.colors))
    names = _marks(mesh, labels)
    for view, box in zip(views, _boxes(canvas.room, len(views)), strict=True):
        _place(canvas, what, bounds, view, box, names, named=len(views) > 1)
    return canvas.image


def _place(
    canvas: Canvas,
    what: Subject,
    bounds: Aabb | None,
    view: View,
    box: tuple[int, int, int, int],
    marks: Mapping[int, str],
    named: bool,
) -> None:
    left, top, right, bottom = box
    painted = draw(what, bounds, view, (right - left, bottom - top))
    canvas.paste_drawing(painted.pixels, (left, top))
    if len(what.layers[0].skins) == 0:
        canvas.write_message("no hulls", box)
    canvas.write_marks(painted.items, marks, (left, top))
    if named:
        canvas.write_view_name(view, (left, top))


def _check(views: Sequence[str], color_by: str, size: tuple[int, int]) -> None:
    for view in views:
        if view not in VIEWS:
            raise UsageError(f"there is no view {view!r}", remedy=f"Views are {', '.join(VIEWS)}.")
    if not views:
        raise UsageError("a picture needs a view", remedy=f"Views are {', '.join(VIEWS)}.")
    if color_by not in COLOR_BY:
        raise UsageError(f"hulls cannot be coloured by {color_by!r}", remedy=f"Choose from {', '.join(COLOR_BY)}.")
    if size[0] not in SIZES or size[1] not in SIZES:
        raise UsageError(
            f"a picture cannot be {size[0]} by {size[1]} pixels",
            remedy=f"Sides go from {SIZES.start} to {SIZES.stop - 1}.",
        )


def _count(mesh: SymbolicMesh, highlight: frozenset[str] | None) -> str:
    count = counted(len(mesh.hulls), "hull")
    if highlight is not None:
        return f"{sum(h.name in highlight for h in mesh.hulls)} of {count} selected"
    opaque = len(mesh.asset.opaque) if mesh.asset else 0
    return f"{count}, {counted(opaque, 'piece')} that cannot be edited" if opaque else count


def _marks(mesh: SymbolicMesh, labels: bool | Mapping[str, str]) -> dict[int, str]:
    if isinstance(labels, bool):
        return {k: str(k) for k in range(len(mesh.hulls))} if labels else {}
    return {k: labels[h.name] for k, h in enumerate(mesh.hulls) if h.name in labels}


def _boxes(room: tuple[int, int, int, int], count: int) -> list[tuple[int, int, int, int]]:
    """The room (left, top, right, bottom) cut into a grid of cells a little wider than high, few of them empty."""
    left, top, right, bottom = room

    def unfit(columns: int) -> float:
        rows = -(-count // columns)
        shape = (right - left) / columns / ((bottom - top) / rows)
        return abs(math.log(shape / 1.25)) + 0.3 * (rows * columns - count)

    columns = min(range(1, count + 1), key=unfit)
    rows = -(-count // columns)
    x = np.linspace(left, right, columns + 1).round().astype(int).tolist()
    y = np.linspace(top, bottom, rows + 1).round().astype(int).tolist()
    return [(x[k % columns], y[k // columns], x[k % columns + 1], y[k // columns + 1]) for k in range(count)]
