"""Regions of a surface between its concave edges, and the fine pieces that are of each."""

from __future__ import annotations

from itertools import chain

import numpy as np
import pytest
from manifold3d import Manifold

from meshforge.geometry import Floats, Ints, Polytope, decompose_finely
from meshforge.geometry.decomposition.creases import drop_degenerate
from meshforge.geometry.decomposition.regions import find_regions, group_by_region


def block(size: tuple[float, float, float], middle: tuple[float, float, float]) -> Manifold:
    return Manifold.cube(size, True).translate(middle)


PLATE = block((0.6, 0.6, 0.05), (0, 0, 0))
ROUND = Manifold.cylinder(0.4, 0.2, 0.2, 48)
POST = block((0.1, 0.1, 0.4), (0.1, 0, 0.2))


def surface(solid: Manifold) -> tuple[Floats, Ints]:
    mesh = solid.to_mesh()
    return np.asarray(mesh.vert_properties)[:, :3].astype(float), np.asarray(mesh.tri_verts).astype(np.int64)


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
