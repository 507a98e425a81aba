"""Pictures as files."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image

from meshforge.common import UsageError
from meshforge.rendering import encode_webp, render, write_png
from tests.unit.rendering.scenes import table


def test_a_png_is_read_back_pixel_by_pixel(tmp_path: Path) -> None:
    image = render(table(), size=(80, 60), legend=False)
    write_png(tmp_path / "deep" / "picture.png", image)
    with Image.open(tmp_path / "deep" / "picture.png") as found:
        assert found.tobytes() == image.tobytes()


def test_a_webp_keeps_transparency_and_is_small() -> None:
    image = render(table(), size=(320, 240), legend=False, background=None)
    data = encode_webp(image)
    with Image.open(BytesIO(data)) as found:
        assert found.convert("RGBA").getpixel((0, 0)) == (0, 0, 0, 0)
    assert len(data) < 30_000


def test_a_picture_that_cannot_be_written_is_a_usage_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UsageError, match="cannot be written"):
        write_png(tmp_path / "file" / "picture.png", render(table(), size=(16, 16), legend=False))
