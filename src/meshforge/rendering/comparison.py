"""Pictures of an edit, before and after under one camera; and of measurements: surfaces in bands of colour, and
parts of space within pale hulls."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Collection, Container, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from meshforge.common import pluralize
from meshforge.geometry import Aabb, Floats, Ints, Shape, is_same_shape
from meshforge.rendering import colors as palette
from meshforge.rendering import picture
from meshforge.rendering.camera import Up, View
from meshforge.rendering.canvas import Canvas, make_contact_sheet
from meshforge.rendering.colors import ColorBy, HullColors, LegendEntry, color_hulls, label_colors, rgb
from meshforge.rendering.picture import Subject, build_subject, draw_on_canvas, points_to_frame
from meshforge.rendering.raycast import DrawLayer
from meshforge.rendering.scene import to_render_mesh
from meshforge.symbolic import Hull, Surface, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image


MARKS = {"removed": palette.REMOVED, "made": palette.MADE, "changed": palette.CHANGED}
"""The colour of each kind of change."""


def compare(
    before: SymbolicMesh,
    after: SymbolicMesh,
    *,
    view: View = "iso",
    color_by: ColorBy = "label",
    size: tuple[int, int] = (640, 480),
    vocabulary: Sequence[str] = (),
    background: str | None = "light",
    up: Up | None = None,
) -> tuple[Image, Image]:
    """Return the two pictures, without words, seen by one camera; a hull that stays keeps its colour."""
    first = color_hulls(before, color_by, vocabulary)
    known = {h.name: c for h, c in zip(before.hulls, first.colors, strict=True)}
    second = color_hulls(after, color_by, vocabulary, known)
    bounds = joint_bounds(before, after)
    return (
        _draw_bare(build_subject(before, first, up=up), bounds, view, size, background),
        _draw_bare(build_subject(after, second, up=up), bounds, view, size, background),
    )


def draw_before_after(
    before: SymbolicMesh,
    after: SymbolicMesh,
    *,
    view: View = "iso",
    color_by: ColorBy = "label",
    size: tuple[int, int] = (640, 480),
    vocabulary: Sequence[str] = (),
    up: Up | None = None,
) -> Image:
    """Return both pictures side by side, each of `size`, with the number of hulls below each."""
    pair = compare(before, after, view=view, color_by=color_by, size=size, vocabulary=vocabulary, up=up)
    titles = (f"before: {pluralize(len(before.hulls), 'hull')}", f"after: {pluralize(len(after.hulls), 'hull')}")
    return make_contact_sheet(pair, columns=2, titles=titles)


def draw_changes(
    before: SymbolicMesh,
    after: SymbolicMesh,
    changed: Collection[str],
    *,
    view: View = "iso",
    size: tuple[int, int] = (640, 480),
) -> Image:
    """Return both pictures side by side, each of `size`, under one camera: what an edit changed is marked, the rest as
    it was.

    Hulls that only one of them has are removed or made; changed: names of hulls of both that have another shape. These
    have a colour and an outline of their own, all but the made ones stripes, and a legend below says what each is. All
    others have in both pictures the colours that `render` gives them in the first: by label where there are labels,
    else by hull.
    """
    color_by: ColorBy = "label" if before.labels or after.labels else "hull"
    words = [*sorted(_labels_in(before)), *sorted(_labels_in(after) - _labels_in(before))]
    first = color_hulls(before, color_by, words)
    known = {hull.name: color for hull, color in zip(before.hulls, first.colors, strict=True)}
    kinds = _ChangeKinds(before.index, after.index, frozenset(changed))
    bounds, pictures = joint_bounds(before, after), []
    for mesh in (before, after):
        marks = {k: kind for k, hull in enumerate(mesh.hulls) if (kind := kinds.of(hull.name))}
        own = [rgb(MARKS[marks[k]]) if k in marks else known[hull.name] for k, hull in enumerate(mesh.hulls)]
        striped = frozenset(k for k, kind in marks.items() if kind != "made")
        coloring = HullColors(np.array(own).reshape(-1, 3), hatched=striped)
        canvas = Canvas(size, "light", None, None, HullColors(coloring.colors))
        items = draw_on_canvas(canvas, build_subject(mesh, coloring), bounds, view)
        if not mesh.hulls:
            canvas.write_message("no hulls", canvas.room)
        canvas.outline_items(items, {k: MARKS[kind] for k, kind in marks.items()})
        pictures.append(canvas.image)
    names = [*before.index, *(name for name in after.index if name not in before.index)]
    counts = Counter(kinds.of(name) for name in names)
    legend = {f"{kind} {counts[kind]}": color for kind, color in MARKS.items() if counts[kind]}
    legend |= {f"unchanged {counts[None]}, in their own colours": ""} if counts[None] else {}
    kept = {hull.label for hull in before.hulls if not kinds.of(hull.name)} if color_by == "label" else ()
    legend |= {word: color for word, color in label_colors(words).items() if word in kept}
    titles = (f"before: {pluralize(len(before.hulls), 'hull')}", f"after: {pluralize(len(after.hulls), 'hull')}")
    return make_contact_sheet(pictures, columns=2, titles=titles, colors=legend)


@dataclass(frozen=True, slots=True)
class _ChangeKinds:
    """What became of each hull of two meshes, by the names that each has; changed: of both, with another shape."""

    before: Container[str]
    after: Container[str]
    changed: frozenset[str]

    def of(self, name: str) -> str | None:
        if name not in self.before:
            return "made"
        if name not in self.after:
            return "removed"
        return "changed" if name in self.changed else None


def _labels_in(mesh: SymbolicMesh) -> set[str]:
    return {hull.label for hull in mesh.hulls if hull.label}


def draw_difference(
    before: SymbolicMesh,
    after: SymbolicMesh,
    *,
    view: View = "iso",
    size: tuple[int, int] = (800, 600),
    legend: bool = True,
    title: str | None = None,
    background: str | None = "light",
    up: Up | None = None,
) -> Image:
    """Return what an edit did: made hulls green, kept ones grey, removed ones as red, striped shells."""
    gone, fresh = find_replaced(before, after)
    colors = np.array([rgb(palette.MADE if k in fresh else palette.KEPT) for k in range(len(after.hulls))]).reshape(
        -1, 3
    )
    made = len(fresh)
    entries = (LegendEntry(palette.REMOVED, "removed", len(gone)), LegendEntry(palette.MADE, "made", made))
    coloring = HullColors(colors, (*entries, LegendEntry(palette.KEPT, "kept", len(after.hulls) - made)))
    caption = f"{pluralize(len(before.hulls), 'hull')} before, {len(after.hulls)} after"
    canvas = Canvas(size, background, title, caption if legend else None, coloring if legend else HullColors(colors))
    what = _with_removed(build_subject(after, coloring, up=up), gone, fresh)
    draw_on_canvas(canvas, what, joint_bounds(before, after), view)
    if not before.hulls and not after.hulls:
        canvas.write_message("no hulls", canvas.room)
    return canvas.image


def find_replaced(before: SymbolicMesh, after: SymbolicMesh) -> tuple[list[Hull], frozenset[int]]:
    """Return the hulls that an edit took away, and the numbers of those that it made; one that it replaced may have its
    name still, but not its shape."""
    near = 1e-6 * max(before.diagonal, after.diagonal)
    same = {
        hull.name
        for hull in before.hulls
        if hull.name in after.index and is_same_shape(hull.shape, after.hull_of(hull.name).shape, near)
    }
    gone = [hull for hull in before.hulls if hull.name not in same]
    return gone, frozenset(k for k, hull in enumerate(after.hulls) if hull.name not in same)


def joint_bounds(*meshes: SymbolicMesh) -> Aabb | None:
    """Return the box around all hulls of some meshes, None where there is none."""
    boxes = [m.aabb for m in meshes if m.aabb]
    return Aabb.union(boxes) if boxes else None


def _with_removed(what: Subject, gone: Sequence[Hull], fresh: frozenset[int]) -> Subject:
    if not gone:
        return what
    red, every = np.tile(rgb(palette.REMOVED), (len(gone), 1)), frozenset(range(len(gone)))
    shells = DrawLayer(picture.render_meshes_of(gone), red, before=0.55, behind=0.3, hatched=every, drawn_over=fresh)
    return replace(what, layers=(*what.layers, shells))


def _draw_bare(what: Subject, bounds: Aabb | None, view: View, size: tuple[int, int], background: str | None) -> Image:
    canvas = Canvas(size, background, None, None, HullColors(what.layers[0].colors))
    draw_on_canvas(canvas, what, bounds, view)
    if not what.layers[0].render_meshes:
        canvas.write_message("no hulls", canvas.room)
    return canvas.image


BANDS = ("#E4E8EC", "#F6D55C", "#F29E4C", "#E5573F", "#B3164B", "#5B0F5E")
"""The colours of lengths, from nothing to most."""

LengthUnit = Literal["m", "mm"]
"""What lengths are written in."""

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
    unit: LengthUnit = "m",
) -> Image:
    """Return things coloured by `measure`, a length [m] at points (n, 3) of things of these numbers (n,), in six bands.

    most: where the last band begins [m], the first is a quarter of it wide; mesh: says which axis points up; unit: of
    the legend.
    """
    edges: Floats = np.maximum(most, 1e-9) * np.array([0.25, 0.4, 0.6, 0.8, 1.0])  # after the first band
    colors = np.array([rgb(color) for color in BANDS])

    def tint(points: Floats, items: Ints) -> Floats:
        return colors[np.searchsorted(edges, measure(points, items))]

    render_meshes = [to_render_mesh(thing) for thing in things]
    layer = DrawLayer(render_meshes, np.tile(colors[0], (len(render_meshes), 1)), tint=tint)
    subject = Subject((layer,), points_to_frame(render_meshes, ()), picture.up_axis(mesh))
    canvas = Canvas(size, "light", title, None, HullColors(colors, _band_legend(edges, unit)))
    draw_on_canvas(canvas, subject)
    return canvas.image


def _band_legend(edges: Floats, unit: LengthUnit) -> tuple[LegendEntry, ...]:
    texts = [f"{edge:.3g}" for edge in edges * {"m": 1, "mm": 1000}[unit]]
    between = [f"{a} to {b}" for a, b in itertools.pairwise(texts)]
    words = [f"below {texts[0]} {unit}", *between, f"above {texts[-1]} {unit}"]
    return tuple(LegendEntry(color, word) for color, word in zip(BANDS, words, strict=True))


def draw_volumes(mesh: SymbolicMesh, marked: Sequence[VolumeMark], *, size: tuple[int, int], title: str) -> Image:
    """Return the marked parts of space, solid, within the hulls of a mesh as grey shells."""
    parts, shells = [to_render_mesh(surface) for _, _, surface in marked], picture.render_meshes_of(mesh.hulls)
    colors = np.array([rgb(color) for _, color, _ in marked]).reshape(-1, 3)
    names = dict.fromkeys((color, name) for name, color, _ in marked)
    legend = tuple(LegendEntry(color, name) for color, name in names)
    pale = DrawLayer(shells, np.tile(rgb(palette.UNLABELLED), (len(shells), 1)), before=0.28, behind=0.28)
    subject = Subject((DrawLayer(parts, colors), pale), points_to_frame(parts, shells), picture.up_axis(mesh))
    canvas = Canvas(size, "light", title, None, HullColors(colors, legend))
    draw_on_canvas(canvas, subject)
    return canvas.image
