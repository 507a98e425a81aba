"""Surfaces that are no solids: holes closed before a decomposition, and sheets."""

import numpy as np
import pytest

from meshforge.common import GeometryError
from meshforge.geometry import Floats, Ints, is_closed, principal_extents
from meshforge.geometry.decomposition.engines import CoacdSettings, VhacdSettings
from meshforge.geometry.decomposition.run import decompose
from meshforge.geometry.decomposition.triangles import cap_holes, clean_triangles, is_sheet, sheet_hulls, volume_inside
from tests.unit.geometry.test_decompose import CUBE, L_SHAPE, QUICK

CORNER = L_SHAPE[0][:6], np.array([[0, 1, 3], [1, 2, 3], [0, 3, 5], [3, 4, 5]])
"""A flat corner of area 5."""


def tube(around: int = 12) -> tuple[Floats, Ints]:
    """The inner and outer wall of a tube, of radius 1 and 2, without the rings at its ends."""
    turn = np.linspace(0, 2 * np.pi, around, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    rings = [circle * (r, r, 0) + (0, 0, z) for r, z in ((1, 0), (1, 1), (2, 0), (2, 1))]
    k = np.arange(around)
    j = (k + 1) % around
    inner = [np.column_stack([k, k + around, j]), np.column_stack([j, k + around, j + around])]
    outer = [2 * around + f[:, ::-1] for f in inner]
    return np.concatenate(rings), np.concatenate([*inner, *outer])


@pytest.mark.parametrize("turn", [1, -1], ids=["outward", "inward"])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_rings_at_the_ends_of_a_tube_are_closed_as_rings(axis: int, turn: int) -> None:
    vertices, faces = tube()
    mesh, holes = cap_holes(clean_triangles(np.roll(vertices, axis, axis=1), faces[:, ::turn]))
    assert holes == 4 and is_closed(mesh.faces)
    area = 12 / 2 * np.sin(2 * np.pi / 12) * (2**2 - 1**2)
    assert volume_inside(vertices, faces[:, ::turn]) == pytest.approx(area)


def test_a_hole_that_is_not_planar_stays_open() -> None:
    vertices, faces = CUBE
    bent = vertices.copy()
    bent[0, 2] -= 0.5
    kept = faces[[k for k, face in enumerate(faces) if not (face < 4).all()]]
    mesh, holes = cap_holes(clean_triangles(bent, kept))
    assert holes == 0 and mesh.open_edges == 4


def test_holes_are_left_where_closing_them_leaves_others() -> None:
    vertices, faces = CUBE
    fan = np.concatenate([faces[2:], [[4, 5, 5 + 3]]])
    extra = np.concatenate([vertices, [[0.5, 0.5, 3.0]]])
    mesh, holes = cap_holes(clean_triangles(extra, fan))
    assert holes == 0 and len(mesh.faces) == len(fan)


def test_an_open_corner_counts_as_solid_when_it_is_closed_first() -> None:
    vertices, faces = L_SHAPE
    open_below = faces[[k for k, face in enumerate(faces) if not (face < 6).all()]]
    notes: list[str] = []
    hulls = decompose(vertices, open_below, QUICK, close=True, note=notes.append)
    assert notes == ["1 planar hole closed, so that it counts as solid"]
    assert sum(hull.volume for hull in hulls) == pytest.approx(5.0, rel=0.05)
    assert volume_inside(vertices, open_below) == pytest.approx(5.0)


def test_a_convex_sheet_is_one_thin_hull() -> None:
    square = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], float)
    assert is_sheet(square) and not is_sheet(CUBE[0])
    both_sides = np.array([[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]])
    (hull,) = sheet_hulls(square, both_sides, _never, "square")
    np.testing.assert_allclose(hull.aabb.max - hull.aabb.min, [2, 2, 1e-4 * principal_extents(square)[2][0]])


@pytest.mark.parametrize("settings", [CoacdSettings(), VhacdSettings(resolution=20000)], ids=["coacd", "vhacd"])
def test_a_sheet_with_a_corner_becomes_thin_hulls_that_leave_it_free(settings: CoacdSettings | VhacdSettings) -> None:
    turned = CORNER[0] @ np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]])
    hulls = sheet_hulls(turned, CORNER[1], lambda v, f: decompose(v, f, settings), "corner")
    thin = 1e-4 * float(principal_extents(turned)[2][0])
    assert len(hulls) > 1
    assert sum(hull.volume for hull in hulls) / thin == pytest.approx(5.0, rel=0.15)


def test_a_hole_in_a_sheet_is_not_closed() -> None:
    square = np.array([[x, y, 0.3] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    frame = np.concatenate([5 * square, square]) * (1, 1, 0)  # the hole is 4% of it
    faces = [side for k in range(4) for n in [(k + 1) % 4] for side in ((k, n, n + 4), (k, n + 4, k + 4))]
    hulls = sheet_hulls(frame, faces, lambda v, f: decompose(v, f, CoacdSettings()), "frame")
    assert len(hulls) > 1


def test_a_line_is_no_sheet_to_be_decomposed() -> None:
    line = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0]], float)
    with pytest.raises(GeometryError, match="needle"):
        sheet_hulls(line, [[0, 1, 2]], _never, "needle")


def _never(vertices: Floats, faces: Ints) -> list:  # type: ignore[type-arg]
    raise AssertionError("a convex sheet needs no engine")
