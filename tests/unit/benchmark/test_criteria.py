"""What the criteria let through, and what they refuse, on small scenes made by hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from benchmark.assets.asset import LEVEL, Asset, Site
from benchmark.criteria import Case, judge
from meshforge.geometry import Aabb, Box, Polytope, Pose, Shape
from meshforge.symbolic import Hull, Label, SymbolicMesh
from script.samples.part import Part
from script.samples.solids import Point, block

Row = tuple[str, Shape]
SIZES = (0.3, 1.0, 10.0)
DOWN = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
UPRIGHT = ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
ACROSS = ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, -1.0))


def brick(low: Point, high: Point, scale: float = 1.0) -> Polytope:
    return Box.of_bounds(Aabb(np.array(low) * scale, np.array(high) * scale)).tessellate()


def case(rows: Sequence[Row], *sites: Site, parts: Sequence[Row] | None = None) -> Case:
    """Hulls by label; parts: by default, the boxes around the hulls."""
    solids = [
        Part(f"part {k}", label, block(tuple(shape.aabb.min), tuple(shape.aabb.max)))
        for k, (label, shape) in enumerate(rows if parts is None else parts)
    ]
    mesh = SymbolicMesh(tuple(Hull(f"h{k}", "body", shape, Label(label)) for k, (label, shape) in enumerate(rows)))
    asset = Asset("thing_01", "thing", "plain", False, "", tuple(solids), sites, Pose.identity(), False)
    return Case(mesh, asset, mesh)


def site(at: Point, size: Point, axes: Any = LEVEL, scale: float = 1.0, moving: tuple[str, ...] = ()) -> Site:
    x, y, z = at
    a, b, c = size
    return Site("place", (x * scale, y * scale, z * scale), (a * scale, b * scale, c * scale), axes, moving)


def why(it: Case, kind: str, **fields: Any) -> str:
    """Why a criterion fails, empty where it holds; the same when it is asked again."""
    if kind not in ("stands", "structural"):
        fields = {"site": "place", **fields}
    said = judge(it, [{"kind": kind, **fields}])
    assert said == judge(it, [{"kind": kind, **fields}])
    return said or ""


def cup(s: float = 1.0) -> list[Row]:
    """A square cup 8 cm wide and 10 cm high: the floor first, then its walls."""
    floor = brick((-0.04, -0.04, 0), (0.04, 0.04, 0.004), s)
    walls = [
        brick((-0.04, -0.04, 0.004), (-0.036, 0.04, 0.1), s),
        brick((0.036, -0.04, 0.004), (0.04, 0.04, 0.1), s),
        brick((-0.036, -0.04, 0.004), (0.036, -0.036, 0.1), s),
        brick((-0.036, 0.036, 0.004), (0.036, 0.04, 0.1), s),
    ]
    return [("wall", shape) for shape in [floor, *walls]]


def test_a_missing_site_is_no_failure() -> None:
    for kind in ("supports", "contains", "graspable", "passes", "swings"):
        assert not why(case(cup()), kind)
        assert not why(case([], parts=cup()), kind)


def test_nothing_does_nothing() -> None:
    here = site((0, 0, 0), (0.1, 0.1, 0.1))
    for kind in ("supports", "contains", "graspable", "swings"):
        assert "left" in why(case([], here, parts=cup()), kind)
    assert not why(case([], here, parts=cup()), "passes")
    assert "left" in why(case([], parts=cup()), "stands")


class TestStands:
    @pytest.mark.parametrize("s", SIZES)
    def test_a_cup(self, s: float) -> None:
        assert not why(case(cup(s)), "stands")

    @pytest.mark.parametrize("s", SIZES)
    def test_something_sticks_out_below(self, s: float) -> None:
        lump = brick((-0.02, -0.02, -0.004), (0.02, -0.01, 0.002), s)
        assert "tilts" in why(case([*cup(s), ("misc", lump)]), "stands")

    def test_four_legs_three_legs_and_two(self) -> None:
        top = ("top", brick((-0.4, -0.3, 0.7), (0.4, 0.3, 0.73)))
        spots = [(x, y) for x in (-0.35, 0.35) for y in (-0.25, 0.25)]
        legs = [("leg", brick((x - 0.02, y - 0.02, 0), (x + 0.02, y + 0.02, 0.7))) for x, y in spots]
        assert not why(case([top, *legs]), "stands")
        assert "falls over" in why(case([top, *legs[:2]]), "stands")
        third = ("leg", brick((0.33, -0.02, 0), (0.37, 0.02, 0.7)))
        assert not why(case([top, *legs[:2], third]), "stands")

    def test_a_short_leg(self) -> None:
        top = ("top", brick((-0.4, -0.3, 0.7), (0.4, 0.3, 0.73)))
        feet = [(-0.35, -0.25, 0.0), (-0.35, 0.25, 0.0), (0.35, -0.25, 0.05), (0.35, 0.25, 0.05)]
        legs = [("leg", brick((x - 0.02, y - 0.02, z), (x + 0.02, y + 0.02, 0.7))) for x, y, z in feet]
        assert "tilts by" in why(case([top, *legs]), "stands")


@pytest.mark.parametrize("s", SIZES)
class TestSupports:
    def top(self, s: float, gap: float = 0.0, lift: float = 0.0) -> list[Row]:
        left = brick((-0.1, -0.1, 0.1), (-gap / 2, 0.1, 0.11), s)
        return [("top", left), ("top", brick((gap / 2, -0.1, 0.1 + lift), (0.1, 0.1, 0.11 + lift), s))]

    def place(self, s: float) -> Site:
        return site((0, 0, 0.11), (0.1, 0.1, 0.012), scale=s)

    def test_a_top_in_two_halves(self, s: float) -> None:
        assert not why(case(self.top(s), self.place(s)), "supports")
        assert not why(case(self.top(s, gap=0.004), self.place(s)), "supports")

    def test_what_is_missing(self, s: float) -> None:
        assert "goes away" in why(case(self.top(s)[:1], self.place(s)), "supports")
        assert why(case(self.top(s, gap=0.03), self.place(s)), "supports")


@pytest.mark.parametrize("s", SIZES)
class TestContains:
    def place(self, s: float) -> Site:
        return site((0, 0, 0.031), (0.02, 0.02, 0.025), scale=s)

    @pytest.mark.parametrize("shape", ["box", "sphere", "cylinder"])
    def test_a_cup(self, s: float, shape: str) -> None:
        assert not why(case(cup(s), self.place(s)), "contains", shape=shape)

    def test_a_plug(self, s: float) -> None:
        plug = ("misc", brick((-0.036, -0.036, 0.004), (0.036, 0.036, 0.1), s))
        said = why(case([*cup(s), plug], self.place(s)), "contains")
        assert "h5 (misc)" in said
        assert "from the start" in said

    def test_no_floor(self, s: float) -> None:
        assert "moves by" in why(case(cup(s)[1:], self.place(s)), "contains", shape="sphere")


@pytest.mark.parametrize("s", SIZES)
class TestPasses:
    def into(self, s: float, wide: float = 0.03) -> Site:
        return site((0, 0, 0.2), (0.15, wide, wide), DOWN, s)

    @pytest.mark.parametrize("shape", ["box", "sphere"])
    def test_into_a_cup(self, s: float, shape: str) -> None:
        assert not why(case(cup(s), self.into(s)), "passes", shape=shape)
        assert "in the way" in why(case(cup(s), self.into(s, 0.038)), "passes", shape=shape)


@pytest.mark.parametrize("s", SIZES)
class TestGraspable:
    def bar(self, s: float) -> list[Row]:
        """A plate with a handle like a staple in front of it."""
        return [
            ("plate", brick((0, -0.1, -0.1), (0.02, 0.1, 0.1), s)),
            ("handle", brick((0.02, -0.005, -0.06), (0.06, 0.005, -0.05), s)),
            ("handle", brick((0.02, -0.005, 0.05), (0.06, 0.005, 0.06), s)),
            ("handle", brick((0.05, -0.005, -0.05), (0.06, 0.005, 0.05), s)),
        ]

    def place(self, s: float) -> Site:
        return site((0.055, 0, 0), (0.01, 0.015, 0.008), ACROSS, s)

    @pytest.mark.parametrize("pull", ["back", "up"])
    def test_a_staple(self, s: float, pull: str) -> None:
        assert not why(case(self.bar(s), self.place(s)), "graspable", pull=pull)

    def test_a_filled_eye(self, s: float) -> None:
        plug = ("handle", brick((0.02, -0.005, -0.05), (0.05, 0.005, 0.05), s))
        said = why(case([*self.bar(s), plug], self.place(s)), "graspable")
        assert "h4 (handle)" in said
        assert "open finger" in said

    def test_nothing_between_the_fingers(self, s: float) -> None:
        assert "close on nothing" in why(case(self.bar(s)[:3], self.place(s)), "graspable")


@pytest.mark.parametrize("s", SIZES)
class TestSwings:
    def door(self, s: float, gap: float = 0.004) -> list[Row]:
        return [
            ("frame", brick((-0.1, -0.02, 0), (0, 0.02, 1), s)),
            ("frame", brick((0.8, -0.02, 0), (0.9, 0.02, 1), s)),
            ("leaf", brick((gap, -0.015, 0), (0.8 - gap, 0.015, 1), s)),
        ]

    def hinge(self, s: float, end: float) -> Site:
        at = (0.004 * s, -0.02 * s, 0.0)
        return Site("place", at, (0.0, end, 0.0), UPRIGHT, ("leaf",))

    def test_a_door(self, s: float) -> None:
        assert not why(case(self.door(s), self.hinge(s, -90.0)), "swings")

    def test_the_wrong_way_round(self, s: float) -> None:
        said = why(case(self.door(s), self.hinge(s, 90.0)), "swings")
        assert "h2 (leaf)" in said
        assert "(frame)" in said

    def test_a_doorstop(self, s: float) -> None:
        stop = ("misc", brick((0.3, -0.305, 0), (0.305, -0.3, 0.05), s))
        assert "(misc)" in why(case([*self.door(s), stop], self.hinge(s, -90.0)), "swings")
        assert not why(case([*self.door(s), stop], self.hinge(s, -30.0)), "swings")


class TestStructural:
    PARTS: tuple[Row, ...] = (
        ("leg", brick((0, 0, 0), (0.1, 0.1, 1))),
        ("leg", brick((1, 0, 0), (1.1, 0.1, 1))),
        ("panel", brick((0, 0, 1), (1.1, 1, 1.1))),
    )

    def why(self, rows: Sequence[Row], **fields: Any) -> str:
        return why(case(rows, parts=self.PARTS), "structural", **fields)

    def test_single(self) -> None:
        whole = list(self.PARTS)
        low, high = ("leg", brick((0, 0, 0), (0.1, 0.1, 0.5))), ("leg", brick((0, 0, 0.5), (0.1, 0.1, 1)))
        both = ("leg", brick((0, 0, 0), (1.1, 0.1, 1)))
        assert not self.why(whole, single=["leg"])
        assert "parts leg: 2, hulls: 3" in self.why([low, high, *whole[1:]], single=["leg"])
        assert "parts leg: 2, hulls: 1" in self.why([both], single=["leg"])
        assert "50%" in self.why([low, whole[1]], single=["leg"])
        assert not self.why([both, whole[0]], single=["leg"])
        assert not self.why([whole[0], both], single=["leg"])

    def test_absent_and_present(self) -> None:
        assert not self.why(self.PARTS, absent=["misc"], present=["leg", "panel"])
        assert "2 hulls left" in self.why(self.PARTS, absent=["leg"])
        assert "knob" in self.why(self.PARTS, present=["leg", "knob"])

    def test_counts(self) -> None:
        assert not self.why(self.PARTS, most=3, most_of={"leg": 2, "panel": 1})
        assert "3 hulls" in self.why(self.PARTS, most=2)
        assert "2 hulls leg" in self.why(self.PARTS, most_of={"panel": 1, "leg": 1})

    def test_unknown_fields_are_refused(self) -> None:
        with pytest.raises(AssertionError):
            self.why(self.PARTS, sinlge=["leg"])
