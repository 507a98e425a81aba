"""Pieces of surfaces: what holds together, and what counts as a hull."""

import numpy as np
import pytest

from meshforge.common import GeometryError
from meshforge.geometry import Ints, Piece, split_pieces
from meshforge.geometry import pieces as room
from tests.soups import CORNERS, Soup, box, together, turned, unindexed, welded

DOUBLE_SIDED = (box()[0], np.concatenate([box()[1], turned(box())[1]]))
OPEN_BOX = (box()[0], box()[1][2:])
L_SHAPE = together(box(), box((1, 0, 0)), box((0, 1, 0)))


def found(soup: Soup, groups: Ints | None = None) -> list[Piece]:
    made = split_pieces(soup[0], soup[1], name="soup", groups=groups)
    covered = np.concatenate([p.face_indices for p in made])
    assert sorted(covered.tolist()) == list(range(len(soup[1]))), "every face belongs to one piece"
    return made


def volumes(soup: Soup, groups: Ints | None = None) -> list[float]:
    return [round(p.shape.volume, 6) if p.shape else -1.0 for p in found(soup, groups)]


@pytest.mark.parametrize(
    ("soup", "expected"),
    [
        pytest.param(box(), [1], id="a box"),
        pytest.param(turned(box()), [1], id="an inside-out box"),
        pytest.param((box()[0], np.concatenate([box()[1][:5], box()[1][5:, ::-1]])), [1], id="mixed winding"),
        pytest.param(OPEN_BOX, [1], id="a planar hole is filled"),
        pytest.param(DOUBLE_SIDED, [1], id="a double-sided box is one"),
        pytest.param(together(box(), turned(box())), [1], id="a double-sided box with vertices of its own"),
        pytest.param(together(box(), box()), [1, 1], id="exact duplicates stay"),
        pytest.param(together(box(), box((3, 0, 0))), [1, 1], id="boxes apart"),
        pytest.param(together(box(), box((1, 0, 0))), [1, 1], id="boxes that share a wall, not its vertices"),
        pytest.param(together(box(), box((0.5, 0, 0))), [1, 1], id="boxes that overlap"),
    ],
)
@pytest.mark.parametrize(
    "form", [lambda s: s, lambda s: (s[0], s[1][:, [1, 2, 0]])], ids=["as it is", "corners turned"]
)
def test_boxes_are_found_as_the_hulls_they_are(soup: Soup, expected: list[float], form: type) -> None:
    assert volumes(form(soup)) == expected


TOUCHING = {
    "a corner": box((1, 1, 1)),
    "an edge": box((1, 1, 0)),
    "a wall": box((1, 0, 0)),
    "a wall cut the other way": (box((1, 0, 0))[0], np.concatenate([[[0, 1, 2], [1, 3, 2]], box()[1][2:]])),
    "part of an edge": box((1, 1, 0), (1, 1, 2)),
}


@pytest.mark.parametrize("other", TOUCHING.values(), ids=TOUCHING.keys())
@pytest.mark.parametrize("form", [welded, unindexed], ids=["shared vertices", "no vertices shared"])
@pytest.mark.parametrize("shuffled", [False, True], ids=["one after the other", "mixed"])
@pytest.mark.parametrize("inward", [False, True], ids=["outward", "inside out"])
def test_boxes_that_touch_stay_apart_sharing_places(other: Soup, form: type, shuffled: bool, inward: bool) -> None:
    vertices, faces = together(box(), other)
    if shuffled:
        faces = np.random.default_rng(5).permutation(faces)
    soup = form((vertices, faces[:, ::-1] if inward else faces))
    assert sorted(volumes(soup)) == sorted([1.0, round(float(np.prod(np.ptp(other[0], axis=0))), 6)])


def test_the_pieces_come_in_the_order_of_their_first_face() -> None:
    vertices, faces = together(box(size=(1, 1, 1)), box((5, 0, 0), (2, 1, 1)))
    assert volumes((vertices, np.roll(faces, 3, axis=0))) == [2, 1]


def test_places_that_nearly_agree_are_welded_where_that_closes_a_hull() -> None:
    vertices, faces = unindexed(box((10, 10, 10)))
    noise = np.random.default_rng(1).uniform(-1e-9, 1e-9, vertices.shape)
    assert volumes((vertices + noise, faces)) == [1]


def test_a_surface_that_covers_its_hull_is_one_however_carelessly_it_is_cut() -> None:
    both_ways = np.array([[0, 1, 3], [0, 3, 2], [1, 3, 2], [0, 1, 2]])  # a side with both diagonals
    assert volumes((CORNERS, np.concatenate([box()[1], both_ways]))) == [1]


