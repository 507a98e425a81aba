"""Pictures as files."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image

from meshforge.common import UsageError
from meshforge.rendering import encode_webp, render, write_picture, write_png
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


@pytest.mark.parametrize(("name", "kind"), [("a.png", "PNG"), ("a.jpg", "JPEG"), ("a.JPEG", "JPEG")])
def test_a_picture_is_written_as_its_suffix_says(tmp_path: Path, name: str, kind: str) -> None:
    image = render(table(), size=(80, 60), background=None)
    write_picture(tmp_path / name, image)
    with Image.open(tmp_path / name) as found:
        assert (found.format, found.size) == (kind, (80, 60))
        white = found.convert("RGBA").getpixel((79, 0))
        assert white == ((0, 0, 0, 0) if kind == "PNG" else (255, 255, 255, 255))


@pytest.mark.parametrize(
    ("name", "problem"), [("a.gif", ".gif is no picture that can be written"), ("picture", "it has no suffix")]
)
def test_another_suffix_names_what_can_be_written(tmp_path: Path, name: str, problem: str) -> None:
    with pytest.raises(UsageError) as raised:
        write_picture(tmp_path / name, render(table(), size=(16, 16), legend=False))
    assert raised.value.problem == problem
    assert raised.value.remedy == "Pictures end in .png, .jpg, .jpeg."
    assert not any(tmp_path.iterdir())
