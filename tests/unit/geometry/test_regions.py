"""Regions of a surface between its concave edges, and the fine pieces that are of each."""

from __future__ import annotations

from itertools import chain

import numpy as np
import pytest
from manifold3d import Manifold

from meshforge.geometry import Polytope, decompose_finely
from meshforge.geometry.decomposition.creases import drop_degenerate
from meshforge.geometry.decomposition.regions import find_regions, group_by_region, list_region_solids
from meshforge.geometry.shape import volume_and_centroid
from meshforge.geometry.surface import is_closed
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


def test_pieces_are_grouped_by_the_region_they_are_of() -> None:
    regions = decompose_finely(*surface(PLATE + POST))
    plate, post = sorted(regions, key=lambda own: min(float(piece.aabb.min[2]) for piece in own))
    assert all(piece.aabb.max[2] < 0.03 for piece in plate)
    assert all(piece.aabb.min[2] > 0.02 for piece in post)


def test_solids_apart_are_regions_apart_and_no_piece_is_lost() -> None:
    both = Manifold.compose([PLATE + POST, block((0.2, 0.2, 0.2), (1, 0, 0))])
    vertices, faces = surface(both)
    pieces = list(chain(*decompose_finely(vertices, faces)))
    found = group_by_region(pieces, vertices, faces)
    assert len(found) == 3
    assert sorted(map(id, chain(*found))) == sorted(map(id, pieces))
    assert [own[0] for own in found] == sorted((own[0] for own in found), key=pieces.index), "as they first come"


def test_a_piece_that_lies_nowhere_near_goes_with_the_nearest_region() -> None:
    vertices, faces = surface(PLATE + POST)
    (away,) = chain(*decompose_finely(*surface(block((0.1, 0.1, 0.1), (0.1, 0, 3)))))
    (top,) = chain(*decompose_finely(*surface(block((0.08, 0.08, 0.1), (0.1, 0, 0.35)))))
    assert group_by_region([away, top], vertices, faces) == ((away, top),)


def test_flat_triangles_do_not_count() -> None:
    vertices, faces = surface(PLATE + POST)
    flat = np.vstack([faces, [[faces[0, 0], faces[0, 1], faces[0, 0]]]])
    assert len(drop_degenerate(vertices, flat)) == len(faces)
    piece = Polytope(*surface(POST))
    assert group_by_region([piece], vertices, flat) == ((piece,),)


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
    pieces = list(chain(*decompose_finely(*surface(leaf + plate))))
    assert sum(piece.volume for piece in pieces) == pytest.approx(0.1 + 0.2 * 0.01 * 0.1, rel=0.01)
    assert all(piece.aabb.max[1] < 0.026 or piece.aabb.min[1] > 0.024 for piece in pieces)
