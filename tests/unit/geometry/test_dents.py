"""Surfaces that nearly fill their hulls: with a hole or a dent they are none, with rounding and noise they are.
Surfaces with so many faces that convexity is judged edge by edge, and points that rise above them, by groups."""

import numpy as np
import pytest
from manifold3d import Manifold

from meshforge.geometry import Floats, Ints, convex_hull, is_convex, split_pieces
from meshforge.geometry import surface as room
from meshforge.geometry.surface import planes_of, rises_above
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


@pytest.fixture
def ball() -> Floats:
    points = np.random.default_rng(0).normal(size=(6000, 3))
    return np.asarray(points / np.linalg.norm(points, axis=1, keepdims=True))


def test_the_hull_of_thousands_of_points_on_a_ball_has_them_all(ball: Floats) -> None:
    hull = convex_hull(ball)
    assert len(hull.vertices) * len(hull.faces) > room._MOST_PAIRS_CHECKED
    assert len(hull.vertices) == len(ball)


@pytest.mark.parametrize("depth", [1e-6, 0.5])
def test_one_dent_among_thousands_of_faces_is_found(ball: Floats, depth: float) -> None:
    hull = convex_hull(ball)
    dented = hull.vertices.copy()
    dented[17] *= 1 - 0.01 - depth
    assert is_convex(hull.vertices, hull.faces, 1e-8)
    assert not is_convex(dented, hull.faces, 1e-8)


def test_judging_by_edges_and_by_all_pairs_agree(ball: Floats, monkeypatch: pytest.MonkeyPatch) -> None:
    hull = convex_hull(ball[:500])
    rng = np.random.default_rng(1)
    for size in (0.0, 1e-7, 1e-3):
        moved = hull.vertices + size * rng.normal(size=hull.vertices.shape)
        monkeypatch.setattr(room, "_MOST_PAIRS_CHECKED", 50_000_000)
        by_pairs = is_convex(moved, hull.faces)
        monkeypatch.setattr(room, "_MOST_PAIRS_CHECKED", 0)
        assert is_convex(moved, hull.faces) == by_pairs == (size < 1e-5)


def cloud(rng: np.random.Generator, round_: bool) -> Floats:
    points = rng.normal(size=(700, 3)) * [1, 2, 0.1]
    return np.asarray(points / np.linalg.norm(points, axis=1)[:, None]) if round_ else points


def highest(points: Floats, vertices: Floats, faces: Ints) -> float:
    planes = planes_of(vertices, faces)
    return float(((points - planes.middle) @ planes.normals.T - planes.offsets).max())


@pytest.mark.parametrize("round_", [True, False])
def test_groups_find_what_rises_as_all_pairs_do(round_: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "_MOST_PAIRS_AT_ONCE", 0)
    rng = np.random.default_rng(1)
    for _ in range(20):
        hull = convex_hull(cloud(rng, round_))
        points = cloud(rng, round_) * rng.uniform(0.5, 1.1)
        top = highest(points, hull.vertices, hull.faces)
        assert rises_above(points, hull.vertices, hull.faces, top - 1e-9)
        assert not rises_above(points, hull.vertices, hull.faces, top + 1e-9)
