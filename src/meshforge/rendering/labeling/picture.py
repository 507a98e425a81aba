"""One labelling picture, numbered, and the plain one under its camera."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from meshforge.geometry import Ints
from meshforge.rendering.annotation import count_pixels, text_width
from meshforge.rendering.camera import Camera, View
from meshforge.rendering.canvas import Canvas
from meshforge.rendering.colors import HullColors
from meshforge.rendering.labeling.subject import Arrangement, LabelingSubject
from meshforge.rendering.paint import paint
from meshforge.rendering.placement import TextSize, draw_texts, place_numbers
from meshforge.rendering.raycast import DrawLayer

if TYPE_CHECKING:
    from PIL.Image import Image

_FINE = 2  # rays along each side of a pixel
_HEIGHTS = (0.0265, 0.0225, 0.019)  # of numbers, as shares of a picture, the one liked best first


@dataclass(frozen=True, eq=False)
class LabelingPicture:
    """One view of a mesh, for a model or a person to name its parts in.

    name: what is seen, in words, such as "front" or "hull 7 alone, from the front right, above".
    marked: each hull in its own colour, edges drawn, its number on it or beside it at the end of a line.
    visible_pixels: how many pixels of `marked` show each hull, by name, 0 for hidden ones and those drawn faintly; what
    is written over the drawing is not taken off.
    numbered: the hulls whose number stands on `marked`.
    """

    name: str
    marked: Image
    visible_pixels: Mapping[str, int]
    numbered: frozenset[str]
    draw_plain: Callable[[], Image]

    @cached_property
    def plain(self) -> Image:
        """The same camera and size without numbers: the visual mesh where the asset has one, else plain hulls."""
        return self.draw_plain()


@dataclass(frozen=True, eq=False)
class LabelingCanvas:
    """Where a subject's pictures are drawn; size: pixels along each side."""

    subject: LabelingSubject
    size: int

    @cached_property
    def drawing_size(self) -> tuple[int, int]:
        """Width and height that the name leaves to the drawing [px]."""
        left, top, right, bottom = self._make_paper("front").room
        return right - left, bottom - top

    def draw(self, arrangement: Arrangement, view: View) -> LabelingPicture:
        """Return the picture of an arrangement from one side."""
        name, hulls = arrangement.describe(view), self.subject.mesh.hulls
        camera = arrangement.camera(view, self.drawing_size)
        marked, items = self._paint(name, arrangement, arrangement.layers, camera)
        items = arrangement.find_hulls(items)
        numbered = self._write_numbers(marked, items)
        seen = count_pixels(items, len(hulls)).tolist()
        visible = {hull.name: count for hull, count in zip(hulls, seen, strict=True)}
        shown = frozenset(hulls[k].name for k in numbered)
        return LabelingPicture(
            name, marked, visible, shown, lambda: self._paint(name, arrangement, arrangement.plain_layers, camera)[0]
        )

    def _make_paper(self, name: str) -> Canvas:
        return Canvas((self.size, self.size), "#FFFFFF", None, name, HullColors(self.subject.colors))

    def _paint(
        self, name: str, arrangement: Arrangement, layers: Sequence[DrawLayer], camera: Camera
    ) -> tuple[Image, Ints]:
        paper = self._make_paper(name)
        pixels, items = paint(layers, arrangement.view_frame, camera, _FINE)
        paper.paste_drawing(pixels, paper.room[:2])
        return paper.image, items

    @cached_property
    def _number_sizes(self) -> dict[int, dict[int, TextSize]]:
        """The room that each number takes, for the heights [px] it may be written in."""
        heights = [max(11, round(share * self.size)) for share in _HEIGHTS]
        return {
            k: {high: (text_width(str(number), high) + 0.5 * high, 1.1 * high) for high in heights}
            for k, number in self.subject.wanted.items()
        }

    def _write_numbers(self, image: Image, items: Ints) -> list[int]:
        """Write the numbers of hulls, and return which have one."""
        from PIL import ImageDraw  # lazy: 0.01 s, only pictures need it

        places = place_numbers(items, self._number_sizes)
        texts = {k: str(number) for k, number in self.subject.wanted.items()}
        draw_texts(ImageDraw.Draw(image), places, texts, self.subject.colors, (0, self.size - self.drawing_size[1]))
        return sorted(place.item for place in places)
