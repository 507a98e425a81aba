"""Names of hulls on pictures: names where they fit, else numbers with a legend that has all names."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

import numpy as np
from PIL import ImageDraw

from meshforge.rendering import encode_png, render
from meshforge.symbolic import SymbolicMesh
from tests.id_buffer import render_id_buffer
from tests.unit.rendering.scenes import box, hull, pixels, table

SIZE = (640, 360)


@contextmanager
def written() -> Iterator[list[str]]:
    """The texts that are written on pictures meanwhile."""
    texts: list[str] = []
    write = ImageDraw.ImageDraw.text

    def note(draw: Any, at: Any, text: str, *rest: Any, **more: Any) -> None:
        texts.append(text)
        write(draw, at, text, *rest, **more)

    with patch.object(ImageDraw.ImageDraw, "text", note):
        yield texts


def wall(count: int, name: str = "a_piece_of_the_wall_{}") -> SymbolicMesh:
    """Narrow boards beside each other, and one behind them that is not seen from the front."""
    boards = [hull(name.format(k), box((k, 0, 0), (0.9, 0.1, 8))) for k in range(count)]
    return SymbolicMesh((*boards, hull(name.format("behind"), box((0, 1, 0), (0.2, 0.1, 0.2)))))


def test_names_that_fit_stand_on_the_hulls_as_info_lists_them() -> None:
    with written() as texts:
        image = render(table(), size=SIZE, names=True, legend=False)
    assert sorted(texts) == ["knob", "left", "leg0", "leg1", "right"]
    assert image.size == SIZE


def test_a_hull_that_is_hidden_is_listed_below() -> None:
    mesh = SymbolicMesh(wall(2, "board{}").hulls)
    with written() as texts:
        image = render(mesh, views=("front",), size=SIZE, names=True, legend=False)
    assert {"board0", "board1", "Hidden or too small here:", "#2  boardbehind"} == set(texts)
    assert image.width == SIZE[0] and image.height > SIZE[1]


def test_where_names_do_not_fit_there_are_numbers_and_a_legend_with_all_names() -> None:
    mesh = wall(20)
    with written() as texts:
        image = render(mesh, views=("front",), size=SIZE, names=True, legend=False)
    assert {str(k) for k in range(20)} <= set(texts) and "20" not in texts
    assert [text for text in texts if text.startswith("#")] == [f"#{k}  {h.name}" for k, h in enumerate(mesh.hulls)]
    assert any("Grey: hidden or too small here." in text for text in texts)
    drawing, plain = pixels(image)[: SIZE[1]], pixels(render(mesh, views=("front",), size=SIZE, legend=False))
    away = render_id_buffer(mesh, view="front", size=SIZE) < 0
    assert np.abs(drawing - plain)[away].mean() < 0.05, "the drawing stays where it was, as large as it was"


def test_a_hull_that_one_of_the_views_shows_is_not_grey() -> None:
    with written() as texts:
        render(wall(20), views=("front", "back"), size=(1400, 400), names=True, legend=False)
    assert "20" in texts and not any("hidden" in text for text in texts)


def test_pictures_with_names_are_the_same_bytes_every_time_and_may_be_transparent() -> None:
    one, two = (render(wall(20), size=SIZE, names=True, background=None) for _ in range(2))
    assert encode_png(one) == encode_png(two)
    assert one.mode == "RGBA" and one.getpixel((one.width - 1, one.height - 1)) == (0, 0, 0, 0)


def test_a_mesh_without_hulls_has_no_names() -> None:
    assert render(SymbolicMesh(()), size=SIZE, names=True).size == SIZE
