"""Pictures of symbolic meshes: what a picture is of, and `render`, which draws it with title and legend."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from meshforge.common import UsageError, pluralize
from meshforge.geometry import Aabb, Floats, Ints
from meshforge.rendering.camera import VIEWS, Up, View, aim_camera
from meshforge.rendering.canvas import Canvas
from meshforge.rendering.colors import COLOR_BY, UNLABELLED, ColorBy, HullColors, color_hulls, highlight_hulls, rgb
from meshforge.rendering.hull_names import write_hull_names
from meshforge.rendering.paint import paint
from meshforge.rendering.raycast import DrawLayer, ViewFrame, up_vector
from meshforge.rendering.scene import RenderMesh, to_render_mesh
from meshforge.symbolic import Hull, Surface, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image


PICTURE_SIZES = range(16, 8193)

_MANY = 60  # round primitives, from which on they are drawn with fewer sides
_FAR_OUT = 2.0  # things around a mesh that are this many times as large are not framed


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
    names: bool = False,
    bounds: Aabb | None = None,
    vocabulary: Sequence[str] = (),
    up: Up | None = None,
) -> Image:
    """Return a picture of a mesh, of `size` (width, height); several views share it in a grid. Same input, same bytes.

    highlight: hulls of these names in a strong colour, seen through others, the rest pale.
    ghost: surfaces shown as grey shells; None shows the asset's opaque pieces.
    legend: names of colours and counts of hulls; without it the picture fills the whole size, but for a title.
    background: `light`, a colour `#rrggbb`, or None for transparent.
    names: the name of each hull on it, or numbers with a legend below the picture, as `write_hull_names` has it.
    bounds: the box that the camera is framed on, to compare pictures; None frames the mesh.
    vocabulary: the order in which labels take their colours.
    up: the axis that points up in the picture, by default that of the mesh's file, or Z.
    Raises UsageError for an unknown view or colouring, or an impossible size.
    """
    _check_arguments(views, color_by, size)
    coloring = color_hulls(mesh, color_by, vocabulary) if highlight is None else highlight_hulls(mesh, highlight)
    non_convex = tuple(o.surface for o in mesh.asset.non_convex if o.surface) if mesh.asset else ()
    what = build_subject(mesh, coloring, non_convex if ghost is None else ghost, highlight or frozenset(), up)
    if caption is None and legend:
        caption = pluralize(len(mesh.hulls), "hull")
        if highlight is not None:
            caption = f"{sum(h.name in highlight for h in mesh.hulls)} of {caption} selected"
        elif mesh.asset and mesh.asset.non_convex:
            caption += f", {pluralize(len(mesh.asset.non_convex), 'piece')} that cannot be edited"
    canvas = Canvas(size, background, title, caption, coloring if legend else HullColors(coloring.colors))
    drawn = []
    for view, box in zip(views, _split_room(canvas.room, len(views)), strict=True):
        drawn.append((draw_on_canvas(canvas, what, bounds, view, box), box[:2]))
        if len(views) > 1:
            canvas.write_view_name(view, box[:2])
    if names and mesh.hulls:
        return write_hull_names(canvas.image, drawn, tuple(mesh.index), coloring.colors)
    return canvas.image


def draw_on_canvas(
    canvas: Canvas,
    what: Subject,
    bounds: Aabb | None = None,
    view: View = "iso",
    box: tuple[int, int, int, int] | None = None,
) -> Ints:
    """Lay the drawing of a subject on a canvas; what each of its pixels (h, w) shows.

    bounds: the box that the camera is framed on, None for all of the subject; box: left, top, right and bottom [px]
    of the drawing, None for all the room that there is.
    """
    left, top, right, bottom = box or canvas.room
    size = right - left, bottom - top
    if bounds is None and not len(what.points):
        canvas.write_message("no hulls", (left, top, right, bottom))
        return np.full(size[::-1], -1)
    frame = ViewFrame(bounds or Aabb.of_points(what.points), up_vector(what.up))
    points = frame.to_unit(what.points if bounds is None else bounds.corners)
    fine = 2 if size[0] * size[1] > 250_000 else 3
    pixels, items = paint(what.layers, frame, aim_camera(view, what.up, size, points), fine)
    canvas.paste_drawing(pixels, (left, top))
    if not any(layer.render_meshes for layer in what.layers):
        canvas.write_message("no hulls", (left, top, right, bottom))
    return items


def _check_arguments(views: Sequence[str], color_by: str, size: tuple[int, int]) -> None:
    for view in views:
        if view not in VIEWS:
            raise UsageError(f"there is no view {view!r}", remedy=f"Views are {', '.join(VIEWS)}.")
    if not views:
        raise UsageError("a picture needs a view", remedy=f"Views are {', '.join(VIEWS)}.")
    if color_by not in COLOR_BY:
        raise UsageError(f"hulls cannot be coloured by {color_by!r}", remedy=f"Choose from {', '.join(COLOR_BY)}.")
    if size[0] not in PICTURE_SIZES or size[1] not in PICTURE_SIZES:
        remedy = f"Sides go from {PICTURE_SIZES.start} to {PICTURE_SIZES.stop - 1}."
        raise UsageError(f"a picture cannot be {size[0]} by {size[1]} pixels", remedy=remedy)


def _split_room(room: tuple[int, int, int, int], count: int) -> list[tuple[int, int, int, int]]:
    """The room (left, top, right, bottom) cut into a grid of cells a little wider than high, few of them empty."""
    left, top, right, bottom = room

    def unfit(columns: int) -> float:
        rows = -(-count // columns)
        return abs(math.log((right - left) / columns / ((bottom - top) / rows) / 1.25)) + 0.3 * (rows * columns - count)

    columns = min(range(1, count + 1), key=unfit)
    rows = -(-count // columns)
    x = np.linspace(left, right, columns + 1).round().astype(int).tolist()
    y = np.linspace(top, bottom, rows + 1).round().astype(int).tolist()
    return [(x[k % columns], y[k // columns], x[k % columns + 1], y[k // columns + 1]) for k in range(count)]


@dataclass(frozen=True, eq=False, slots=True)
class Subject:
    """Layers to be drawn, and the points (n, 3) [m] that the picture must hold; points is empty for no hulls."""

    layers: tuple[DrawLayer, ...]
    points: Floats
    up: Up


def build_subject(
    mesh: SymbolicMesh,
    coloring: HullColors,
    ghost: Sequence[Surface] = (),
    lifted: frozenset[str] = frozenset(),
    up: Up | None = None,
) -> Subject:
    """Return a mesh in its colours; ghost: grey shells around it; lifted: hulls that shine through what hides them.

    up: the axis that points up, None for that of the mesh.
    """
    render_meshes = render_meshes_of(mesh.hulls)
    solid = DrawLayer(render_meshes, coloring.colors, hatched=coloring.hatched)
    layers, shells = [solid], [s for s in map(to_render_mesh, ghost) if len(s.faces)]
    if shells:
        layers.append(DrawLayer(shells, np.tile(rgb(UNLABELLED), (len(shells), 1)), before=0.3))
    picked = [k for k, h in enumerate(mesh.hulls) if h.name in lifted]
    if picked:
        layers.append(DrawLayer([render_meshes[k] for k in picked], coloring.colors[picked], before=0.0, behind=0.38))
    return Subject(tuple(layers), points_to_frame(render_meshes, shells), up_axis(mesh, up))


def up_axis(mesh: SymbolicMesh, up: Up | None = None) -> Up:
    """Return the axis that points up in a picture: the given one, or that of the mesh's file, or Z."""
    return up or ("Y" if mesh.asset and mesh.asset.up == "y" else "Z")


def render_meshes_of(hulls: Sequence[Hull]) -> list[RenderMesh]:
    """Return the triangles to draw hulls with; the more round ones there are, the fewer sides each has."""
    count = sum(h.shape.is_primitive for h in hulls)
    return [to_render_mesh(h.shape, 96 if count <= _MANY else 32) for h in hulls]


def points_to_frame(render_meshes: Sequence[RenderMesh], shells: Sequence[RenderMesh]) -> Floats:
    """Return the points (n, 3) [m] that a picture of hulls must hold, and of what lies around them unless it is far
    larger."""
    points = [s.vertices for s in render_meshes]
    size = Aabb.of_points(np.concatenate(points)).diagonal if points else np.inf
    points += [s.vertices for s in shells if Aabb.of_points(s.vertices).diagonal <= _FAR_OUT * size]
    return np.concatenate(points) if points else np.zeros((0, 3))
