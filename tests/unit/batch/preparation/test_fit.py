import re

import numpy as np
import pytest

from meshforge.batch.preparation.decompose import describe_fit
from meshforge.checks import measure_kept_space
from meshforge.formats.meshfile.surface import stack_triangles
from meshforge.geometry import Aabb, Box, Polytope
from meshforge.symbolic import Surface


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Polytope:
    return Box.of_bounds(Aabb(low, high)).tessellate()


WHOLE = box((0, 0, 0), (4, 1, 1))
SURFACE = Surface(WHOLE.vertices, WHOLE.faces)


CUP = [
    box((0, 0, 0), (4, 4, 0.4)),
    *(box(low, high) for low, high in (((0, 0, 0), (0.4, 4, 4)), ((3.6, 0, 0), (4, 4, 4)))),
    *(box(low, high) for low, high in (((0, 0, 0), (4, 0.4, 4)), ((0, 3.6, 0), (4, 4, 4)))),
]
"""The bottom and four walls of a cup, open above."""
WALLS = Surface(*stack_triangles((part.vertices, part.faces) for part in CUP))


@pytest.mark.parametrize(
    ("hulls", "told"),
    [
        (CUP, "5 hulls, 100% of the free space stays free"),
        ([box((0, 0, 0), (4, 4, 4))], "1 hull, 0% of the free space stays free"),
        ([*CUP, box((0.4, 0.4, 0.4), (2, 3.6, 4))], "6 hulls, 50% of the free space stays free"),
        (CUP[1:], "4 hulls, 100% of the free space stays free, 10% of the surface outside"),
    ],
    ids=["as it is", "filled", "half filled", "without its bottom"],
)
def test_free_space_that_is_lost_and_surface_that_is_off_are_said(hulls: list[Polytope], told: str) -> None:
    found = describe_fit(WALLS, hulls)
    number = re.compile(r"(\d+)%")
    assert number.sub("%", found) == number.sub("%", told)
    for own, wanted in zip(number.findall(found), number.findall(told), strict=True):
        assert float(own) == pytest.approx(float(wanted), abs=4)


def test_an_open_shell_that_is_thin_is_measured_as_well_as_a_solid_one() -> None:
    """By its volume a bowl of one sheet has almost none, so that any hulls of it had many times more."""
    sheet = Surface(WALLS.vertices, WALLS.faces[12:])  # walls alone
    assert measure_kept_space(sheet, CUP[1:]) == pytest.approx(1.0, abs=0.01)
    assert measure_kept_space(sheet, [box((0, 0, 0), (4, 4, 4))]) == pytest.approx(0.0, abs=0.01)


def test_where_nothing_is_free_no_share_is_said() -> None:
    assert describe_fit(SURFACE, [WHOLE]) == "1 hull"
    assert describe_fit(SURFACE, [box((0, 0, 0), (3, 1, 1))]) == "1 hull, 26% of the surface outside"
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 1e-9], [0, 1, 0]], float)
    both = Surface(square, np.array([[0, 1, 2], [0, 2, 3], [0, 2, 1], [0, 3, 2]]))
    assert describe_fit(both, [box((0, 0, -1e-3), (1, 1, 1e-3))]) == "1 hull"
