"""Pictures as bytes and files."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import UsageError
from meshforge.files import write_atomically

if TYPE_CHECKING:
    from PIL.Image import Image


def png(image: Image) -> bytes:
    """The picture as a PNG file."""
    stream = BytesIO()
    image.save(stream, "PNG", optimize=False, compress_level=6)
    return stream.getvalue()


def webp(image: Image, quality: int = 82) -> bytes:
    """The picture as a small WebP file, transparency kept."""
    stream = BytesIO()
    image.save(stream, "WEBP", quality=quality, alpha_quality=90, method=2)
    return stream.getvalue()


def write_png(path: Path, image: Image) -> None:
    """Writes a picture as a PNG file. Raises UsageError where it cannot be written."""
    try:
        write_atomically(path, png(image))
    except OSError as error:
        raise UsageError(f"the picture cannot be written: {error.strerror}", where=str(path)) from error
