"""Pictures of an edit, before and after; and of measurements: bands of colour, space within pale hulls."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from meshforge.common import pluralize
from meshforge.geometry import Aabb, Floats, Ints, Shape
from meshforge.rendering import colors as palette
from meshforge.rendering import picture
from meshforge.rendering.camera import Up, View
from meshforge.rendering.canvas import Canvas, make_contact_sheet
from meshforge.rendering.colors import ColorBy, HullColors, LegendEntry, color_hulls, label_colors, rgb
from meshforge.rendering.picture import Subject, build_subject, draw_on_canvas, points_to_frame
from meshforge.rendering.raycast import DrawLayer
from meshforge.rendering.scene import RenderMesh, to_render_mesh
from meshforge.symbolic import Surface, SymbolicMesh, find_unchanged

if TYPE_CHECKING:
    from PIL.Image import Image


MARKS = {"removed": palette.REMOVED, "made": palette.MADE, "changed": palette.CHANGED}
"""The colour of each kind of change."""


def compare(
    before: SymbolicMesh,
    after: SymbolicMesh,
    *,
    color_by: ColorBy = "label",
    size: tuple[int, int] = (640, 480),
    vocabulary: Sequence[str] = (),
    background: str | None = "light",
    up: Up | None = None,
) -> tuple[Image, Image]:
    """Return the two pictures, without words, seen by one camera; a hull that stays keeps its colour."""
    first = color_hulls(before, color_by, vocabulary)
    known = {h.name: c for h, c in zip(before.hulls, first.colors, strict=True)}
    subjects = [
        build_subject(before, first, up=up),
        build_subject(after, color_hulls(after, color_by, vocabulary, known), up=up),
    ]
    one, other = (_draw(what, size, background, bounds=joint_bounds(before, after)) for what in subjects)
    return one, other


def draw_before_after(
    before: SymbolicMesh,
    after: SymbolicMesh,
    *,
    size: tuple[int, int] = (640, 480),
    vocabulary: Sequence[str] = (),
    up: Up | None = None,
) -> Image:
    """Return both pictures side by side, each of `size`, with the number of hulls below each."""
    pair = compare(before, after, size=size, vocabulary=vocabulary, up=up)
    return make_contact_sheet(pair, columns=2, titles=_count_hulls(before, after))


def _count_hulls(before: SymbolicMesh, after: SymbolicMesh) -> tuple[str, str]:
    return f"before: {pluralize(len(before.hulls), 'hull')}", f"after: {pluralize(len(after.hulls), 'hull')}"


def draw_changes(
    before: SymbolicMesh, after: SymbolicMesh, *, view: View = "iso", size: tuple[int, int] = (640, 480)
) -> Image:
    """Return both pictures side by side, each of `size`, under one camera: what an edit changed is marked.

    Hulls that only one of them has are removed or made; changed are those of both that have another shape. These have a
    colour and an outline of their own, all but the made ones stripes, and a legend below says what each is. All others
    have in both pictures the colours that `render` gives them in the first: by label if there are labels, else by hull.
    """
    color_by: ColorBy = "label" if before.labels or after.labels else "hull"
    labels = [{hull.label for hull in mesh.hulls if hull.label} for mesh in (before, after)]
    words = [*sorted(labels[0]), *sorted(labels[1] - labels[0])]
    colors = color_hulls(before, color_by, words).colors
    known = {hull.name: color for hull, color in zip(before.hulls, colors, strict=True)}
    same = find_unchanged(before, after)
    kinds = {name: "changed" if name in before.index else "made" for name in after.index if name not in same}
    kinds |= {name: "removed" for name in before.index if name not in after.index}
    bounds, pictures = joint_bounds(before, after), []
    for mesh in (before, after):
        marks = {k: kinds[hull.name] for k, hull in enumerate(mesh.hulls) if hull.name in kinds}
        own = [rgb(MARKS[marks[k]]) if k in marks else known[hull.name] for k, hull in enumerate(mesh.hulls)]
        striped = frozenset(k for k, kind in marks.items() if kind != "made")
        coloring = HullColors(np.array(own).reshape(-1, 3), hatched=striped)
        canvas = Canvas(size, "light", None, None, HullColors(coloring.colors))
        items = draw_on_canvas(canvas, build_subject(mesh, coloring), bounds, view)
        canvas.outline_items(items, {k: MARKS[kind] for k, kind in marks.items()})
        pictures.append(canvas.image)
    counts = Counter(kinds.values())
    legend = {f"{kind} {counts[kind]}": color for kind, color in MARKS.items() if counts[kind]}
    legend |= {f"unchanged {len(same)}, in their own colours": ""} if same else {}
    kept = {hull.label for hull in before.hulls if hull.name in same} if color_by == "label" else ()
    legend |= {word: color for word, color in label_colors(words).items() if word in kept}
    return make_contact_sheet(pictures, columns=2, titles=_count_hulls(before, after), colors=legend)


def draw_difference(
    before: SymbolicMesh,
    after: SymbolicMesh,
    *,
    view: View = "iso",
    size: tuple[int, int] = (800, 600),
    background: str | None = "light",
) -> Image:
    """Return what an edit did: made hulls green, kept ones grey, removed ones as red, striped shells."""
    same = find_unchanged(before, after)
    gone = [hull for hull in before.hulls if hull.name not in same]
    fresh = frozenset(k for k, hull in enumerate(after.hulls) if hull.name not in same)
    colors = [rgb(palette.MADE if k in fresh else palette.KEPT) for k in range(len(after.hulls))]
    what = build_subject(after, HullColors(np.array(colors).reshape(-1, 3)))
    if gone:
        red, every = np.tile(rgb(palette.REMOVED), (len(gone), 1)), frozenset(range(len(gone)))
        meshes = picture.render_meshes_of(gone)
        shells = DrawLayer(meshes, red, before=0.55, behind=0.3, hatched=every, drawn_over=fresh)
        what = replace(what, layers=(*what.layers, shells))
    return _draw(what, size, background, bounds=joint_bounds(before, after), view=view)


def joint_bounds(*meshes: SymbolicMesh) -> Aabb | None:
    """Return the box around all hulls of some meshes, None where there is none."""
    boxes = [m.aabb for m in meshes if m.aabb]
    return Aabb.union(boxes) if boxes else None


def _draw(
    what: Subject,
    size: tuple[int, int],
    background: str | None = "light",
    *,
    title: str | None = None,
    legend: tuple[LegendEntry, ...] = (),
    bounds: Aabb | None = None,
    view: View = "iso",
) -> Image:
    canvas = Canvas(size, background, title, None, HullColors(what.layers[0].colors, legend))
    draw_on_canvas(canvas, what, bounds, view)
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

    most: where the last band begins [m], the first is a quarter as wide; mesh: says what is up; unit: of the legend.
    """
    edges: Floats = np.maximum(most, 1e-9) * np.array([0.25, 0.4, 0.6, 0.8, 1.0])  # after the first band
    colors = np.array([rgb(color) for color in BANDS])

    def tint(points: Floats, items: Ints) -> Floats:
        return colors[np.searchsorted(edges, measure(points, items))]

    render_meshes = [to_render_mesh(thing) for thing in things]
    layer = DrawLayer(render_meshes, np.tile(colors[0], (len(render_meshes), 1)), tint=tint)
    subject = Subject((layer,), points_to_frame(render_meshes, ()), picture.up_axis(mesh))
    texts = [f"{edge:.3g}" for edge in edges * {"m": 1, "mm": 1000}[unit]]
    between = [f"{a} to {b}" for a, b in itertools.pairwise(texts)]
    words = [f"below {texts[0]} {unit}", *between, f"above {texts[-1]} {unit}"]
    legend = tuple(LegendEntry(color, word) for color, word in zip(BANDS, words, strict=True))
    return _draw(subject, size, title=title, legend=legend)


