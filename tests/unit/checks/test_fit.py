from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest

from meshforge.checks.fit import FitCheck, draw_fit, measure_fit
from meshforge.checks.legality import find_oddities
from meshforge.geometry import Floats, Pose, Shape
from meshforge.rendering import LengthUnit
from meshforge.rendering.colors import HullColors, LegendEntry
from meshforge.symbolic import Body, Hull, Joint, SymbolicMesh
from tests.cups import BOTTOM, WALLS, WHOLE, cup, surface
from tests.unit.language.scenes import box


def test_hulls_that_fit_stick_out_nowhere_and_leave_nothing_bare() -> None:
    found = measure_fit(cup(BOTTOM, *WALLS))
    assert found.out < found.cell and found.bare < 1e-9
    assert found.bare_share == 0.0 and found.findings == ()


def test_a_hull_that_sticks_out_is_told_by_how_much() -> None:
    long = box([0, 0, 0], [0.15, 0.1, 0.01])
    found = measure_fit(cup(long, *WALLS))
    by_name = {row.hull: row for row in found.hulls}
    assert by_name["h0"].out == pytest.approx(0.05, rel=0.01)
    assert by_name["h0"].out_area == pytest.approx(2 * 0.05 * 0.1 + 2 * 0.05 * 0.01 + 0.1 * 0.01, rel=0.1)
    assert by_name["h1"].out < found.cell
    (finding,) = found.findings
    assert finding.hulls == ("h0",) and finding.message == "h0 (0.05 m): sticks out of the visual mesh"


def test_what_fills_a_cup_sticks_out_into_its_inside() -> None:
    (row,) = measure_fit(cup(WHOLE)).hulls
    assert row.out == pytest.approx(0.04, rel=0.02)  # the middle of the opening, from the walls


@pytest.mark.slow
def test_a_visual_surface_without_a_hull_is_bare_beside_the_nearest_one() -> None:
    found = measure_fit(cup(BOTTOM, *WALLS[:3]))
    assert found.bare == pytest.approx(0.04, rel=0.01)  # the middle of the wall, from the walls beside it
    bare = {row.hull for row in found.hulls if row.bare_area > 0}
    assert bare and found.bare_share == pytest.approx(sum(row.bare_area for row in found.hulls) / found.seen_area)
    assert {f.rule for f in found.findings} == {"fit-bare"}


def test_a_hull_is_held_against_its_own_body() -> None:
    found = measure_fit(cup(BOTTOM, *WALLS, box([1, 1, 1], [2, 2, 2]), bodies=["cup"] * 5 + ["other"]))
    assert found.silent == ("other",)
    assert [row.hull for row in found.hulls] == ["h0", "h1", "h2", "h3", "h4"]


@pytest.mark.parametrize(("bodies", "bare"), [(["cup", "cup"], ["lid"]), (["cup", "lid"], [])])
def test_a_body_that_shows_something_without_hulls_is_named(bodies: list[str], bare: list[str]) -> None:
    mesh = cup(box([0, 0, 0], [1, 1, 1]), box([0, 0, 1], [1, 1, 2]), bodies=bodies)
    assert mesh.asset
    visuals = [replace(one, body=body) for one in mesh.asset.visuals for body in ("cup", "lid")]
    shown = replace(mesh, asset=replace(mesh.asset, visuals=tuple(visuals)))
    found = [one.message for one in FitCheck().examine(shown, None) if one.rule == "fit-no-hulls"]
    assert found == [f"nothing collides of what these bodies show: {name}" for name in bare]


@pytest.mark.parametrize(("height", "bare"), [(0.0, False), (0.5, True)])
def test_a_body_without_hulls_is_named_beside_what_it_is_welded_to_if_not_covered(height: float, bare: bool) -> None:
    weld = Joint("", "fixed", "cup", "lid", np.zeros(3), np.array([1.0, 0.0, 0.0]), None)
    mesh = cup(box([0, 0, 0], [1, 1, 1]), joints=[weld], shown=())
    assert mesh.asset
    lid = surface([box([0, 0, height], [1, 1, 1 + height])], "lid")
    bodies = (*mesh.asset.bodies, Body("lid", Pose.identity()))
    shown = replace(mesh, asset=replace(mesh.asset, bodies=bodies, visuals=(lid,)))
    assert ("fit-no-hulls" in [one.rule for one in FitCheck().examine(shown, None)]) is bare


