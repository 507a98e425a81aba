"""One labelling picture, drawn: the numbered one, the plain one under the same camera, and the inset of one from
close up."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge.geometry import Aabb, Floats, Ints
from meshforge.rendering.annotation import INK, LabelAnchor, PixelBox, count_pixels
from meshforge.rendering.camera import Camera, View
from meshforge.rendering.colors import PALE, rgb
from meshforge.rendering.labeling import page
from meshforge.rendering.labeling.page import PagePixels, draw_surfaces, lay_ink, to_square_image, trace_ink
from meshforge.rendering.labeling.subject import NEUTRAL, Arrangement, LabelingSubject
from meshforge.rendering.paint import LineStrengths
from meshforge.rendering.placement import LEAST_PIXELS, TextSize, draw_texts, place_numbers
from meshforge.rendering.raycast import RayHits

if TYPE_CHECKING:
    from PIL.Image import Image


_FAINT_INK = 0.28  # of full ink, for hulls that are only hinted at

_INSET_SHARE = 0.24  # of a picture's side
_LEAST_FRAME = 9  # pixels along the frame that marks the place


@dataclass(frozen=True, eq=False, slots=True)
class LabelingPicture:
    """One view of a mesh, for a model or a person to name its parts in.

    name: what is seen, in words, such as "front" or "hull 7 alone, from the front right, above".
    marked: each hull in its own colour, edges drawn, its number on it or beside it at the end of a line.
    plain: the same camera and size without words: the visual mesh where the asset has one, else the hulls in one
    material.
    visible_pixels: how many pixels of `marked` show each hull, by name, 0 for hidden ones and those drawn faintly; what
    is written over the drawing is not taken off.
    numbered: the hulls whose number stands on `marked`.
    """

    name: str
    marked: Image
    plain: Image
    visible_pixels: Mapping[str, int]
    numbered: frozenset[str]


@dataclass(frozen=True, eq=False)
class LabelingCanvas:
    """Where a subject's pictures are drawn; size: pixels along each side."""

    subject: LabelingSubject
    size: int

    @property
    def drawing_size(self) -> tuple[int, int]:
        """Width and height that words leave to the drawing [px]."""
        return self.size, self.size - page.head_height(self.size) - self._legend.height

    def draw(self, arrangement: Arrangement, view: View) -> LabelingPicture:
        """Return the picture of an arrangement from one side."""
        from PIL import ImageDraw  # lazy: 0.01 s, only pictures need it

        subject, top = self.subject, page.head_height(self.size)
        camera = arrangement.camera(view, self.drawing_size)
        hits = arrangement.cast_solid(camera)
        items = arrangement.hull_pixels(hits)
        drawing, faint = trace_ink(hits, self._line_width), self._trace_faint(arrangement, hits, camera)
        colors = subject.colors[list(arrangement.solid)]
        marked = to_square_image(self._draw_page(arrangement, hits, colors, camera, drawing, faint), self.size, top)
        taken: list[tuple[int, int, int, int]] = []
        if arrangement.close:
            taken = [self._paste_inset(marked, arrangement, view, items, top)]
            items = _mask_box(items, taken[0])
        draw = ImageDraw.Draw(marked)
        numbered = self._write_numbers(draw, arrangement, items, camera, taken, top)
        page.draw_head(draw, self.size, arrangement.describe(view), camera, arrangement.view_frame.upright)
        self._legend.draw(draw, numbered, subject.colors)
        plain = self._draw_visual(arrangement, camera)
        if plain is None:
            plain = self._draw_page(arrangement, hits, np.tile(NEUTRAL, (len(colors), 1)), camera, drawing, faint)
        hulls = subject.mesh.hulls
        return LabelingPicture(
            arrangement.describe(view),
            marked,
            to_square_image(plain, self.size, top),
            {hull.name: n for hull, n in zip(hulls, count_pixels(items, len(hulls)).tolist(), strict=True)},
            frozenset(hulls[k].name for k in numbered),
        )

    @cached_property
    def _legend(self) -> page.NumberLegend:
        return page.NumberLegend(self.subject.number_texts, self.size)

    @cached_property
    def _number_sizes(self) -> dict[int, dict[int, TextSize]]:
        return page.number_sizes(self.subject.number_texts, self.size)

    @property
    def _line_width(self) -> int:
        return max(2, round(self.size / 512))

    def _draw_page(
        self,
        arrangement: Arrangement,
        hits: RayHits,
        colors: Floats,
        camera: Camera,
        drawing: LineStrengths,
        faint: LineStrengths | None,
    ) -> PagePixels:
        """The solid hulls in their colours, and their lines and those of the faint ones."""
        pixels = draw_surfaces(hits, colors, arrangement.view_frame, camera)
        lay_ink(pixels, drawing)
        if faint is not None:
            lay_ink(pixels, faint, _FAINT_INK)
        return pixels

    def _trace_faint(self, arrangement: Arrangement, hits: RayHits, camera: Camera) -> LineStrengths | None:
        """The lines (h, w) of hulls that are only hinted at, where nothing else is; None without such hulls."""
        behind = arrangement.cast_faint(camera)
        return np.where(hits.item < 0, trace_ink(behind, self._line_width), np.uint8(0)) if behind else None

    def _draw_visual(self, arrangement: Arrangement, camera: Camera) -> PagePixels | None:
        visual = arrangement.cast_visual(camera)
        if visual is None:
            return None
        hits, steps = visual
        pixels = draw_surfaces(hits, self.subject.visuals[1], arrangement.view_frame, camera)
        lay_ink(pixels, trace_ink(hits, self._line_width, steps, self.subject.smooth))
        return pixels

    def _paste_inset(
        self, marked: Image, arrangement: Arrangement, view: View, items: Ints, top: int
    ) -> tuple[int, int, int, int]:
        """Shows in a corner where a picture from close up is, and returns the box that this covers."""
        small = draw_inset(arrangement, view, self.size)
        column, row = find_free_corner(items, small.width)
        marked.paste(small, (column, row + top))
        return column, row, column + small.width, row + small.width

    def _write_numbers(
        self, draw: Any, arrangement: Arrangement, items: Ints, camera: Camera, taken: Sequence[PixelBox], top: int
    ) -> list[int]:
        """Writes the numbers of hulls, and returns which have one; nothing is written on boxes that are taken."""
        known: dict[int, LabelAnchor] = {}
        if len(arrangement.solid) == 1 and (items >= 0).sum() < LEAST_PIXELS:
            (alone,) = arrangement.solid
            first, last = _end_points(arrangement, camera)
            draw.line([(column, row + top) for column, row in (first.tolist(), last.tolist())], INK, self._line_width)
            column, row = ((first + last) / 2).round().astype(int).tolist()
            known[alone] = LabelAnchor(column, row, 0.0)
        places = place_numbers(items, self._number_sizes, known, taken)
        draw_texts(draw, places, self.subject.number_texts, self.subject.colors, (0, top))
        return sorted(place.item for place in places)


