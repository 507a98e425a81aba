"""Pictures of symbolic meshes: what a picture is of, and `render`, which draws it with title, legend and names."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge.common import UsageError, pluralize
from meshforge.geometry import Aabb, Floats, Ints
from meshforge.rendering.annotation import FAINT, INK, count_pixels, font, text_scale, text_width
from meshforge.rendering.camera import VIEWS, Up, View, aim_camera
from meshforge.rendering.canvas import Canvas
from meshforge.rendering.colors import (
    COLOR_BY,
    UNLABELLED,
    ColorBy,
    HullColors,
    color_hulls,
    hexadecimal,
    highlight_hulls,
    rgb,
)
from meshforge.rendering.paint import paint
from meshforge.rendering.placement import LEAST_PIXELS, NumberPlace, TextSize, draw_texts, place_numbers
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
    up: the axis that points up in the picture, by default as `up_axis` has it.
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
    solid = DrawLayer(render_meshes, coloring.colors, hatched=coloring.hatched, dotted=coloring.dotted)
    layers, shells = [solid], [s for s in map(to_render_mesh, ghost) if len(s.faces)]
    if shells:
        layers.append(DrawLayer(shells, np.tile(rgb(UNLABELLED), (len(shells), 1)), before=0.3))
    picked = [k for k, h in enumerate(mesh.hulls) if h.name in lifted]
    if picked:
        layers.append(DrawLayer([render_meshes[k] for k in picked], coloring.colors[picked], before=0.0, behind=0.38))
    return Subject(tuple(layers), points_to_frame(render_meshes, shells), up_axis(mesh, up))


def up_axis(mesh: SymbolicMesh, up: Up | None = None) -> Up:
    """Return the axis that points up in a picture: the given one, or that of the mesh's file or project, or Z."""
    return up or ("Y" if mesh.asset and (mesh.asset.view_up or mesh.asset.up) == "y" else "Z")


def render_meshes_of(hulls: Sequence[Hull]) -> list[RenderMesh]:
    """Return the triangles to draw hulls with; the more round ones there are, the fewer sides each has."""
    count = sum(h.shape.is_primitive for h in hulls)
    return [to_render_mesh(h.shape, 96 if count <= _MANY else 32) for h in hulls]


def points_to_frame(render_meshes: Sequence[RenderMesh], shells: Sequence[RenderMesh]) -> Floats:
    """Return the points (n, 3) [m] that a picture of hulls must hold, and of what lies around unless far larger."""
    points = [s.vertices for s in render_meshes]
    size = Aabb.of_points(np.concatenate(points)).diagonal if points else np.inf
    points += [s.vertices for s in shells if Aabb.of_points(s.vertices).diagonal <= _FAR_OUT * size]
    return np.concatenate(points) if points else np.zeros((0, 3))


_MOST_COVERED = 0.3  # of the area of names that lead to their hulls, at most so much may lie on hulls
_MOST_NAMES = 16  # names on one drawing, beyond which it is hard to read
_NUMBERS_NOTE = "In commands a hull is its name or its number, as #0."

DrawnView = tuple[Ints, tuple[int, int]]
"""What the pixels (h, w) of a drawing show, and where its corner lies on the picture [px]."""


def write_hull_names(image: Image, views: Sequence[DrawnView], names: Sequence[str], colors: Floats) -> Image:
    """Return the picture with the names of hulls on it, or their numbers, from 0 in the order of `names`.

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
    """Return where texts go in a drawing, none over another; items: (h, w), what pixels show; size: of the picture."""
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
