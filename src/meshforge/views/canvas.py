"""The paper of a picture: background, title, legend, and the drawings laid on it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge.errors import UsageError
from meshforge.geometry import Ints
from meshforge.views.camera import Singles
from meshforge.views.coloring import Coloring
from meshforge.views.legend import draw_legend, heading, legend_height
from meshforge.views.marks import draw_marks
from meshforge.views.palette import rgb
from meshforge.views.text import FAINT, font, unit

if TYPE_CHECKING:
    from PIL.Image import Image

_LIGHT = ("#FFFFFF", "#EEF1F5")  # from top to bottom


class Canvas:
    """A picture in the making. `room` (left, top, right, bottom) is what title and legend leave free."""

    def __init__(
        self, size: tuple[int, int], background: str | None, title: str | None, caption: str | None, coloring: Coloring
    ) -> None:
        from PIL import ImageDraw

        self.size = size
        self.image: Image = _paper(size, background)
        self._draw = ImageDraw.Draw(self.image)
        top = heading(self._draw, size, title, caption)
        foot = legend_height(coloring, size)
        if top + foot > size[1] - 8:  # a picture too small for words
            coloring, top, foot = Coloring(coloring.colors), min(top, size[1] // 2), 0
        self.room = (0, top, size[0], size[1] - foot)
        draw_legend(self._draw, size, coloring)

    def paste_drawing(self, pixels: Singles, at: tuple[int, int]) -> None:
        """Lays a premultiplied drawing (h, w, 4) over the paper, its corner at (left, top)."""
        from PIL import Image

        part = self.image.crop((*at, at[0] + pixels.shape[1], at[1] + pixels.shape[0]))
        below = np.asarray(part, dtype=np.float32) / 255
        alpha = pixels[..., 3:]
        if self.image.mode == "RGB":
            mixed = pixels[..., :3] + below * (1 - alpha)
        else:
            mixed = np.concatenate([pixels[..., :3] / np.maximum(alpha, 1e-4), alpha], axis=2)
        levels = np.rint(np.clip(mixed, 0, 1) * 255).astype(np.uint8)
        self.image.paste(Image.fromarray(levels, self.image.mode), at)

    def write_marks(self, items: Ints, marks: Mapping[int, str], at: tuple[int, int]) -> None:
        """Writes texts on items seen at (left, top)."""
        if marks:
            draw_marks(self._draw, items, marks, at, self.size)

    def write_message(self, text: str, box: tuple[int, int, int, int]) -> None:
        """Writes a text into the middle of a box."""
        left, top, right, bottom = box
        size = round(20 * unit(self.size))
        self._draw.text(((left + right) / 2, (top + bottom) / 2), text, fill=FAINT, font=font(size), anchor="mm")

    def write_view_name(self, text: str, at: tuple[int, int]) -> None:
        """Writes the name of a view into the corner at (left, top)."""
        u = unit(self.size)
        self._draw.text((at[0] + 16 * u, at[1] + 8 * u), text, fill=FAINT, font=font(round(13 * u)), anchor="lt")


def _paper(size: tuple[int, int], background: str | None) -> Any:
    from PIL import Image

    if background is None:
        return Image.new("RGBA", size, (0, 0, 0, 0))
    try:
        top, bottom = (rgb(c) for c in (_LIGHT if background == "light" else (background, background)))
    except ValueError:
        raise UsageError(
            f"{background!r} is no background", remedy="Use `light` or a colour such as #FFFFFF."
        ) from None
    share = np.linspace(0, 1, size[1])[:, None, None]
    levels = np.rint((top * (1 - share) + bottom * share) * 255).astype(np.uint8)
    return Image.fromarray(np.broadcast_to(levels, (size[1], size[0], 3)).copy())
