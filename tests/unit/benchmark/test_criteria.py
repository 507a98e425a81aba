"""What the criteria let through, and what they refuse, on small scenes made by hand; more scenes are those of
goals, which try the same (tests/unit/checks/goals.toml)."""

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


def site(at: Point, size: Point, axes: Any = LEVEL, scale: float = 1.0) -> Site:
    x, y, z = at
    a, b, c = size
    return Site("place", (x * scale, y * scale, z * scale), (a * scale, b * scale, c * scale), axes)


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