def test_nothing_shown_is_told_not_an_error() -> None:
    found = measure_fit(cup(WHOLE, shown=()))
    assert found.hulls == () and not found.description and found.findings == ()
    assert draw_fit(cup(WHOLE, shown=()), found) is None


def test_the_heat_map_is_hot_where_the_hull_sticks_out() -> None:
    mesh = cup(box([0, 0, 0], [0.1, 0.1, 0.3]), shown=[WHOLE])
    found = measure_fit(mesh)
    pair = draw_fit(mesh, found, size=(200, 150))
    assert pair is not None
    pixels = np.asarray(pair[0].convert("RGB")).astype(int).reshape(-1, 3)
    hot = (pixels[:, 0] > pixels[:, 1] + 20).sum()
    cool = np.asarray(pair[1].convert("RGB")).astype(int).reshape(-1, 3)
    legend = (cool[:, 0] > cool[:, 1] + 20).sum()
    assert hot > 3 * legend > 0


def test_the_legend_of_a_heat_map_has_the_unit_that_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    legends: list[list[str]] = []
    ends: dict[LengthUnit, list[str]] = {
        "m": ["below 0.00332 m", "above 0.0133 m"],
        "mm": ["below 3.32 mm", "above 13.3 mm"],
    }

    def note(colors: Floats, legend: tuple[LegendEntry, ...] = ()) -> HullColors:
        legends.append([entry.name for entry in legend])
        return HullColors(colors, legend)

    monkeypatch.setattr(import_module("meshforge.rendering.comparison"), "HullColors", note)
    mesh = cup(box([0, 0, 0], [0.1, 0.1, 0.3]), shown=[WHOLE])
    for unit, wanted in ends.items():
        assert draw_fit(mesh, measure_fit(mesh), size=(200, 150), unit=unit)
        assert [legends[-1][0], legends[-1][-1]] == wanted


def rules(*shapes: Shape) -> dict[str, tuple[str, ...]]:
    hulls = tuple(Hull(f"h{k}", "body", shape) for k, shape in enumerate(shapes))
    return {f.rule: f.hulls for f in find_oddities(SymbolicMesh(hulls))}


CUBE = box([0, 0, 0], [1, 1, 1])


@pytest.mark.parametrize(
    ("shapes", "expected"),
    [
        ([CUBE], {}),
        ([box([0, 0, 0], [1, 1, 0.021])], {}),
        ([box([0, 0, 0], [1, 1, 0.019])], {"shape-sliver": ("h0",)}),
        ([box([0, 0, 0], [19, 1, 1])], {}),
        ([box([0, 0, 0], [21, 1, 1])], {"shape-oblong": ("h0",)}),
        ([CUBE, box([0.2, 0.2, 0.2], [0.6, 0.6, 0.6])], {"shape-inner": ("h1",)}),
        ([CUBE, box([1, 0, 0], [2, 1, 1])], {}),
        ([CUBE, box([0.7, 0, 0], [1.7, 1, 1])], {"shape-overlap": ("h0", "h1")}),
        ([CUBE, box([0.8, 0, 0], [1.8, 1, 1])], {}),
        ([CUBE, box([1.01, 0, 0], [2, 1, 1])], {"shape-gap": ("h0", "h1")}),
        ([CUBE, box([1.1, 0, 0], [2, 1, 1])], {}),
    ],
)
def test_odd_hulls_and_pairs_are_named(shapes: list[Shape], expected: dict[str, tuple[str, ...]]) -> None:
    assert rules(*shapes) == expected


def test_pairs_of_two_bodies_are_no_oddity() -> None:
    hulls = Hull("a", "one", CUBE), Hull("b", "two", box([0.5, 0, 0], [1.5, 1, 1]))
    assert find_oddities(SymbolicMesh(hulls)) == ()