_SMALL, _AROUND = 0.35, 0.22  # of the whole


def draw_volumes(mesh: SymbolicMesh, marked: Sequence[VolumeMark], *, size: tuple[int, int], title: str) -> Image:
    """Return the marked parts of space, solid, within the hulls of a mesh as grey shells."""
    parts, shells = [to_render_mesh(surface) for _, _, surface in marked], picture.render_meshes_of(mesh.hulls)
    colors = np.array([rgb(color) for _, color, _ in marked]).reshape(-1, 3)
    names = dict.fromkeys((color, name) for name, color, _ in marked)
    legend = tuple(LegendEntry(color, name) for color, name in names)
    pale = DrawLayer(shells, np.tile(rgb(palette.UNLABELLED), (len(shells), 1)), before=0.28, behind=0.28)
    subject = Subject((DrawLayer(parts, colors), pale), _frame_around(parts, shells), picture.up_axis(mesh))
    return _draw(subject, size, title=title, legend=legend)


def _frame_around(parts: Sequence[RenderMesh], shells: Sequence[RenderMesh]) -> Floats:
    """All points; where parts are small beside the hulls, a box around them in which one sees where they are."""
    points = np.concatenate([one.vertices for one in (*parts, *shells)])
    own, whole = Aabb.union(Aabb.of_points(one.vertices) for one in parts), Aabb.of_points(points)
    if own.diagonal > _SMALL * whole.diagonal:
        return points
    half = whole.diagonal * _AROUND
    return np.clip(np.stack([own.center - half, own.center + half]), whole.min, whole.max)
