"""Thumbnails: which hull a pixel shows, how bright it is, how much of it is covered."""

from pathlib import Path

import numpy as np

from meshforge.geometry import Ints, Pose
from meshforge.rendering import render_thumbnail
from meshforge.rendering.id_buffer import ThumbnailPixels
from meshforge.symbolic import Asset, Document, NonConvexPiece, Surface, SymbolicMesh
from tests.id_buffer import render_id_buffer
from tests.unit.rendering.scenes import box, hull, table


def shown(pixels: ThumbnailPixels) -> Ints:
    """The index of the hull that each pixel shows, -1 for none."""
    found: Ints = pixels[..., 0].astype(np.int64) * 256 + pixels[..., 1] - 1
    return found


def behind(mesh: SymbolicMesh, *surfaces: Surface) -> SymbolicMesh:
    opaque = tuple(NonConvexPiece("piece", "body", "it is open", surface) for surface in surfaces)
    return SymbolicMesh(mesh.hulls, Asset(Path("a.obj"), "obj", (), (), Document(), non_convex=opaque))


def test_pixels_tell_the_hull_that_rays_through_their_centres_meet() -> None:
    pixels, items = render_thumbnail(table(), size=(160, 120)), render_id_buffer(table(), size=(160, 120))
    assert np.array_equal(shown(pixels)[items >= 0], items[items >= 0])
    covered = pixels[..., 3] == 255
    assert np.array_equal(shown(pixels)[covered], items[covered])
    assert np.array_equal(pixels[..., 3] > 0, shown(pixels) >= 0)


def test_a_hull_beyond_the_255th_is_told_by_two_bytes() -> None:
    row = tuple(hull(f"h{k}", box((0.1 * k, 0, 0), (0.1, 8, 8))) for k in range(300))
    pixels = render_thumbnail(SymbolicMesh(row), size=(600, 200), view="front")
    assert shown(pixels).max() == 299
    assert set(range(300)) <= set(shown(pixels).ravel())


def test_hulls_are_framed_and_lit_with_lines_between_them() -> None:
    pixels = render_thumbnail(table())
    assert pixels.shape == (180, 240, 4)
    rows, columns = np.nonzero(pixels[..., 3])
    assert rows.min() > 3
    assert columns.max() < 236
    assert max(np.ptp(rows) / 180, np.ptp(columns) / 240) > 0.8
    top = (shown(pixels) == 0) & (pixels[..., 3] == 255)
    light = pixels[..., 2][top]
    assert np.median(light) > 200
    assert light.min() < 0.7 * np.median(light)


def test_round_hulls_are_shaded_smoothly() -> None:
    ball = SymbolicMesh((table().hull_of("knob"),))
    light = render_thumbnail(ball)[..., 2][60:120, 80:160].astype(int)
    assert len(np.unique(light)) > 30
    assert np.abs(np.diff(light, axis=1)).max() < 12


def test_opaque_pieces_are_drawn_without_a_hull() -> None:
    wall = Surface(np.array([[-1, 1, 0], [1, 1, 0], [0, 1, 2.0]]), np.array([[0, 1, 2]]))
    pixels = render_thumbnail(behind(table(), wall))
    bare = (shown(pixels) == -1) & (pixels[..., 3] == 255)
    assert bare.sum() > 500
    assert (pixels[..., 2][bare] > 0).all()
    assert set(shown(pixels).ravel()) == {-1, 0, 1, 2, 3, 4}


def test_a_mesh_with_nothing_to_show_is_an_empty_picture() -> None:
    assert not render_thumbnail(SymbolicMesh(())).any()
    assert not render_thumbnail(behind(SymbolicMesh(()), Surface(np.zeros((0, 3)), np.zeros((0, 3), int)))).any()


def test_a_pose_turns_what_is_shown() -> None:
    turn = Pose([[1, 0, 0], [0, 0, -1], [0, 1, 0]], (0, 0, 0))
    lying = SymbolicMesh(tuple(h.move(turn.inverse()) for h in table().hulls))
    assert not np.array_equal(render_thumbnail(lying), render_thumbnail(table()))
    differing = np.mean(render_thumbnail(lying, turn) != render_thumbnail(table()))
    assert differing < 0.01
