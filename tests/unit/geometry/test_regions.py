"""Regions of a surface between its concave edges, and the fine pieces that are of each. What a surface encloses: how
much shapes have of it, the hulls of that, and surfaces that enclose nothing."""

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from manifold3d import Manifold

from meshforge.geometry import Polytope, decompose_finely
from meshforge.geometry.decomposition.creases import drop_degenerate
from meshforge.geometry.decomposition.regions import (
    FinePiece,
    find_regions,
    find_solids,
    list_region_solids,
    number_pieces,
    turn_outward,
)
from meshforge.geometry.decomposition.triangles import clean_triangles
from meshforge.geometry.interior import Interior
from meshforge.geometry.shape import volume_and_centroid
from meshforge.geometry.surface import has_border, is_closed
from tests.unit.geometry.solids import block, surface

PLATE = block((0.6, 0.6, 0.05), (0, 0, 0))
ROUND = Manifold.cylinder(0.4, 0.2, 0.2, 48)
POST = block((0.1, 0.1, 0.4), (0.1, 0, 0.2))


def count(solid: Manifold) -> int:
    vertices, faces = surface(solid)
    return len(np.unique(find_regions(vertices, drop_degenerate(vertices, faces))))


@pytest.mark.parametrize(
    ("solid", "regions"),
    [
        (PLATE, 1),
        (ROUND, 1),
        (PLATE + POST, 2),
        (PLATE + POST + POST.translate((-0.2, 0, 0)), 3),
        (PLATE - POST.translate((0, 0, -0.1)), 1),
        (PLATE - POST, 2),
        (PLATE + block((0.1, 0.6, 0.4), (0.1, 0, 0.2)), 1),
    ],
    ids=[
        "a box",
        "a round rod",
        "a post on a plate",
        "two posts",
        "a hole",
        "a pocket, whose floor is apart",
        "a flush wall",
    ],
)
def test_a_region_ends_at_concave_edges(solid: Manifold, regions: int) -> None:
    assert count(solid) == regions


def shapes_of(pieces: Sequence[FinePiece]) -> list[Polytope]:
    return [piece.shape for piece in pieces]


def numbers_of(pieces: Sequence[FinePiece]) -> list[tuple[int, int]]:
    return [(piece.region, piece.solid) for piece in pieces]


def test_each_piece_has_the_region_it_is_of() -> None:
    pieces = decompose_finely(*surface(PLATE + POST))
    assert {piece.solid for piece in pieces} == {0}
    heights = [{round(float(piece.shape.aabb.min[2]), 3) for piece in pieces if piece.region == k} for k in (0, 1)]
    assert sorted(map(min, heights)) == pytest.approx([-0.025, 0.025], abs=1e-3)
    assert max(map(len, heights)) == 1


def test_solids_apart_are_regions_apart_and_no_piece_is_lost() -> None:
    both = Manifold.compose([PLATE + POST, block((0.2, 0.2, 0.2), (1, 0, 0))])
    vertices, faces = surface(both)
    pieces = shapes_of(decompose_finely(vertices, faces))
    found = number_pieces(pieces, vertices, faces)
    assert sorted(set(numbers_of(found))) in ([(0, 0), (1, 0), (2, 1)], [(0, 0), (1, 1), (2, 1)])
    assert sorted(map(id, shapes_of(found))) == sorted(map(id, pieces))
    assert [piece.region for piece in found] == sorted(piece.region for piece in found), "region by region"


def test_a_cavity_is_of_the_solid_around_it() -> None:
    tin = block((0.4, 0.4, 0.4), (0, 0, 0)) - block((0.3, 0.3, 0.3), (0, 0, 0))
    vertices, faces = surface(Manifold.compose([tin, block((0.1, 0.1, 0.1), (0, 0, 0))]))
    assert sorted(map(len, find_solids(vertices, faces))) == [12, 24]


TIN = block((0.4, 0.4, 0.4), (0, 0, 0)) - block((0.3, 0.3, 0.3), (0, 0, 0))
BESIDE = block((0.1, 0.1, 0.1), (1, 0, 0))


