"""Pictures in which certain hulls can be seen."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.rendering import ThumbnailPixels, render_revealing, render_thumbnail
from meshforge.symbolic import SymbolicMesh
from tests.unit.rendering.scenes import box, hull, table

SIZE = (160, 120)


def pixels_of(picture: ThumbnailPixels, place: int) -> int:
    """How many pixels show the hull in a place."""
    return int((picture[..., 0].astype(int) * 256 + picture[..., 1] == place + 1).sum())


def test_what_is_seen_from_the_usual_side_is_shown_from_there() -> None:
    mesh = table()
    names = [hull.name for hull in mesh.hulls][:1]
    assert np.array_equal(render_revealing(mesh, names, size=SIZE), render_thumbnail(mesh, size=SIZE))
    assert np.array_equal(render_revealing(mesh, ["unknown"], size=SIZE), render_thumbnail(mesh, size=SIZE))
    assert np.array_equal(render_revealing(mesh, [], size=SIZE), render_thumbnail(mesh, size=SIZE))


@pytest.mark.parametrize("at", [(0, -1, 0), (0, 1, 0), (-1, 0, 0), (1, 0, 0), (0, 0, -1)])
def test_what_a_wall_hides_is_shown_from_another_side(at: tuple[int, int, int]) -> None:
    aside = [0.8 * part for part in at]
    wall = hull("wall", box((0, 0, 0), [0.2 if part else 3.0 for part in at]))
    mesh = SymbolicMesh((wall, hull("button", box(aside, (0.4, 0.4, 0.4)))))
    picture = render_revealing(mesh, ["button"], size=SIZE)
    known = [render_thumbnail(mesh, size=SIZE, view="iso"), render_thumbnail(mesh, size=SIZE, view="iso", through=[1])]
    assert pixels_of(picture, 1) > 40
    if pixels_of(known[0], 1) < 40:
        assert not any(np.array_equal(picture, one) for one in known)  # another side, not through the wall


def test_what_is_hidden_from_every_side_is_seen_through_what_hides_it_half_of_the_pixels() -> None:
    mesh = SymbolicMesh((hull("outer", box((0, 0, 0), (1, 1, 1))), hull("inner", box((0, 0, 0), (0.5, 0.5, 0.5)))))
    picture, alone = render_revealing(mesh, ["inner"], size=SIZE), render_thumbnail(mesh, size=SIZE)
    assert pixels_of(alone, 1) == 0
    shown = pixels_of(picture, 1)
    assert shown > 300
    rows, columns = np.nonzero(picture[..., 1] == 2)
    assert set((rows + columns) % 2) == {0}
    area = (np.ptp(rows) + 1) * (np.ptp(columns) + 1)
    assert shown < 0.5 * area
    assert pixels_of(picture, 0) + shown == pixels_of(alone, 0)


def test_of_hulls_that_are_not_asked_for_nothing_changes() -> None:
    mesh = SymbolicMesh((
        hull("outer", box((0, 0, 0), (1, 1, 1))),
        hull("inner", box((0, 0, 0), (0.5, 0.5, 0.5))),
        hull("other", box((0, 0, 0), (0.4, 0.4, 0.4))),
    ))  # fmt: skip
    assert pixels_of(render_revealing(mesh, ["inner"], size=SIZE), 2) == 0