def _mask_box(items: Ints, box: tuple[int, int, int, int]) -> Ints:
    """What pixels (h, w) show when nothing in a box is seen."""
    left, top, right, bottom = box
    rest = items.copy()
    rest[top:bottom, left:right] = -1
    return rest


def _end_points(arrangement: Arrangement, camera: Camera) -> tuple[Floats, Floats]:
    """Column and row (2,) of the two ends of a hull that is drawn alone and too thin for rays to meet it."""
    points = camera.to_pixels(arrangement.view_frame.to_unit(arrangement.render_meshes[arrangement.solid[0]].vertices))
    first: Floats = points[np.argmax(np.linalg.norm(points - points[0], axis=1))]
    last: Floats = points[np.argmax(np.linalg.norm(points - first, axis=1))]
    return first, last


def draw_inset(arrangement: Arrangement, view: View, size: int) -> Image:
    """Return the whole mesh, pale, the hulls that an arrangement is about shining through, and a frame about what it
    shows.

    size: pixels along the sides of the picture that it is put on.
    """
    from PIL import ImageDraw  # lazy: 0.01 s, only pictures need it

    subject, side = arrangement.subject, round(_INSET_SHARE * size)
    whole, about = Arrangement.in_place(subject), Arrangement(subject, arrangement.close, subject.points)
    camera = whole.camera(view, (side, side))
    hits, shining = whole.cast_solid(camera), about.cast_solid(camera)
    pixels = draw_surfaces(hits, np.tile(rgb(PALE), (len(whole.solid), 1)), whole.view_frame, camera)
    lay_ink(pixels, trace_ink(hits, 2), 0.6)
    lit = draw_surfaces(shining, subject.colors[list(arrangement.close)], whole.view_frame, camera)
    pixels[shining.item >= 0] = lit[shining.item >= 0]
    image = to_square_image(pixels, side, 0)
    draw = ImageDraw.Draw(image)
    seen = camera.to_pixels(whole.view_frame.to_unit(Aabb.of_points(arrangement.frame).corners))
    low, high = seen.min(axis=0), seen.max(axis=0)
    grown = np.maximum(_LEAST_FRAME - (high - low), 0) / 2
    draw.rectangle([*(low - grown).tolist(), *(high + grown).tolist()], None, INK, 2)
    draw.rectangle((0, 0, side - 1, side - 1), None, INK, 1)
    return image


def find_free_corner(items: Ints, side: int) -> tuple[int, int]:
    """Return column and row where a square of `side` pixels in a corner of a picture (h, w) covers fewest hulls."""
    height, width = items.shape
    corners = [(column, row) for row in (0, height - side) for column in (width - side, 0)]
    return min(corners, key=lambda at: int((items[at[1] : at[1] + side, at[0] : at[0] + side] >= 0).sum()))
