from dataclasses import replace

import numpy as np
import pytest

from meshforge.checks.clearance import measure_clearance
from meshforge.geometry import Aabb, Box
from meshforge.symbolic import Surface, SymbolicMesh
from tests.cups import BOTTOM, INSIDE, LID, WALLS, WHOLE, cup


def test_hulls_that_fit_close_and_open_nothing() -> None:
    found = measure_clearance(cup(BOTTOM, *WALLS))
    assert found is not None
    assert (found.closed, found.opened, found.findings) == (0.0, 0.0, ())


def test_a_filled_cup_is_told_with_its_volume_place_and_hull() -> None:
    found = measure_clearance(cup(WHOLE))
    assert found is not None
    assert found.closed == pytest.approx(INSIDE, rel=0.08)
    assert found.doubled[0] == pytest.approx(INSIDE, rel=0.16)
    (region,) = found.regions
    assert region.kind == "closed" and region.hulls == ("h0",)
    assert region.bounds.center == pytest.approx([0.05, 0.05, 0.055], abs=0.003)
    (finding,) = found.findings
    assert (
        finding.rule == "clearance-closed" and "free and reachable in the visual mesh, closed by h0" in finding.message
    )


@pytest.mark.parametrize("cell", [0.0037, 0.0019, 0.00093])
def test_the_error_is_no_more_than_a_cell_along_the_walls(cell: float) -> None:
    found = measure_clearance(cup(WHOLE), cell=cell)
    assert found is not None and found.cell == pytest.approx(cell)
    walls = 0.08 * 0.08 + 4 * 0.08 * 0.09
    assert abs(found.closed - INSIDE) <= walls * cell * 1000


def test_a_lid_closes_what_no_hull_fills() -> None:
    found = measure_clearance(cup(BOTTOM, *WALLS, LID))
    assert found is not None
    inner = max(found.regions, key=lambda region: region.litres)
    assert inner.litres == pytest.approx(INSIDE, rel=0.2)
    assert "h5" in inner.hulls or inner.hulls == ()


def test_a_handle_s_eye_that_is_filled_is_found() -> None:
    frame = [
        Box.of_bounds(Aabb([0, 0, 0], [0.1, 0.01, 0.01])),
        Box.of_bounds(Aabb([0, 0, 0.05], [0.1, 0.01, 0.06])),
        Box.of_bounds(Aabb([0, 0, 0.01], [0.01, 0.01, 0.05])),
        Box.of_bounds(Aabb([0.09, 0, 0.01], [0.1, 0.01, 0.05])),
    ]
    filled = Box.of_bounds(Aabb([0, 0, 0], [0.1, 0.01, 0.06]))
    found = measure_clearance(cup(filled, shown=frame))
    assert found is not None
    assert found.closed == pytest.approx(0.08 * 0.01 * 0.04 * 1000, rel=0.2)
    well = measure_clearance(cup(*frame, shown=frame))
    assert well is not None and well.closed == 0.0


def test_an_edit_is_held_against_the_hulls_before() -> None:
    before, after = cup(WHOLE), cup(BOTTOM, *WALLS)
    opened, closed = measure_clearance(after, before), measure_clearance(before, after)
    assert opened is not None and closed is not None
    assert opened.closed == 0.0 and opened.opened == pytest.approx(INSIDE, rel=0.05)
    assert closed.closed == pytest.approx(INSIDE, rel=0.05) and closed.opened == 0.0
    assert opened.findings[0].rule == "clearance-opened"


def test_windings_and_doubled_faces_of_what_is_shown_do_not_matter() -> None:
    plain = cup(WHOLE)
    assert plain.asset is not None
    corners = np.concatenate([s.vertices[s.faces] for s in plain.asset.visuals])

    odd = np.concatenate([corners, corners[:, ::-1]])
    shown = Surface(odd.reshape(-1, 3), np.arange(3 * len(odd)).reshape(-1, 3), "cup")
    other = SymbolicMesh.of(replace(plain.asset, visuals=(shown,)))
    first, second = measure_clearance(plain), measure_clearance(other)
    assert first is not None and second is not None and first.to_json() == second.to_json()


def test_without_a_visual_mesh_there_is_nothing_to_say() -> None:
    assert measure_clearance(cup(WHOLE, shown=())) is None
    assert measure_clearance(cup(shown=())) is None
    assert measure_clearance(cup()) is None


def test_a_visual_mesh_that_is_not_finite_is_left_out() -> None:
    mesh = cup(WHOLE)
    assert mesh.asset is not None

    broken = Surface(np.full((3, 3), np.nan), np.array([[0, 1, 2]]), "cup")
    found = measure_clearance(SymbolicMesh.of(replace(mesh.asset, visuals=(*mesh.asset.visuals, broken))))
    assert found is not None and found.closed == pytest.approx(INSIDE, rel=0.08)


@pytest.mark.slow
def test_a_grid_never_grows_without_bound() -> None:
    found = measure_clearance(cup(WHOLE), cell=1e-7)
    assert found is not None and 0.1 / found.cell < 400