@pytest.mark.parametrize("solid", [PLATE + POST, TIN, Manifold.compose([TIN, BESIDE])], ids=["one", "hollow", "two"])
def test_a_surface_that_is_inside_out_is_turned(solid: Manifold) -> None:
    vertices, faces = surface(solid)
    mesh = clean_triangles(vertices, faces)
    assert turn_outward(mesh) is mesh
    turned = turn_outward(clean_triangles(vertices, faces[:, ::-1]))
    assert volume_and_centroid(turned.vertices, turned.faces)[0] == pytest.approx(solid.volume())
    assert len(find_solids(turned.vertices, turned.faces)) == len(find_solids(vertices, faces))


def test_one_solid_of_two_that_is_inside_out_is_turned_and_a_cavity_is_not() -> None:
    (one, one_faces), (two, two_faces) = surface(TIN), surface(BESIDE)
    faces = np.concatenate([one_faces, two_faces[:, ::-1] + len(one)])
    turned = turn_outward(clean_triangles(np.concatenate([one, two]), faces))
    assert volume_and_centroid(turned.vertices, turned.faces)[0] == pytest.approx(TIN.volume() + BESIDE.volume())


def test_an_open_surface_is_left_as_it_is() -> None:
    vertices, faces = surface(PLATE)
    mesh = clean_triangles(vertices, faces[1:, ::-1])
    assert turn_outward(mesh) is mesh


def test_pieces_of_a_surface_inside_out_are_those_of_the_surface() -> None:
    vertices, faces = surface(PLATE + POST)
    inward, outward = decompose_finely(vertices, faces[:, ::-1]), decompose_finely(vertices, faces)
    assert len(inward) == len(outward) == 2
    for one, other in zip(inward, outward, strict=True):
        assert one.shape.volume == pytest.approx(other.shape.volume)


def test_a_piece_that_lies_nowhere_near_goes_with_the_nearest_region() -> None:
    vertices, faces = surface(PLATE + POST)
    (away,) = shapes_of(decompose_finely(*surface(block((0.1, 0.1, 0.1), (0.1, 0, 3)))))
    (top,) = shapes_of(decompose_finely(*surface(block((0.08, 0.08, 0.1), (0.1, 0, 0.35)))))
    found = number_pieces([away, top], vertices, faces)
    assert shapes_of(found) == [away, top] and numbers_of(found) == [(0, 0), (0, 0)]


def test_flat_triangles_do_not_count() -> None:
    vertices, faces = surface(PLATE + POST)
    flat = np.vstack([faces, [[faces[0, 0], faces[0, 1], faces[0, 0]]]])
    assert len(drop_degenerate(vertices, flat)) == len(faces)
    piece = Polytope(*surface(POST))
    (found,) = number_pieces([piece], vertices, flat)
    assert found.shape is piece


def solids_of(solid: Manifold) -> list[float]:
    found = list_region_solids(*surface(solid))
    assert all(mesh.open_edges == 0 and is_closed(mesh.faces) for mesh in found)
    return sorted(volume_and_centroid(mesh.vertices, mesh.faces)[0] for mesh in found)


def test_each_region_encloses_a_solid_where_its_holes_are_closed() -> None:
    assert solids_of(PLATE + POST) == pytest.approx([0.1 * 0.1 * 0.375, 0.6 * 0.6 * 0.05], rel=1e-5)
    two = PLATE + POST + POST.translate((-0.2, 0, 0))
    assert solids_of(two) == pytest.approx([0.1 * 0.1 * 0.375] * 2 + [0.6 * 0.6 * 0.05], rel=1e-5)


def test_a_hollow_is_taken_from_the_region_around_it() -> None:
    """A closed tin with a knob: floor, walls and top of the inside are regions that enclose nothing."""
    tin = block((0.4, 0.4, 0.4), (0, 0, 0)) - block((0.3, 0.3, 0.3), (0, 0, 0))
    knob = block((0.1, 0.1, 0.2), (0, 0, 0.3))
    assert solids_of(tin + knob) == pytest.approx([0.1 * 0.1 * 0.2, 0.4**3 - 0.3**3], rel=1e-5)


