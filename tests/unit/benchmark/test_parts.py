"""What the criterion on parts lets through, and what it refuses, on a small table made by hand."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from benchmark.assets.asset import Asset, Site
from benchmark.criteria import Case, judge
from meshforge.geometry import Aabb, Box, Pose, Shape, convex_hull
from meshforge.symbolic import Hull, Label, SymbolicMesh
from script.samples.part import Part
from script.samples.solids import Point, block

Corners = tuple[Point, Point]
TOP: Corners = ((-0.5, -0.3, 0.7), (0.5, 0.3, 0.74))
SHELF: Corners = ((-0.45, -0.25, 0.3), (0.45, 0.25, 0.33))
LEGS: list[Corners] = [
    ((x - 0.03, y - 0.03, 0.0), (x + 0.03, y + 0.03, 0.7)) for x in (-0.45, 0.45) for y in (-0.25, 0.25)
]
CRUMB: Corners = ((0.1, 0.1, 0.74), (0.14, 0.13, 0.77))
SITE = Site("knob", (0.0, 0.0, 0.8), (0.01, 0.01, 0.01))


def box(corners: Corners) -> Box:
    return Box.of_bounds(Aabb(np.array(corners[0]), np.array(corners[1])))


def hull(name: str, label: str, shape: Shape) -> Hull:
    return Hull(name, "body", shape, Label(label))


def halves(corners: Corners, label: str, name: str) -> list[Hull]:
    """A box as two hulls, one above the other."""
    (x, y, z), (a, b, c) = corners
    middle = (z + c) / 2
    boxes = [((x, y, z), (a, b, middle)), ((x, y, middle), (a, b, c))]
    return [hull(f"{name}{k}", label, box(row).tessellate()) for k, row in enumerate(boxes)]


BEFORE = [
    *halves(TOP, "panel", "top"),
    *halves(SHELF, "panel", "shelf"),
    *(one for k, leg in enumerate(LEGS) for one in halves(leg, "leg", f"leg{k}")),
    hull("crumb", "misc", box(CRUMB).tessellate()),
]
PARTS = [("top", "panel", TOP), ("shelf", "panel", SHELF), ("crumb", "misc", CRUMB)]
PARTS += [(f"leg_{k}", "leg", leg) for k, leg in enumerate(LEGS)]
ASSET = Asset(
    "table_01",
    "table",
    "plain",
    False,
    "",
    tuple(Part(name, label, block(*corners)) for name, label, corners in PARTS),
    (SITE,),
    Pose.identity(),
    False,
)


def failure(after: Sequence[Hull], *fates: dict[str, Any], **fields: Any) -> str | None:
    """Why the table does not do, edited so."""
    case = Case(SymbolicMesh(tuple(after)), ASSET, SymbolicMesh(tuple(BEFORE)))
    return judge(case, [{"kind": "parts", "fates": list(fates), **fields}])


def without(*names: str) -> list[Hull]:
    return [one for one in BEFORE if not one.name.startswith(names)]


def scaled(one: Hull, factor: float) -> Hull:
    middle = (one.aabb.min + one.aabb.max) / 2
    return hull(f"{one.name}~1", one.label or "", convex_hull((one.vertices - middle) * factor + middle))


GONE = {"of": "misc", "fate": "gone"}
MADE = {"of": "panel", "extreme": "+Z", "fate": "made", "hulls": 1, "shape": "box", "together": True}


def test_what_no_fate_is_for_stays() -> None:
    assert failure(BEFORE) is None
    assert "100% of crumb (misc) is gone, which stays" in str(failure(without("crumb")))
    shrunk = [*without("shelf1"), scaled(next(one for one in BEFORE if one.name == "shelf1"), 0.8)]
    assert "of shelf1 (panel) is gone, which stays" in str(failure(shrunk))


def test_what_stays_may_be_cut_otherwise() -> None:
    whole = hull("shelf0~1", "panel", box(SHELF).tessellate())
    assert failure([*without("shelf"), whole]) is None
    larger = hull("shelf0~1", "panel", box((SHELF[0], (0.45, 0.25, 0.4))).tessellate())
    assert "larger" in str(failure([*without("shelf"), larger]))


def test_a_part_is_gone_only_if_nothing_of_it_is_left() -> None:
    crumb = BEFORE[-1]
    assert failure(without("crumb"), GONE) is None
    assert "crumb of crumb is as it was" in str(failure(BEFORE, GONE))
    for factor in (0.3, 0.8, 1.0):
        assert "where nothing should be left" in str(failure([*without("crumb"), scaled(crumb, factor)], GONE))
    nameless = [*without("crumb"), Hull("new", "body", scaled(crumb, 0.8).shape)]
    assert "where nothing should be left" in str(failure(nameless, GONE))


def test_what_is_made_is_new_whole_and_no_larger() -> None:
    rest = without("top")
    assert failure([*rest, hull("top0~1", "panel", box(TOP))], MADE) is None
    assert "as it was" in str(failure(BEFORE, MADE))
    assert "0% of top is in hulls" in str(failure(rest, MADE))
    assert "which stays" in str(failure([], MADE))
    half = box((TOP[0], (0.0, 0.3, 0.74)))
    assert "50% of top is in hulls" in str(failure([*rest, hull("top0~1", "panel", half)], MADE))
    thick = box((TOP[0], (0.5, 0.3, 0.8)))
    assert "150.0% larger" in str(failure([*rest, hull("top0~1", "panel", thick)], MADE))
    assert "a polytope, a box wanted" in str(failure([*rest, hull("top0~1", "panel", box(TOP).tessellate())], MADE))
    two = [hull(f"top0~{k}", "panel", one.shape) for k, one in enumerate(halves(TOP, "panel", ""))]
    assert "made of 2 hulls, 1 wanted" in str(failure([*rest, *two], MADE))


def test_a_part_is_whole_when_it_is_one_hull() -> None:
    whole = {"of": "leg", "fate": "whole"}
    merged = [hull(f"leg{k}0~1", "leg", box(leg).tessellate()) for k, leg in enumerate(LEGS)]
    assert failure([*without("leg"), *merged], whole) is None
    assert "leg_0 is made of 2 hulls, 1 wanted" in str(failure(BEFORE, whole))
    everything = hull("leg00~1", "leg", convex_hull(np.concatenate([one.vertices for one in merged])))
    assert "larger" in str(failure([*without("leg"), everything], whole))
    assert failure(BEFORE, {**whole, "hulls": 2}) is None
    assert "a box wanted" in str(failure(BEFORE, {**whole, "hulls": 2, "lowest": "box"}))
