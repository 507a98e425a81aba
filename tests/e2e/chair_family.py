"""Eight chairs of about 24 hulls each, built part by part as a decomposition would cut them, without labels."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshforge.geometry import Polytope
from meshforge.project import Project
from script.families.parts import SampleHull, format_hulls
from script.families.pieces import Cut, X, Y, Z, bar_points, block, hull_of, post_points, slice_all

WORDS = ("seat", "leg", "stretcher", "post", "slat", "crest", "arm", "support")
"""The parts of these chairs."""
FIVE = dict(zip(WORDS, ("seat", "leg", "rail", "back", "back", "back", "arm", "arm"), strict=True))
"""The same parts by fewer words."""


@dataclass(frozen=True, slots=True)
class ChairShape:
    """The measures of a chair [m], how many slats it has and how they run, and how its parts are cut up."""

    width: float = 0.5
    depth: float = 0.48
    height: float = 0.45
    back: float = 0.5
    lean: float = 0.04
    slats: int = 4
    level: bool = True
    splay: float = 1.0
    leg_pieces: int = 2
    seat_cuts: tuple[Cut, ...] = ((X, 2),)
    round_legs: bool = False

    def parts(self) -> Iterable[tuple[str, Polytope]]:
        """Its hulls, each with its part."""
        w, d, h, b = self.width / 2, self.depth / 2, self.height, self.back
        yield from _all("seat", slice_all([block((-w, -d, h - 0.04), (w, d, h))], self.seat_cuts))
        corners = [(x * (w - 0.04), y * (d - 0.04)) for x in (-1, 1) for y in (-1, 1)]
        s, sides = self.splay, 8 if self.round_legs else 4
        legs = [hull_of(post_points((s * x, s * y, 0.0), (x, y, h - 0.04), 0.034, 0.046, sides)) for x, y in corners]
        yield from _all("leg", slice_all(legs, ((Z, self.leg_pieces),)))
        low, reach = 0.35 * h, w - 0.06
        ends = [((x * reach, -d + 0.07, low), (x * reach, d - 0.07, low)) for x in (-1, 1)]
        ends += [
            ((-reach + 0.03, y * (d - 0.05), low + 0.07), (reach - 0.03, y * (d - 0.05), low + 0.07)) for y in (-1, 1)
        ]
        yield from _all("stretcher", [hull_of(bar_points(a, e, 0.022, 6)) for a, e in ends])
        y, top = d - 0.025, d - 0.025 + self.lean
        yield from _all(
            "post",
            [hull_of(bar_points((x * (w - 0.03), y, h), (x * (w - 0.03), top, h + b), 0.036, 6)) for x in (-1, 1)],
        )
        yield from _all("slat", self._slats(w - 0.06, y, top, h, b))
        yield "crest", block((-w + 0.0, top - 0.018, h + b), (w, top + 0.018, h + b + 0.07))
        arm = h + 0.22
        yield from _all(
            "arm", [block((x * w - 0.03, -d + 0.04, arm), (x * w + 0.03, d - 0.05, arm + 0.03)) for x in (-1, 1)]
        )
        yield from _all(
            "support",
            [hull_of(post_points((x * w, -d + 0.08, h), (x * w, -d + 0.08, arm), 0.03, 0.03)) for x in (-1, 1)],
        )

    def _slats(self, w: float, y: float, top: float, h: float, b: float) -> list[Polytope]:
        if self.level:
            heights = np.linspace(h + 0.1, h + b - 0.1, self.slats).tolist()
            at = [y + (top - y) * (z - h) / b for z in heights]
            return [
                block((-w, t - 0.008, z - 0.022), (w, t + 0.008, z + 0.022)) for z, t in zip(heights, at, strict=True)
            ]
        places = np.linspace(-w + 0.07, w - 0.07, self.slats).tolist()
        return [hull_of(bar_points((x, y, h), (x, top, h + b), 0.02, 6)) for x in places]


def _all(part: str, hulls: Iterable[Polytope]) -> Iterable[tuple[str, Polytope]]:
    return ((part, hull) for hull in hulls)


SHAPES = (
    ChairShape(),
    ChairShape(width=0.56, depth=0.5, slats=5, back=0.55),
    ChairShape(width=0.46, height=0.43, slats=3, lean=0.07, seat_cuts=((X, 3),)),
    ChairShape(depth=0.44, level=False, slats=5, round_legs=True),
    ChairShape(width=0.6, depth=0.56, height=0.4, splay=1.15, slats=4, seat_cuts=((Y, 2),)),
    ChairShape(width=0.52, level=False, slats=6, back=0.6, lean=0.08),
    ChairShape(splay=1.1, round_legs=True, slats=4, back=0.44),
    ChairShape(width=0.48, depth=0.46, height=0.5, level=False, slats=4, seat_cuts=((X, 2), (Y, 2))),
)


@dataclass(frozen=True, slots=True)
class ChairFamily:
    """A project of chairs, and what a person knows of them.

    truth: the label of each hull, by asset and name; parts: which part each is, in the same order.
    """

    project: Project
    truth: dict[str, dict[str, str]]
    parts: dict[str, list[str]]

    def labels(self) -> dict[str, dict[str, str]]:
        kept = {asset: self.project.labels(asset).labels for asset in self.truth}
        return {asset: {hull: label.name for hull, label in own.items()} for asset, own in kept.items()}


def chair_family(
    folder: Path, shapes: Sequence[ChairShape] = SHAPES, names: Mapping[str, str] | None = None
) -> ChairFamily:
    """A project of chairs. names: what the parts are called, None for their own words."""
    truth, known = write_chairs(folder / "assets", shapes, names)
    words = tuple(dict.fromkeys(names.values())) if names else WORDS
    project = Project.create(folder / "project", [folder / "assets" / "*.obj"], name="chairs", vocabulary=words)
    return ChairFamily(project, truth, known)


def write_chairs(
    folder: Path, shapes: Sequence[ChairShape] = SHAPES, names: Mapping[str, str] | None = None
) -> tuple[dict[str, dict[str, str]], dict[str, list[str]]]:
    """The files of chairs in a new folder; gives the label of each hull, by asset and name, and the part of each."""
    folder.mkdir(parents=True)
    truth, known = dict[str, dict[str, str]](), dict[str, list[str]]()
    for k, shape in enumerate(shapes):
        parts = list(shape.parts())
        order = np.random.default_rng(k).permutation(len(parts)).tolist()
        hulls = [
            SampleHull(f"hull_{n:02}", (names or {}).get(parts[place][0], parts[place][0]), parts[place][1])
            for n, place in enumerate(order)
        ]
        asset = f"chair_{k:0{len(str(len(shapes) - 1))}}.obj"
        (folder / asset).write_bytes(format_hulls(hulls, "a chair"))
        truth[asset] = {hull.name: hull.label for hull in hulls}
        known[asset] = [parts[place][0] for place in order]
    return truth, known


def draw_shapes(count: int, seed: int = 0) -> list[ChairShape]:
    """Shapes of a family that differ in every measure, the same each time."""
    rng = np.random.default_rng(seed)
    return [
        ChairShape(
            width=rng.uniform(0.44, 0.62),
            depth=rng.uniform(0.42, 0.56),
            height=rng.uniform(0.4, 0.5),
            back=rng.uniform(0.42, 0.6),
            lean=rng.uniform(0.02, 0.08),
            slats=int(rng.integers(2, 5)),
            level=bool(rng.random() < 0.6),
            splay=rng.uniform(1.0, 1.15),
            leg_pieces=int(rng.integers(1, 3)),
            seat_cuts=(((X, 2),), ((Y, 2),), ((X, 3),))[int(rng.integers(3))],
            round_legs=bool(rng.random() < 0.5),
        )
        for _ in range(count)
    ]
