"""What tables stand on: legs of many kinds, a column, trestles; and the measures of a table."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold

from benchmark.assets.draw import Draw
from script.samples import legs
from script.samples.layout import corners, outward, ring
from script.samples.part import Part
from script.samples.solids import block, box, revolve, taper, union

HAIRLINE = 0.0008
"""Between parts that are joined and yet no single solid [m]."""


@dataclass(frozen=True)
class Size:
    """Outer measures of a table [m]; batten: height of what is under its top."""

    width: float
    depth: float
    height: float
    thick: float
    batten: float

    @property
    def under(self) -> float:
        """Height of the top's lower face."""
        return self.height - self.thick

    @property
    def low(self) -> float:
        """Height below which there is nothing of the top."""
        return self.under - self.batten


def stand(size: Size, round_: bool, kind: str, draw: Draw) -> tuple[list[Part], str]:
    """Legs, a column or trestles."""
    w, d, h = size.width, size.depth, size.under - HAIRLINE
    wide = max(0.034, 0.055 * min(w, 1.3))
    if round_ and draw.chance(0.4):
        return [Part("column", "leg", legs.drum(h, draw.length(0.12, 0.155) * w))], "a column"
    if kind == "dining" and w > 1.2 and draw.chance(0.4):
        end = _trestle(size.low - HAIRLINE, 0.7 * d, draw.length(0.04, 0.06))
        both = [Part(f"trestle_{k}", "leg", end.translate((x * 0.38 * w, 0, 0))) for k, x in ((1, -1), (2, 1))]
        return both, "trestles"
    places = ring(draw.one((3, 5)), 0.33 * w) if round_ else corners(0.86 * w, 0.82 * d)
    if kind == "desk":
        more = draw.number(0, 2 if w > 1.3 else 1)
        places = places + [(x * w, y * d) for x in ((), (0.0,), (-0.12, 0.12))[more] for y in (-0.41, 0.41)]
    elif kind == "dining" and draw.chance(0.4):
        places = [*places, (-0.43 * w, 0.0), (0.43 * w, 0.0)]
    name, make = _leg(h, wide, 0.15 * d, draw)
    found = [Part(f"leg_{k}", "leg", make(x, y)).move(x, y) for k, (x, y) in enumerate(places, 1)]
    return found, f"{len(found)} {name} legs"


def _leg(h: float, wide: float, reach: float, draw: Draw) -> tuple[str, Callable[[float, float], Manifold]]:
    """A kind of leg, made for a place: of convex pieces a hairline apart, so that all legs come apart alike."""
    style = draw.one(("turned", "curved", "block", "splayed", "forked"))
    out, r = draw.length(0.1, 0.18) * h, wide / 2

    def make(x: float, y: float) -> Manifold:
        sx, sy = float(np.sign(x)), float(np.sign(y))
        if style == "turned":
            vase = [(0.5 * r, 0.1), (0.65 * r, 0.25), (r, 0.6), (0.55 * r, 0.8)]
            shaft = revolve([(0.5 * r, 0), (0.75 * r, 0.05 * h), *((a, b * h) for a, b in vase)])
            return _cut(shaft + box((wide, wide, 0.2 * h), (0, 0, 0.9 * h)), 0.1 * h, 0.25 * h, 0.8 * h)
        if style == "curved":
            return _cut(legs.sabre(h, 0.9 * wide, out, outward(x, y), 3), h / 3, 2 * h / 3)
        if style == "block":
            shaft = taper((0, 0, 0), (0, 0, h), 0.5 * wide, 0.7 * wide)
            return _cut(shaft + box((wide, wide, 0.14 * h), (0, 0, 0.93 * h)), 0.86 * h)
        if style == "splayed":
            shaft = taper((0.7 * out * sx, 0.7 * out * sy, 0), (0, 0, h), 0.4 * wide, 0.8 * wide, 6)
            return _cut(shaft, 0.12 * h)
        ends = [(0.0, side * min(0.8 * out, reach), h) for side in (-1, 1)]
        both = union([taper((0, 0, 0), end, 0.45 * wide, 0.45 * wide) for end in ends])
        return (both - box((1, HAIRLINE, 3), (0, 0, 0))).translate((0, -ends[1][1] * sy, 0))

    return style, make


def _trestle(h: float, wide: float, thick: float) -> Manifold:
    """A board on a foot and under a head, across Y."""
    board = block((-thick / 2, -0.3 * wide, 0), (thick / 2, 0.3 * wide, h))
    feet = [block((-thick, -k * wide, z), (thick, k * wide, z + 0.08 * h)) for k, z in ((0.5, 0.0), (0.45, 0.92 * h))]
    return _cut(union([board, *feet]), 0.08 * h, 0.92 * h)


def _cut(solid: Manifold, *heights: float) -> Manifold:
    """A solid sawn through at some heights."""
    return solid - union([box((3, 3, HAIRLINE), (0, 0, z)) for z in heights])
