from __future__ import annotations

import numpy as np
import pytest

from meshforge.batch.preparation.decompose import describe_fit, measure_uncovered
from meshforge.geometry import Aabb, Box, Polytope
from meshforge.symbolic import Surface


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Polytope:
    return Box.of_bounds(Aabb(low, high)).tessellate()


WHOLE = box((0, 0, 0), (4, 1, 1))
SURFACE = Surface(WHOLE.vertices, WHOLE.faces)


@pytest.mark.parametrize(
    ("hulls", "told"),
    [
        ([WHOLE], "1 hull, the same volume"),
        ([box((0, 0, 0), (2, 1, 1)), box((2, 0, 0), (4, 1, 1))], "2 hulls, the same volume"),
        ([box((0, 0, 0), (4, 1, 1.2))], "1 hull, 20% more volume"),
        ([box((0, 0, 0), (3, 1, 1))], "1 hull, 25% less volume, 26% of the surface outside"),
    ],
)
def test_volume_and_surface_that_are_off_are_told(hulls: list[Polytope], told: str) -> None:
    assert describe_fit(SURFACE, hulls, solid=True) == told


def test_what_overlaps_counts_once() -> None:
    assert describe_fit(SURFACE, [WHOLE, WHOLE], solid=True) == "2 hulls, the same volume"


def test_what_is_no_solid_has_no_volume_to_compare() -> None:
    assert describe_fit(SURFACE, [WHOLE], solid=False) == "1 hull"
    open_above = Surface(SURFACE.vertices, SURFACE.faces[(SURFACE.vertices[SURFACE.faces][:, :, 2] < 1).any(axis=1)])
    bent = open_above.vertices.copy()
    bent[np.argmax(bent.sum(axis=1)), 2] += 0.2  # the hole is not planar any more
    assert "volume" not in describe_fit(Surface(bent, open_above.faces), [WHOLE], solid=True)


def test_two_sides_of_one_sheet_have_no_volume_to_compare() -> None:
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 1e-9], [0, 1, 0]], float)
    both = Surface(square, np.array([[0, 1, 2], [0, 2, 3], [0, 2, 1], [0, 3, 2]]))
    assert describe_fit(both, [box((0, 0, -1e-3), (1, 1, 1e-3))], solid=True) == "1 hull"


def test_the_share_outside_is_that_of_the_area() -> None:
    assert measure_uncovered(SURFACE, []) == 1.0
    assert measure_uncovered(SURFACE, [WHOLE]) == 0.0
    assert measure_uncovered(SURFACE, [box((0, 0, 0), (2, 1, 1))]) == pytest.approx(0.5, abs=0.02)
