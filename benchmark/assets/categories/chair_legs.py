"""What chairs stand on: legs of many makes with a foot below each, or spokes on casters about a column."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, Manifold

from benchmark.assets.draw import Draw
from script.samples.legs import lathe, sabre, splay_leg, square
from script.samples.part import Part
from script.samples.solids import Point, bar, box, revolve, taper, union

GAP, SUNK = 0.0008, 0.004  # between parts that are fitted together; how far glued ones reach into each other [m]


@dataclass(frozen=True)
class Chair:
    """What all parts must know [m].

    top, thick: of the seat; apron: height of the rails under it; rise, lean: of the back, upwards and [degrees];
    glued: which parts are one solid with what they are fitted to.
    """

    kind: str
    width: float
    depth: float
    top: float
    thick: float
    apron: float
    rise: float
    lean: float
    glued: str
    round: bool
    draw: Draw

    @property
    def under(self) -> float:
        """The height of the seat's lower face."""
        return self.top - self.thick

    def joint(self, what: str) -> float:
        """How far parts of a kind are from what they are fitted to; below nought: how deep in it."""
        return -SUNK if what == self.glued else GAP


def leg_width(chair: Chair) -> float:
    """How thick a leg is at most, roughly."""
    return 0.09 * min(chair.width, 0.5) + 0.004


def inset(chair: Chair) -> float:
    """How far inside the seat's edge legs stand."""
    return 0.75 * leg_width(chair) + (0.06 * chair.width if chair.round else 0.0)


def _spots(chair: Chair) -> list[tuple[float, float]]:
    """Where legs stand: at the corners, in rows, or on a ring."""
    x, y = chair.width / 2 - inset(chair), chair.depth / 2 - inset(chair)
    if chair.kind == "stool":
        turn = np.arange(3) * 2 * np.pi / 3 + chair.draw.one((1, -1)) * np.pi / 2
        return [(0.72 * x * float(np.cos(t)), 0.72 * x * float(np.sin(t))) for t in turn]
    if chair.round:
        x, y = 0.75 * x, 0.75 * y
    columns = chair.draw.number(3, 4) if chair.kind == "settee" else 2
    return [(float(s), t) for s in np.linspace(-x, x, columns) for t in (-y, y)]


def on_legs(chair: Chair) -> tuple[str, list[Part], list[tuple[float, float]]]:
    """Legs with feet, and where they stand."""
    draw, spots, width = chair.draw, _spots(chair), leg_width(chair)
    straight = chair.kind in ("settee", "shelf")
    style = draw.one(
        ("square", "lathe") if straight else ("square", "lathe", "sabre", "splayed", "cabriole", "hairpin")
    )
    foot = draw.one(("ferrule", "block", "bun", "caster"))
    splay = 0.0 if straight or style in ("square", "lathe") else draw.length(0.03, 0.07)
    x, y = (max(abs(spot[k]) for spot in spots) + splay for k in (0, 1))
    high = draw.length(0.07, 0.095) * float(np.hypot(np.hypot(2 * x, 2 * y), chair.under))
    parts = []
    for k, (sx, sy) in enumerate(spots):
        away = float(np.hypot(sx, sy))
        heading: Point = (sx / away, sy / away, 0.0)
        tall = chair.under - chair.joint("legs") - high - GAP
        shaft = _shaft(style, tall, width, splay, heading).translate((0, 0, high + GAP))
        below = _foot(foot, high, width).translate((heading[0] * splay, heading[1] * splay, 0))
        parts.append(Part(f"leg_{k}", "leg", (shaft + below).translate((sx, sy, 0))))
    return f"{len(spots)} {style} {foot}", parts, spots


def _shaft(style: str, tall: float, width: float, splay: float, heading: Point) -> Manifold:
    """A leg without its foot, its lower end out by `splay`."""
    foot: Point = (heading[0] * splay, heading[1] * splay, 0.0)
    if style == "square":
        return square(tall, 0.7 * width, width, 0.16 * tall)
    if style == "lathe":
        return lathe(tall, 0.9 * width)
    if style == "sabre":
        return sabre(tall, width, splay, heading)
    if style == "splayed":
        return splay_leg(tall, 0.8 * width, foot, 6, collar=0.35 * width)
    if style == "cabriole":
        out = [splay, 0.3 * splay, 0.45 * splay, 1.1 * splay, 0.9 * splay, 0.0]
        sizes = [0.6, 0.5, 0.55, 0.85, 1.0, 0.95]
        levels = [(heading[0] * s, heading[1] * s, tall * k / 5) for k, s in enumerate(out)]
        return union([taper(levels[k], levels[k + 1], sizes[k] * width, sizes[k + 1] * width) for k in range(5)])
    side = (-heading[1] * 1.1 * width, heading[0] * 1.1 * width)
    ends = [taper(foot, (s * side[0], s * side[1], tall), 0.5 * width, 0.45 * width, 6) for s in (-1, 1)]
    return union(ends)


def _foot(style: str, high: float, width: float) -> Manifold:
    r = width / 2
    if style == "caster":
        wheel = bar((0, -0.5 * r, 0), (0, 0.5 * r, 0), 0.8 * high, 12)
        stem = box((0.7 * r, 0.7 * r, 0.1 * high), (0, 0, 0.95 * high))
        return Manifold.batch_hull([wheel.translate((0, 0, -wheel.bounding_box()[2])), stem])
    if style == "bun":
        return revolve([(0.7 * r, 0), (1.1 * r, 0.3 * high), (1.1 * r, 0.6 * high), (0.6 * r, high)], 12)
    sides = 4 if style == "block" else 8
    return taper((0, 0, 0), (0, 0, high), (1.8 if sides == 4 else 1.1) * r, 1.5 * r, sides)


def on_casters(chair: Chair) -> tuple[str, list[Part], list[tuple[float, float]]]:
    """Spokes on casters about a column, which is a rail."""
    count, reach = chair.draw.number(4, 6), 0.58 * chair.width
    high = chair.draw.length(0.19, 0.23) * reach
    hub, thick = 0.036, 0.026
    start, end = hub + chair.joint("legs"), reach + 0.6 * thick
    outline = [(start, 1.6 * high), (0.5 * reach, 1.6 * high), (end - thick, high + GAP), (end, high + GAP)]
    outline += [(end, high + thick), (0.6 * reach, 1.9 * high), (start, 2.1 * high)]
    spoke = CrossSection([np.array(outline)]).extrude(thick).rotate((90, 0, 0)).translate((0, thick / 2, 0))
    caster = _foot(chair.draw.one(("caster", "bun")), high, 0.05).translate((reach, 0, 0))
    turns = [-90 + k * 360 / count for k in range(count)]
    parts = [Part(f"leg_{k}", "leg", (spoke + caster).rotate((0, 0, turn))) for k, turn in enumerate(turns)]
    top = chair.under - GAP
    profile = [(hub, 1.5 * high), (hub, 2.2 * high), (0.6 * hub, 2.3 * high), (0.6 * hub, 0.9 * top), (2 * hub, top)]
    parts.append(Part("column", "rail", revolve(profile, 12)))
    spots = [(reach * float(np.cos(np.radians(t))), reach * float(np.sin(np.radians(t)))) for t in turns]
    return f"{count} spoke", parts, spots
