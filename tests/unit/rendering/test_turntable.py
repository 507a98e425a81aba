"""Turntables: what turns, and what stands still."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from meshforge.common import UsageError
from meshforge.rendering import draw_turn, encode_gif, list_turns
from meshforge.symbolic import SymbolicMesh
from tests.unit.rendering.scenes import box, edited, hull, pixels, table

SIZE = (80, 60)


def ink(image: Image.Image) -> tuple[float, float]:
    """The first and the last row that shows something dark."""
    rows = np.flatnonzero((pixels(image).min(axis=2) < 0.5).any(axis=1))
    return float(rows[0]), float(rows[-1])


def test_a_turn_shows_other_sides_of_the_same_thing_and_comes_back() -> None:
    turns = [*list_turns(4), 1.0]
    pictures = draw_turn(table(), turns, size=SIZE, color_by="hull")
    assert {image.size for image in pictures} == {SIZE}
    assert np.array_equal(pixels(pictures[0]), pixels(pictures[4]))
    assert len({image.tobytes() for image in pictures}) == 4


def test_the_camera_keeps_its_distance_so_that_a_post_in_the_middle_stands_still() -> None:
    post = SymbolicMesh((hull("post", box((0, 0, 0), (0.1, 0.1, 2))), hull("foot", box((0, 0, -1), (2, 1, 0.1)))))
    found = {ink(image)[0] for image in draw_turn(post, list_turns(8), size=SIZE, color_by="hull")}
    assert max(found) - min(found) <= 1, found


def test_what_has_no_hulls_says_so() -> None:
    (empty,) = draw_turn(SymbolicMesh(()), [0.0], size=SIZE, color_by="label")
    assert pixels(empty).min() < 1


def test_a_gif_has_all_pictures_for_ever_and_the_same_bytes_each_time() -> None:
    pictures = draw_turn(edited(), list_turns(6), size=SIZE, color_by="hull")
    data = encode_gif(pictures)
    assert data == encode_gif(pictures)
    with Image.open(BytesIO(data)) as read:
        frames = []
        for number in range(read.n_frames):  # type: ignore[attr-defined]
            read.seek(number)
            frames.append(read.convert("RGB"))
        assert (len(frames), read.size, read.info["loop"]) == (6, SIZE, 0)
    assert len({frame.tobytes() for frame in frames}) == 6
    for frame, picture in zip(frames, pictures, strict=True):
        assert np.abs(pixels(frame) - pixels(picture)).mean() < 0.03
    with pytest.raises(UsageError, match="no pictures"):
        encode_gif([])
