"""One labelling picture, numbered, and the plain one under its camera; lit, with dark lines."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints
from meshforge.rendering.annotation import INK, LabelAnchor, count_pixels, font, shorten, text_width
from meshforge.rendering.camera import Camera, View
from meshforge.rendering.labeling.subject import NEUTRAL, Arrangement, LabelingSubject
from meshforge.rendering.paint import LineStrengths, shade, trace_lines
from meshforge.rendering.placement import LEAST_PIXELS, TextSize, draw_texts, place_numbers
from meshforge.rendering.raycast import RayHits, ViewFrame, cast_rays, neighbour_slices

if TYPE_CHECKING:
    from PIL.Image import Image


PagePixels = npt.NDArray[np.uint8]
"""Pixels (h, w, 4): red, green, blue, and one to spare."""
_INK = np.array([26, 31, 41], np.float32)
_STRENGTH = np.array([0, 70, 215, 235], np.uint16)  # of no line, a crease, a border, a silhouette; of 255
_FAINT_INK = 0.28  # of full ink, for hulls that are only hinted at


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
        return self.size, self.size - head_height(self.size)

    def draw(self, arrangement: Arrangement, view: View) -> LabelingPicture:
        """Return the picture of an arrangement from one side."""
        from PIL import ImageDraw  # lazy: 0.01 s, only pictures need it

        name, frame = arrangement.describe(view), arrangement.view_frame
        camera = arrangement.camera(view, self.drawing_size)
        hits = cast_rays(arrangement.solid_scene, camera)
        items, drawing = arrangement.hull_pixels(hits), self._trace_ink(hits)
        faint = arrangement.cast_faint(camera)
        if faint is not None:  # it shows where nothing else does
            hint = np.where(hits.item < 0, self._trace_ink(faint) * _FAINT_INK, 0)
            drawing = np.maximum(drawing, np.rint(hint).astype(np.uint8))
        colors = self.subject.colors[list(arrangement.solid)]
        marked = self._to_image(_draw_surfaces(hits, colors, frame, camera), drawing)
        draw = ImageDraw.Draw(marked)
        numbered = self._write_numbers(draw, arrangement, items, camera)
        high = max(11, round(0.021 * self.size))
        at = round(0.016 * self.size), head_height(self.size) / 2
        draw.text(at, shorten(name, high, 0.96 * self.size), INK, font(high), "lm")
        visual = arrangement.cast_visual(camera)
        if visual is None:
            plain = self._to_image(_draw_surfaces(hits, np.tile(NEUTRAL, (len(colors), 1)), frame, camera), drawing)
        else:
            pixels = _draw_surfaces(visual, self.subject.visuals[1], frame, camera)
            plain = self._to_image(pixels, self._trace_ink(visual))
        hulls = self.subject.mesh.hulls
        seen = count_pixels(items, len(hulls)).tolist()
        visible = {hull.name: count for hull, count in zip(hulls, seen, strict=True)}
        return LabelingPicture(name, marked, plain, visible, frozenset(hulls[k].name for k in numbered))

    @cached_property
    def _number_sizes(self) -> dict[int, dict[int, TextSize]]:
        """The room that each number takes, for the two heights [px] it may be written in."""
        count = len(self.subject.wanted)
        share = 0.0265 if count <= 45 else 0.0225 if count <= 90 else 0.019
        heights = [max(11, round(part * share * self.size)) for part in (1.0, 0.8)]
        return {
            k: {high: (text_width(str(number), high) + 0.5 * high, 1.1 * high) for high in heights}
            for k, number in self.subject.wanted.items()
        }

    def _trace_ink(self, hits: RayHits) -> LineStrengths:
        """How much of each pixel (h, w) the lines of a drawing cover, of 255. Lines are soft."""
        share: Any = _STRENGTH[trace_lines(hits, max(2, round(self.size / 512)))]
        for axis in (0, 1):
            mixed = 2 * share
            here, there = neighbour_slices(axis)
            mixed[here] += share[there]
            mixed[there] += share[here]
            share = mixed >> 2
        return np.asarray(share, np.uint8)

    def _to_image(self, pixels: PagePixels, ink: LineStrengths) -> Image:
        """The picture of a page, dark lines over it, as much of them as `ink` (h, w) of 255 says."""
        from PIL import Image  # lazy: 0.01 s, only pictures need it

        at = np.flatnonzero(ink)
        flat: Any = pixels.reshape(-1, 4)
        below = flat[at, :3]
        flat[at, :3] = np.rint(below + (_INK - below) * (ink.ravel()[at, None] * np.float32(1 / 255)))
        whole = np.full((self.size, self.size, 4), 255, np.uint8)
        whole[head_height(self.size) :] = pixels
        return Image.frombuffer("RGBX", (self.size, self.size), whole, "raw", "RGBX", 0, 1).convert("RGB")

    def _write_numbers(self, draw: Any, arrangement: Arrangement, items: Ints, camera: Camera) -> list[int]:
        """Writes the numbers of hulls, and returns which have one: of one alone, be it too thin for rays, too."""
        known: dict[int, LabelAnchor] = {}
        if len(arrangement.solid) == 1 and (items >= 0).sum() < LEAST_PIXELS:
            (alone,) = arrangement.solid
            points = camera.to_pixels(arrangement.view_frame.to_unit(self.subject.render_meshes[alone].vertices))
            column, row = points.mean(axis=0).round().astype(int).tolist()
            known[alone] = LabelAnchor(column, row, 0.0)
        places = place_numbers(items, self._number_sizes, known)
        texts = {k: str(number) for k, number in self.subject.wanted.items()}
        draw_texts(draw, places, texts, self.subject.colors, (0, head_height(self.size)))
        return sorted(place.item for place in places)


def head_height(size: int) -> int:
    """Return the height of the line along the top, which says what is seen [px]."""
    return round(0.045 * size)


def _draw_surfaces(hits: RayHits, colors: Floats, view_frame: ViewFrame, camera: Camera) -> PagePixels:
    """What the pixels show; colors: (k, 3), sRGB in 0..1, of the scene's things."""
    scene = hits.scene
    table = np.full((len(scene.item) + 1, 4), 255, np.uint8)
    if len(scene.item):
        bright = shade(np.asarray(colors, np.float64)[scene.item], scene.normals, camera, view_frame.upright)
        table[:-1, :3] = np.rint(bright * 255)
    return table[hits.triangle]
