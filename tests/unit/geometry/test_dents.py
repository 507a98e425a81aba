"""Surfaces that nearly fill their hulls: with a hole or a dent they are none, with rounding and noise they are."""

from __future__ import annotations

import numpy as np
import pytest
from manifold3d import Manifold

from meshforge.geometry import split_pieces
from tests.soups import box, together, turned, unindexed, welded
from tests.unit.geometry.solids import block, surface

DENTED = "not convex: fills {}% of its convex hull, but has a hole or dent"


def reasons(solid: Manifold) -> list[str | None]:
    return [piece.reason for piece in split_pieces(*surface(solid), name="solid")]


def rod(radius: float, length: float, at: tuple[float, float, float] = (0, 0, 0)) -> Manifold:
    return Manifold.cylinder(length, radius, radius, 24, True).translate(at)


@pytest.mark.parametrize(
    ("solid", "share"),
    [
        (block((10, 10, 3), (0, 0, 0)) - block((2, 2, 9), (0, 0, 0)), 96),  # right through
        (block((10, 10, 10), (0, 0, 0)) - block((3, 3, 3), (0, 0, 4)), 97),  # a pocket
        (block((10, 10, 10), (0, 0, 0)) - rod(0.45, 30, (4.5, 0, 0)), 99),  # close to a side: only its genus tells
        (Manifold.sphere(5, 96) - rod(0.5, 20), 98),  # of many triangles
    ],
)
def test_a_hole_or_a_pocket_that_a_peg_enters_is_never_closed(solid: Manifold, share: int) -> None:
    assert reasons(solid) == [DENTED.format(share)]


@pytest.mark.parametrize(
    "solid",
    [
        block((10, 10, 1), (0, 0, 0)) - rod(0.05, 9, (4, 4, 0)),  # of a nail
        block((10, 10, 1), (0, 0, 0)) - rod(0.2, 9, (4, 4, 0)) - rod(0.2, 9, (-4, 4, 0)),  # of dowels
        block((10, 4, 0.2), (0, 0, 0)) - block((20, 0.1, 0.1), (0, 1.8, 0.1)),  # a groove
        block((10, 10, 10), (0, 0, 0)) - rod(0.2, 30, (4.75, 0, 0)),  # close to a side
    ],
)
def test_a_hull_that_closes_narrow_holes_says_what_it_fills(solid: Manifold) -> None:
    (piece,) = split_pieces(*surface(solid), name="board")
    assert piece.shape is not None
    assert piece.fill == pytest.approx(solid.volume() / piece.shape.volume)


def test_a_hole_is_seen_however_its_surface_is_written() -> None:
    plate = surface(block((10, 10, 3), (0, 0, 0)) - block((2, 2, 9), (0, 0, 0)))
    both_sides = together(plate, turned(plate))
    mixed = plate[1].copy()
    mixed[::3] = mixed[::3, ::-1]
    for soup in (turned(plate), unindexed(plate), both_sides, welded(both_sides), (plate[0], mixed)):
        assert [piece.reason for piece in split_pieces(*soup, name="plate")] == [DENTED.format(96)]


def test_rounded_chamfered_and_filleted_solids_stay_hulls() -> None:
    ball = Manifold.sphere(0.5, 24)
    rounded = block((10, 6, 2), (0, 0, 0)).minkowski_sum(ball)
    foot = rod(3, 8) + Manifold.cylinder(0.2, 3.15, 3.0, 24).translate((0, 0, -4))  # a fillet around its base
    assert reasons(rounded) == [None]
    assert reasons(foot) == [None]


def test_noise_of_a_scan_is_no_dent() -> None:
    vertices, faces = surface(Manifold.sphere(1, 64))
    rough = vertices * (1 + 0.005 * np.random.default_rng(0).standard_normal((len(vertices), 1)))
    (piece,) = split_pieces(rough, faces, name="scan")
    assert piece.shape is not None


def test_a_dented_solid_is_told_from_the_hulls_that_it_touches() -> None:
    plate = surface(block((10, 10, 3), (0, 0, 0)) - block((2, 2, 9), (0, 0, 0)))
    found = split_pieces(*together(plate, box((5, -5, -1.5), (1, 10, 3))), name="two")
    assert [piece.reason for piece in found] == [DENTED.format(96), None]
