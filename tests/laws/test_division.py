"""Laws of hulls that are divided where the kind of what lies in them changes, and of fine pieces of a surface."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshforge.common import GeometryError
from meshforge.geometry import (
    Box,
    Polytope,
    Pose,
    convex_hull,
    decompose_finely,
    divide,
    overlap_volume,
    volume_of_union,
)

sizes = st.floats(0.05, 0.5).map(lambda x: round(x, 3))
boxes = st.builds(lambda a, b, c, x, y, z: box((x, y, z), (a, b, c)), *[sizes] * 3, *[st.floats(-1, 1)] * 3)


def box(middle: tuple[float, float, float], half: tuple[float, float, float]) -> Polytope:
    return Box(Pose(np.eye(3), np.array(middle, dtype=float)), np.array(half, dtype=float)).tessellate()


def around(pieces: list[Polytope]) -> Polytope:
    return convex_hull(np.concatenate([piece.vertices for piece in pieces]))


@settings(max_examples=40, deadline=None)
@given(st.lists(boxes, min_size=2, max_size=5), st.data())
def test_parts_lie_within_the_hull_and_hold_all_that_it_has(pieces: list[Polytope], data: st.DataObject) -> None:
    hull = around(pieces)
    kinds = np.eye(3)[[data.draw(st.integers(0, 2)) for _ in pieces]]
    parts = divide(hull, pieces, kinds)
    assert volume_of_union([hull, *(part.shape for part in parts)]) == pytest.approx(hull.volume, rel=1e-6)
    held = volume_of_union(pieces)
    both = volume_of_union([part.shape for part in parts])
    assert volume_of_union([*pieces, *(part.shape for part in parts)]) == pytest.approx(both, abs=1e-3 * held)
    for part in parts:
        assert part.shares.sum() == pytest.approx(1.0)


@settings(max_examples=30, deadline=None)
@given(boxes, sizes)
def test_a_gap_between_two_kinds_sets_them_apart(first: Polytope, gap: float) -> None:
    away = np.array([float(np.ptp(first.vertices[:, 0])) + gap, 0, 0])
    second = Polytope(first.vertices + away, first.faces)
    parts = divide(around([first, second]), [first, second], np.eye(2))
    assert [part.kind for part in sorted(parts, key=lambda part: part.shape.centroid[0])] == [0, 1]
    for part in parts:
        assert part.shape.volume == pytest.approx(first.volume, rel=1e-6), "tight around what lies in it"


def test_a_small_thin_sheet_stays_covered() -> None:
    sheets = [box((x, 0, 0), (1e-5, half, half)) for x, half in ((-1, 1), (0, 0.3), (1, 1))]
    parts = divide(around(sheets), sheets, np.eye(2)[[0, 1, 0]])
    sides = sorted(float(part.shape.aabb.size[1]) for part in parts)
    assert sides == pytest.approx([0.6, 2.0, 2.0], abs=1e-3)


@settings(max_examples=30, deadline=None)
@given(st.lists(boxes, min_size=1, max_size=4))
def test_one_kind_is_not_divided(pieces: list[Polytope]) -> None:
    hull = around(pieces)
    (part,) = divide(hull, pieces, np.ones((len(pieces), 1)))
    assert part.shape.volume == pytest.approx(hull.volume)


def test_a_hull_in_which_nothing_lies_stays_and_has_no_kind() -> None:
    (part,) = divide(box((0, 0, 0), (1, 1, 1)), [box((5, 0, 0), (1, 1, 1))], np.eye(2)[:1])
    assert not part.shares.any()


def surface(solids: list[Polytope]) -> tuple[np.ndarray, np.ndarray]:
    starts = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    faces = [solid.faces + start for solid, start in zip(solids, starts, strict=False)]
    return np.concatenate([solid.vertices for solid in solids]), np.concatenate(faces)


@settings(max_examples=30, deadline=None)
@given(st.lists(boxes, min_size=1, max_size=4))
def test_each_convex_solid_of_a_surface_is_a_piece_of_its_own(solids: list[Polytope]) -> None:
    pieces = [piece.shape for piece in decompose_finely(*surface(solids))]
    assert volume_of_union(pieces) == pytest.approx(volume_of_union(solids), rel=1e-6)
    for piece in pieces:
        most = max(overlap_volume(piece, solid) for solid in solids)
        assert most == pytest.approx(piece.volume, rel=1e-6), "no piece reaches over two solids"


def test_a_t_is_cut_where_its_stem_begins() -> None:
    import manifold3d

    bar = manifold3d.Manifold.cube((0.6, 0.1, 0.1), True)
    stem = manifold3d.Manifold.cube((0.1, 0.1, 0.5), True).translate((0, 0, -0.25))
    mesh = (bar + stem).to_mesh()
    found = decompose_finely(np.asarray(mesh.vert_properties)[:, :3].astype(float), np.asarray(mesh.tri_verts))
    pieces = [piece.shape for piece in found]
    below = [piece for piece in pieces if piece.aabb.min[2] < -0.06]
    assert below
    assert max(piece.aabb.max[2] for piece in below) == pytest.approx(-0.05, abs=2e-3)


def test_nothing_that_has_an_area_is_named() -> None:
    with pytest.raises(GeometryError, match="no triangles"):
        decompose_finely(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    with pytest.raises(GeometryError, match="flat"):
        decompose_finely(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float), np.array([[0, 1, 2]]))
