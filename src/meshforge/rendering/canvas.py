"""The picture that drawings are laid on, contact sheets of several pictures, and pictures as bytes and files."""

from __future__ import annotations

import math
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from io import BytesIO
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge.common import UsageError, join_names, write_atomically
from meshforge.geometry import Ints
from meshforge.rendering import annotation
from meshforge.rendering.camera import Floats32
from meshforge.rendering.colors import HullColors, LegendEntry, rgb

if TYPE_CHECKING:
    from PIL.Image import Image


_LIGHT = ("#FFFFFF", "#EEF1F5")  # from top to bottom

_PAPER = "#FFFFFF"
_FRAME = "#DDE2E8"
_NO_COLORS: Mapping[str, str] = MappingProxyType({})


class Canvas:
    """A picture in the making. `room` (left, top, right, bottom) is what title and legend leave free."""

    def __init__(
        self,
        size: tuple[int, int],
        background: str | None,
        title: str | None,
        caption: str | None,
        coloring: HullColors,
    ) -> None:
        from PIL import ImageDraw  # lazy: 0.01 s, only pictures need it

        self.size = size
        self.image: Image = _make_background(size, background)
        self._draw = ImageDraw.Draw(self.image)
        top = annotation.draw_heading(self._draw, size, title, caption)
        foot = annotation.legend_height(coloring, size)
        if top + foot > size[1] - 8:  # a picture too small for words
            coloring, top, foot = HullColors(coloring.colors), min(top, size[1] // 2), 0
        self.room = (0, top, size[0], size[1] - foot)
        annotation.draw_legend(self._draw, size, coloring)

    def paste_drawing(self, pixels: Floats32, at: tuple[int, int]) -> None:
        """Lay a premultiplied drawing (h, w, 4) over the paper, its corner at (left, top)."""
        from PIL import Image  # lazy: 0.01 s, only pictures need it

        part = self.image.crop((*at, at[0] + pixels.shape[1], at[1] + pixels.shape[0]))
        below = np.asarray(part, dtype=np.float32) / 255
        alpha = pixels[..., 3:]
        if self.image.mode == "RGB":
            mixed = pixels[..., :3] + below * (1 - alpha)
        else:
            mixed = np.concatenate([pixels[..., :3] / np.maximum(alpha, 1e-4), alpha], axis=2)
        self.image.paste(Image.fromarray(np.rint(np.clip(mixed, 0, 1) * 255).astype(np.uint8), self.image.mode), at)

    def outline_items(self, items: Ints, colors: Mapping[int, str]) -> None:
        """Draw a line, white and then of its colour `#rrggbb`, about each of some items of the picture."""
        from PIL import Image  # lazy: 0.01 s, only pictures need it
        from scipy.ndimage import distance_transform_edt  # lazy: 0.3 s, only pictures need it

        wide = max(2.0, 3 * annotation.text_scale(self.size))
        for color in dict.fromkeys(colors.values()):
            inside = np.isin(items, [item for item, own in colors.items() if own == color])
            if not inside.any():
                continue
            away = distance_transform_edt(~inside)
            for reach, ink in ((1.6 * wide, "#FFFFFF"), (wide, color)):
                share = np.clip(reach + 0.5 - away, 0, 1) * (away > 0)
                self.image.paste(ink, (0, 0), Image.fromarray(np.rint(share * 255).astype(np.uint8)))

    def write_message(self, text: str, box: tuple[int, int, int, int]) -> None:
        """Write a text into the middle of a box."""
        left, top, right, bottom = box
        font = annotation.font(round(20 * annotation.text_scale(self.size)))
        self._draw.text(((left + right) / 2, (top + bottom) / 2), text, fill=annotation.FAINT, font=font, anchor="mm")

    def write_view_name(self, text: str, at: tuple[int, int]) -> None:
        """Write the name of a view into the corner at (left, top)."""
        u = annotation.text_scale(self.size)
        place, font = (at[0] + 16 * u, at[1] + 8 * u), annotation.font(round(13 * u))
        self._draw.text(place, text, fill=annotation.FAINT, font=font, anchor="lt")


def _make_background(size: tuple[int, int], background: str | None) -> Any:
    from PIL import Image  # lazy: 0.01 s, only pictures need it

    if background is None:
        return Image.new("RGBA", size, (0, 0, 0, 0))
    try:
        top, bottom = (rgb(c) for c in (_LIGHT if background == "light" else (background, background)))
    except ValueError:
        remedy = "Use `light` or a colour such as #FFFFFF."
        raise UsageError(f"{background!r} is no background", remedy=remedy) from None
    share = np.linspace(0, 1, size[1])[:, None, None]
    levels = np.rint((top * (1 - share) + bottom * share) * 255).astype(np.uint8)
    return Image.fromarray(np.broadcast_to(levels, (size[1], size[0], 3)).copy())


def make_contact_sheet(
    images: Sequence[Image],
    columns: int | None = None,
    titles: Sequence[str] = (),
    colors: Mapping[str, str] = _NO_COLORS,
) -> Image:
    """Return pictures in rows, `columns` in each (about as many as rows by default), centred in cells of equal size.

    titles: a line below each picture; none, or one each. colors: what the legend at the bottom says, a colour
    `#rrggbb` by its meaning. Raises UsageError where there is no picture.
    """
    from PIL import Image, ImageDraw  # lazy: 0.01 s, only pictures need it

    if not images or (titles and len(titles) != len(images)):
        raise UsageError(f"a sheet of {len(images)} pictures with {len(titles)} titles cannot be made")
    columns = columns or math.ceil(math.sqrt(len(images)))
    cell = max(i.width for i in images), max(i.height for i in images)
    unit = annotation.text_scale(cell)
    gap, words = max(4, round(10 * unit)), round(28 * unit) if titles else 0  # [px] between cells, and for a title
    rows = -(-len(images) // columns)
    size = gap + columns * (cell[0] + gap), gap + rows * (cell[1] + words + gap)
    legend = HullColors(np.zeros((0, 3)), tuple(LegendEntry(color, name) for name, color in colors.items()))
    size = size[0], size[1] + annotation.legend_height(legend, size)
    paper = Image.new("RGB", size, _PAPER)
    draw = ImageDraw.Draw(paper)
    annotation.draw_legend(draw, size, legend)
    for k, image in enumerate(images):
        x, y = gap + k % columns * (cell[0] + gap), gap + k // columns * (cell[1] + words + gap)
        at = x + (cell[0] - image.width) // 2, y + (cell[1] - image.height) // 2
        paper.paste(image, at, image if image.mode == "RGBA" else None)
        draw.rectangle((x - 1, y - 1, x + cell[0], y + cell[1]), outline=_FRAME)
        if titles:
            small = round(15 * unit)
            text = annotation.shorten(titles[k], small, cell[0])
            draw.text((x + cell[0] // 2, y + cell[1] + words // 2), text, annotation.INK, annotation.font(small), "mm")
    return paper


def encode_png(image: Image) -> bytes:
    """Return the picture as a PNG file."""
    stream = BytesIO()
    image.save(stream, "PNG", optimize=False, compress_level=6)
    return stream.getvalue()


def to_data_url(image: Image) -> str:
    """Return the picture as an address `data:…` of a small WebP file, transparency kept."""
    stream = BytesIO()
    image.save(stream, "WEBP", quality=82, alpha_quality=90, method=2)
    return f"data:image/webp;base64,{b64encode(stream.getvalue()).decode()}"


def encode_jpeg(image: Image) -> bytes:
    """Return the picture as a JPEG file; what is transparent becomes white."""
    from PIL import Image as Images  # lazy: 0.01 s, only pictures need it

    stream, paper = BytesIO(), image
    if image.mode == "RGBA":
        paper = Images.new("RGB", image.size, _PAPER)
        paper.paste(image, (0, 0), image)
    paper.save(stream, "JPEG", quality=92, subsampling=0)
    return stream.getvalue()


PICTURE_FORMATS: Mapping[str, Callable[[Image], bytes]] = {
    ".png": encode_png,
    ".jpg": encode_jpeg,
    ".jpeg": encode_jpeg,
}
"""How pictures are written, by the suffix of the file in lower case."""


def check_picture_path(path: Path) -> None:
    """Raise UsageError where the suffix of a file is not that of a picture that can be written."""
    if path.suffix.lower() not in PICTURE_FORMATS:
        what = f"{path.suffix} is no picture that can be written" if path.suffix else "it has no suffix"
        raise UsageError(what, where=str(path), remedy=f"Pictures end in {join_names(tuple(PICTURE_FORMATS))}.")


def write_picture(path: Path, image: Image) -> None:
    """Write a picture as its suffix says. Raises UsageError for another suffix, and where it cannot be written."""
    check_picture_path(path)
    write_file(path, PICTURE_FORMATS[path.suffix.lower()](image))


def write_png(path: Path, image: Image) -> None:
    """Write a picture as a PNG file. Raises UsageError where it cannot be written."""
    write_file(path, encode_png(image))


def write_file(path: Path, data: bytes) -> None:
    """Write an encoded picture. Raises UsageError where it cannot be written."""
    try:
        write_atomically(path, data)
    except OSError as error:
        raise UsageError(f"the picture cannot be written: {error.strerror}", where=str(path)) from error
