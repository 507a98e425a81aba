"""Pieces of triangles that were read before: the same, shared, and safe from writing."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import convex_hull, split_pieces
from meshforge.geometry import pieces as room
from tests.soups import box, together

ROW = [(0, 0, 0), (3, 0, 0), (6, 0, 0)]


def test_triangles_read_before_give_the_same_shapes() -> None:
    vertices, faces = together(*map(box, ROW))
    first, again = (split_pieces(np.array(vertices), np.array(faces), name=name) for name in ("a", "b"))
    assert [p.shape for p in first] == [p.shape for p in again]
    assert first is not again


def test_other_numbers_and_other_groups_are_read_anew() -> None:
    vertices, faces = together(*map(box, ROW))
    first = split_pieces(vertices, faces, name="a")
    moved = split_pieces(np.asarray(vertices) + 1e-9, faces, name="a")
    grouped = split_pieces(vertices, faces, name="a", groups=np.repeat([0, 1, 2], len(faces) // 3))
    assert all(p.shape is not q.shape for p, q in zip(first, moved, strict=True))
    assert [p.group for p in first] == [0, 0, 0]
    assert [p.group for p in grouped] == [0, 1, 2]


def test_what_is_remembered_does_not_change_with_the_arrays_it_was_read_from() -> None:
    corners, triangles = box((0, 0, 0))
    vertices, faces = np.array(corners, dtype=float), np.array(triangles)
    first = split_pieces(vertices, faces, name="a")[0]
    kept = np.array(vertices)
    vertices += 5
    again = split_pieces(kept, faces, name="a")[0]
    assert first.shape is not None
    assert again.shape is first.shape
    assert (again.vertices.min(axis=0) == 0).all()
    with pytest.raises(ValueError, match="read-only"):
        again.vertices[0, 0] = 9.0


def test_the_oldest_of_very_many_triangles_are_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "_MOST_KNOWN", 70)
    soups = [box((0.5 + k, 0, 0)) for k in range(3)]  # 12 triangles each, and what a piece takes beside them
    first = [split_pieces(*soup, name="a")[0].shape for soup in soups]
    again = [split_pieces(*soup, name="a")[0].shape for soup in reversed(soups)][::-1]
    assert [shape is other for shape, other in zip(first, again, strict=True)] == [False, True, True]


def test_a_soup_of_more_triangles_than_are_remembered_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "_MOST_KNOWN", 1)
    hull = convex_hull(np.asarray(box((0.5, 0, 9))[0]))
    assert all(split_pieces(hull.vertices, hull.faces, name="a")[0].shape for _ in range(2))
