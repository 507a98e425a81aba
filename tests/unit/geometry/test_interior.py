"""What a surface encloses: how much shapes have of it, the hulls of that, and surfaces that enclose nothing."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from manifold3d import Manifold

from meshforge.geometry import Polytope
from meshforge.geometry.interior import Interior
from meshforge.geometry.shape import volume_and_centroid
from meshforge.geometry.surface import has_border, is_closed
from tests.unit.geometry.solids import block, surface

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