def test_a_piece_is_a_hull_from_95_percent_on() -> None:
    def dented(depth: float) -> Soup:
        dent = np.array([[0.5, 0.5, 1 - depth]])  # takes a third of its depth from the volume
        around = np.array([[1, 5, 8], [5, 7, 8], [7, 3, 8], [3, 1, 8]])
        return np.concatenate([CORNERS, dent]), np.concatenate([box()[1][:10], around])

    assert found(dented(0.03))[0].shape is not None
    assert found(dented(0.14))[0].reason == "not convex: fills 95% of its convex hull, but has a hole or dent"
    assert found(dented(0.16))[0].reason == "not convex: fills 94% of its convex hull"


def test_an_l_shape_in_one_surface_is_not_convex() -> None:
    outline = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], dtype=float)
    vertices = np.array([[x, y, z] for z in (0.0, 1.0) for x, y in outline])
    cap = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    side = [t for k in range(6) for t in ((k, (k + 1) % 6, 6 + (k + 1) % 6), (k, 6 + (k + 1) % 6, 6 + k))]
    faces = np.array([(c, b, a) for a, b, c in cap] + [(a + 6, b + 6, c + 6) for a, b, c in cap] + side)
    (piece,) = found((vertices, faces))
    assert (piece.shape, piece.reason) == (None, "not convex: fills 85% of its convex hull")


def test_a_surface_without_volume_is_flat() -> None:
    (piece,) = found((np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), np.array([[0, 1, 2], [0, 2, 3]])))
    assert (piece.shape, piece.reason) == (None, "flat")


def test_a_surface_with_a_bent_hole_is_open() -> None:
    (piece,) = found((box()[0], np.delete(box()[1], [0, 4, 10], axis=0)))
    assert (piece.shape, piece.reason) == (None, "open: it has a hole that is not planar")


def test_groups_that_cut_one_surface_are_read_across() -> None:
    assert volumes(box(), groups=np.arange(12) // 2) == [1]


def test_groups_hold_hulls_apart_that_share_vertices() -> None:
    soup = welded(together(box(), box((1, 0, 0))))
    made = found(soup, groups=np.repeat([0, 1], 12))
    assert [(p.group, p.shape is not None) for p in made] == [(0, True), (1, True)]


def test_a_group_may_hold_several_hulls() -> None:
    soup = together(box(), box((3, 0, 0)), box((6, 0, 0)))
    assert [p.group for p in found(soup, groups=np.repeat([0, 1], [24, 12]))] == [0, 0, 1]


def test_hulls_open_towards_each_other_are_told_apart_by_groups() -> None:
    soup = welded(together((box()[0], np.delete(box()[1], [2, 3], axis=0)), box((1, 0, 0), (2, 1, 1))))
    assert volumes(soup, groups=np.repeat([0, 1], [10, 12])) == [1, 2]


def test_triangles_without_area_go_with_the_piece_they_touch() -> None:
    vertices, faces = together(box(), box((3, 0, 0)))
    made = found((vertices, np.concatenate([faces, [[8, 8, 9], [0, 0, 0]]])))
    assert [24 in p.face_indices for p in made] == [False, True]
    assert [25 in p.face_indices for p in made] == [True, False]


def test_a_face_that_is_there_very_often_still_counts_once() -> None:
    vertices, faces = together(box(), box((3, 0, 0)))
    assert volumes((vertices, np.concatenate([faces, np.repeat(faces[:1], 256, axis=0)]))) == [1, 1]


def test_an_empty_surface_has_no_pieces() -> None:
    assert split_pieces(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64), name="nothing") == []


def test_a_vertex_that_no_face_has_may_be_anything() -> None:
    vertices, faces = box()
    assert volumes((np.concatenate([vertices, [[np.nan, np.inf, 0]]]), faces)) == [1]


def test_a_coordinate_that_is_not_finite_is_refused_by_name() -> None:
    vertices, faces = box()
    with pytest.raises(GeometryError, match="leg: a coordinate is not a finite number"):
        split_pieces(np.where(vertices == 1, np.nan, vertices), faces, name="leg")


def test_an_index_without_vertex_is_refused_by_name() -> None:
    with pytest.raises(GeometryError, match="leg: a face names a vertex that is not there"):
        split_pieces(box()[0], box()[1] + 1, name="leg")


def test_pieces_do_not_depend_on_place_and_scale() -> None:
    soup = unindexed(L_SHAPE)
    for scale, shift in ((1.0, 0.0), (1e-4, 0.0), (1e3, 5e4), (1.0, -100.0)):
        assert [p.shape is not None for p in found((soup[0] * scale + shift, soup[1]))] == [True] * 3


ROW = [(0, 0, 0), (3, 0, 0), (6, 0, 0)]


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
    again = split_pieces(kept, faces, name="b")[0]
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
