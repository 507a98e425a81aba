"""Pieces cut at creases: where a patch or a loop ends a part, at stubs, and where a cut makes loose pieces tight."""

import numpy as np
import pytest
from manifold3d import Manifold

from meshforge.geometry import Polytope, convex_hull
from meshforge.geometry.decomposition.creases import Creases, cut_at_creases, find_creases
from meshforge.geometry.interior import Interior
from tests.unit.geometry.solids import block, surface

BLOCK = block((1.0, 1.0, 0.2), (0, 0, 0))
PEG = block((0.1, 0.1, 0.1), (0.2, 0, 0.15))
TUBE = Manifold.cylinder(1.0, 0.4, 0.4, 64, True) - Manifold.cylinder(2.0, 0.37, 0.37, 64, True)
ELBOW = block((1.0, 0.2, 0.3), (0, 0, 0)) + block((0.1, 0.2, 0.2), (0.45, 0, -0.15))


def around(solid: Manifold) -> Polytope:
    return convex_hull(surface(solid)[0], name="a piece")


def crease(point: tuple[float, float, float], normal: tuple[float, float, float], size: float) -> Creases:
    """One flat patch of an area [m^2], whose samples all lie at a point."""
    points = np.tile(np.asarray(point, dtype=float), (1, 48, 1))
    across = np.asarray([normal], dtype=float)
    return Creases(points, np.array([size]), across, np.array([False]), np.array([0]), 1.5)


def heights(pieces: list[Polytope]) -> list[tuple[float, float]]:
    return sorted((round(float(p.aabb.min[2]), 3), round(float(p.aabb.max[2]), 3)) for p in pieces)


def test_a_stub_of_half_a_percent_is_cut_off() -> None:
    solid = BLOCK + PEG
    vertices, faces = surface(solid)
    parts = cut_at_creases(around(solid), find_creases(vertices, faces), Interior(vertices, faces))
    assert (-0.1, 0.1) in heights(parts)
    tight = Interior(vertices, faces).list_hulls(parts)
    assert sum(part.volume for part in tight) == pytest.approx(0.2 + 0.001, rel=1e-3)


def test_a_ring_of_a_wall_is_not_shaved_off() -> None:
    vertices, faces = surface(TUBE)
    top = crease((0, 0, 0.47), (0, 0, 1), 1.0)
    assert len(cut_at_creases(around(TUBE), top, Interior(vertices, faces))) == 1
    middle = crease((0, 0, 0.2), (0, 0, 1), 1.0)
    assert len(cut_at_creases(around(TUBE), middle, Interior(vertices, faces))) == 2


@pytest.mark.parametrize(
    ("solid", "at", "count"),
    [(ELBOW, 0.4, 2), (block((1.0, 0.2, 0.3), (0, 0, 0)), 0.4, 1), (ELBOW, -0.45, 1)],
    ids=["where the foot begins", "nothing to gain", "little to gain"],
)
def test_a_loose_piece_is_cut_where_that_makes_it_tight(solid: Manifold, at: float, count: int) -> None:
    vertices, faces = surface(solid)
    small = crease((at, 0, 0), (-1, 0, 0), 0.005)  # a twelfth of the section: that alone ends no part
    assert len(cut_at_creases(around(solid), small, Interior(vertices, faces))) == count


def test_patches_in_one_plane_end_a_part_together() -> None:
    """A box on the side of a thicker one: neither ledge has 40% of the section, both have."""
    solid = block((1.0, 1.0, 1.0), (-0.5, 0, 0)) + block((0.3, 1.0, 0.5), (0.15, 0, 0))
    found = find_creases(*surface(solid))
    ledges = np.flatnonzero(np.abs(found.points[:, :, 0]).max(axis=1) < 1e-6)
    assert len(ledges) == 2
    assert len(np.unique(found.planes[ledges])) == 1
    parts = cut_at_creases(around(solid), found, Interior(*surface(solid)))
    (thick,) = (part for part in parts if part.aabb.max[0] < 0.01)
    assert thick.volume == pytest.approx(1.0, rel=1e-3)


@pytest.mark.parametrize("surface_of", [lambda v, f: (v, f), lambda v, f: (v, f[:-2])], ids=["closed", "open"])
def test_a_cut_loses_nothing(surface_of: object) -> None:
    vertices, faces = surface(BLOCK + PEG)
    assert callable(surface_of)
    vertices, faces = surface_of(vertices, faces)
    piece = around(BLOCK + PEG)
    parts = cut_at_creases(piece, find_creases(vertices, faces), Interior(vertices, faces))
    assert sum(part.volume for part in parts) == pytest.approx(piece.volume, rel=1e-9)
