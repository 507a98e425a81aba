"""One shot, drawn: the numbered picture and the plain one under the same camera."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.views.camera import Camera, View
from meshforge.views.labelling.arrangement import Arrangement
from meshforge.views.labelling.flat import Page, drawn_over, framed, ink, shaded
from meshforge.views.labelling.inset import free_corner, inset
from meshforge.views.labelling.paper import Key, draw_head, draw_numbers, head_height, type_sizes
from meshforge.views.labelling.placing import LEAST, Size, placed
from meshforge.views.labelling.shot import Shot
from meshforge.views.labelling.sitter import NEUTRAL, Sitter
from meshforge.views.marks import Box
from meshforge.views.middles import Middle, pixels_of
from meshforge.views.outline import Lines
from meshforge.views.stage import Hits
from meshforge.views.text import INK

if TYPE_CHECKING:
    from PIL.Image import Image

_FAINT = 0.28  # of full ink, for hulls that are only hinted at


@dataclass(frozen=True, eq=False)
class Easel:
    """Where a sitter's pictures are drawn; size: pixels along each side."""

    sitter: Sitter
    size: int

    @property
    def drawing_size(self) -> tuple[int, int]:
        """Width and height that words leave to the drawing [px]."""
        return self.size, self.size - head_height(self.size) - self._legend.height

    def draw(self, arrangement: Arrangement, view: View) -> Shot:
        """The picture of an arrangement from one side."""
        from PIL import ImageDraw

        sitter, top = self.sitter, head_height(self.size)
        camera = arrangement.camera(view, self.drawing_size)
        hits = arrangement.cast_solid(camera)
        items = arrangement.hull_pixels(hits)
        drawing, faint = ink(hits, self._line_width), self._trace_faint(arrangement, hits, camera)
        colors = sitter.colors[list(arrangement.solid)]
        marked = framed(self._draw_page(arrangement, hits, colors, camera, drawing, faint), self.size, top)
        taken: list[tuple[int, int, int, int]] = []
        if arrangement.close:
            taken = [self._paste_inset(marked, arrangement, view, items, top)]
            items = _covered(items, taken[0])
        draw = ImageDraw.Draw(marked)
        numbered = self._write_numbers(draw, arrangement, items, camera, taken, top)
        draw_head(draw, self.size, arrangement.describe(view), camera, arrangement.view_frame.upright)
        self._legend.draw(draw, numbered, sitter.colors)
        plain = self._draw_visual(arrangement, camera)
        if plain is None:
            plain = self._draw_page(arrangement, hits, np.tile(NEUTRAL, (len(colors), 1)), camera, drawing, faint)
        hulls = sitter.mesh.hulls
        counts = pixels_of(items, len(hulls)).tolist()
        return Shot(
            arrangement.describe(view),
            marked,
            framed(plain, self.size, top),
            {hull.name: n for hull, n in zip(hulls, counts, strict=True)},
            frozenset(hulls[k].name for k in numbered),
        )

    @cached_property
    def _legend(self) -> Key:
        return Key(self.sitter.number_texts, self.size)

    @cached_property
    def _number_sizes(self) -> dict[int, dict[int, Size]]:
        return type_sizes(self.sitter.number_texts, self.size)

    @property
    def _line_width(self) -> int:
        """How wide lines are [px]."""
        return max(2, round(self.size / 512))

    def _draw_page(
        self,
        arrangement: Arrangement,
        hits: Hits,
        colors: Floats,
        camera: Camera,
        drawing: Lines,
        faint: Lines | None,
    ) -> Page:
        """The solid hulls in their colours, and their lines and those of the faint ones."""
        page = shaded(hits, colors, arrangement.view_frame, camera)
        drawn_over(page, drawing)
        if faint is not None:
            drawn_over(page, faint, _FAINT)
        return page

    def _trace_faint(self, arrangement: Arrangement, hits: Hits, camera: Camera) -> Lines | None:
        """The lines (h, w) of hulls that are only hinted at, where nothing else is; None without such hulls."""
        behind = arrangement.cast_faint(camera)
        return np.where(hits.item < 0, ink(behind, self._line_width), np.uint8(0)) if behind else None

    def _draw_visual(self, arrangement: Arrangement, camera: Camera) -> Page | None:
        """The visual mesh, where it can be shown."""
        visual = arrangement.cast_visual(camera)
        if visual is None:
            return None
        hits, steps = visual
        page = shaded(hits, self.sitter.visuals[1], arrangement.view_frame, camera)
        drawn_over(page, ink(hits, self._line_width, steps, self.sitter.smooth))
        return page

    def _paste_inset(
        self, marked: Image, arrangement: Arrangement, view: View, items: Ints, top: int
    ) -> tuple[int, int, int, int]:
        """Shows in a corner where a picture from close up is, and returns the box that this covers."""
        small = inset(arrangement, view, self.size)
        column, row = free_corner(items, small.width)
        marked.paste(small, (column, row + top))
        return column, row, column + small.width, row + small.width

    def _write_numbers(
        self, draw: Any, arrangement: Arrangement, items: Ints, camera: Camera, taken: Sequence[Box], top: int
    ) -> list[int]:
        """Writes the numbers of hulls, and returns which have one; nothing is written on boxes that are taken."""
        known: dict[int, Middle] = {}
        if len(arrangement.solid) == 1 and (items >= 0).sum() < LEAST:
            (alone,) = arrangement.solid
            first, last = _ends(arrangement, camera)
            draw.line([(column, row + top) for column, row in (first.tolist(), last.tolist())], INK, self._line_width)
            column, row = ((first + last) / 2).round().astype(int).tolist()
            known[alone] = Middle(column, row, 0.0)
        places = placed(items, self._number_sizes, known, taken)
        draw_numbers(draw, places, self.sitter.number_texts, self.sitter.colors, top)
        return sorted(place.item for place in places)


def _covered(items: Ints, box: tuple[int, int, int, int]) -> Ints:
    """What pixels (h, w) show when nothing in a box is seen."""
    left, top, right, bottom = box
    rest = items.copy()
    rest[top:bottom, left:right] = -1
    return rest


def _ends(arrangement: Arrangement, camera: Camera) -> tuple[Floats, Floats]:
    """Column and row (2,) of the two ends of a hull that is drawn alone and too thin for rays to meet it."""
    points = camera.to_pixels(arrangement.view_frame.to_unit(arrangement.render_meshes[arrangement.solid[0]].vertices))
    first: Floats = points[np.argmax(np.linalg.norm(points - points[0], axis=1))]
    last: Floats = points[np.argmax(np.linalg.norm(points - first, axis=1))]
    return first, last