@pytest.mark.parametrize(
    "solid",
    [PLATE, PLATE - POST, block((0.4, 0.4, 0.4), (0, 0, 0)) - block((0.3, 0.3, 0.3), (0, 0, 0))],
    ids=["a box", "a pocket", "a hollow"],
)
def test_where_one_region_encloses_all_there_are_no_solids_of_regions(solid: Manifold) -> None:
    assert solids_of(solid) == []


def test_an_open_surface_has_no_solids_of_regions() -> None:
    vertices, faces = surface(PLATE + POST)
    assert list_region_solids(vertices, faces[:-1]) == []


def test_no_piece_reaches_over_the_edge_between_two_regions() -> None:
    """A stub on a leaf, a thirtieth as thick: CoACD by itself makes one piece of both."""
    leaf, plate = block((1.0, 0.05, 2.0), (0, 0, 0)), block((0.2, 0.01, 0.1), (-0.3, 0.03, 0.4))
    pieces = shapes_of(decompose_finely(*surface(leaf + plate)))
    assert sum(piece.volume for piece in pieces) == pytest.approx(0.1 + 0.2 * 0.01 * 0.1, rel=0.01)
    assert all(piece.aabb.max[1] < 0.026 or piece.aabb.min[1] > 0.024 for piece in pieces)


RING = block((1.0, 1.0, 0.2), (0, 0, 0)) - block((0.6, 0.6, 1.0), (0, 0, 0))


def shape(solid: Manifold) -> Polytope:
    return Polytope(*surface(solid))


def test_of_a_shape_it_measures_what_is_enclosed() -> None:
    inside = Interior(*surface(RING))
    assert inside.measure(shape(block((1.0, 1.0, 0.2), (0, 0, 0)))) == pytest.approx(0.2 * (1 - 0.36), rel=1e-6)
    assert inside.measure(shape(block((0.5, 0.5, 0.2), (0, 0, 0)))) == pytest.approx(0.0, abs=1e-12)


def test_a_shape_that_is_filled_stays_as_it_is() -> None:
    small = shape(block((0.1, 0.1, 0.1), (0.4, 0, 0)))
    assert Interior(*surface(RING)).list_hulls([small]) == [small]


def test_a_surface_is_clipped_to_what_is_within() -> None:
    inside, within = Interior(*surface(RING)), surface(block((0.1, 0.1, 0.1), (0.4, 0, 0)))
    assert inside.clip(*within) == within
    vertices, faces = inside.clip(*surface(block((1.0, 1.0, 0.2), (0, 0, 0))))
    assert is_closed(faces)
    assert volume_and_centroid(vertices, faces)[0] == pytest.approx(0.2 * (1 - 0.36), rel=1e-6)
    _, none = inside.clip(*surface(block((0.1, 0.1, 0.1), (5, 0, 0))))
    assert len(none) == 0


@given(st.lists(st.integers(0, 31), min_size=1, unique=True))
def test_everything_is_within_a_surface_that_encloses_nothing(chosen: list[int]) -> None:
    """manifold3d itself may crash on a surface with a border."""
    vertices, faces = surface(RING)
    assert len(faces) == 32
    own, piece = faces[np.sort(chosen)], shape(block((2.0, 0.1, 0.1), (0, 0, 0)))
    assert has_border(own) == (len(own) < len(faces))
    if has_border(own):
        inside = Interior(vertices, own)
        assert inside.measure(piece) == piece.volume
        assert inside.list_hulls([piece]) == [piece]


def test_a_surface_turned_inside_out_encloses_nothing() -> None:
    vertices, faces = surface(RING)
    assert Interior(vertices, faces[:, ::-1]).measure(shape(RING.hull())) == pytest.approx(0.2, rel=1e-6)
