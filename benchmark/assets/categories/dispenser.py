"""Dispensers of soap and drinks: a body on its base, a pump head or a lever, a nozzle, perhaps a drip tray."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from manifold3d import Manifold

from benchmark.assets.asset import LEVEL, Design, Site
from benchmark.assets.draw import Draw
from script.samples.part import Part
from script.samples.solids import Point, bar, block, box, pebble, plate, rectangle, revolve, tube

LABELS = ("body", "base", "lever", "nozzle", "tray", "misc")
KINDS = {"pump": 8, "tap": 8, "press": 4, "twin": 3, "pedestal": 2}
RARE = frozenset({"pedestal"})

_JOINT = 0.0002  # between parts that are joined, as in a file of an assembly [m]
_KNOB = (0.5, 0.85)  # of the template knob.obj, for a width of 1: where its neck ends, middle of its head
_FLOOR = 0.2  # of a tray's height


@dataclass
class _Work:
    """What has been made so far."""

    draw: Draw
    parts: list[Part] = field(default_factory=list)
    sites: list[Site] = field(default_factory=list)

    def add(self, label: str, *solids: Manifold) -> None:
        for solid in solids:
            self.parts.append(Part(f"{label}_{len(self.parts)}", label, solid))

    def lump(self, low: Point, size: Point) -> None:
        """An irregular lump that fills a box."""
        lump = pebble((0.0, 0.0, 0.0), 1.0, self.draw.rng)
        b = lump.bounding_box()
        lump = lump.translate((-b[0], -b[1], -b[2])).scale(tuple(size[k] / (b[k + 3] - b[k]) for k in range(3)))
        self.add("misc", lump.translate(low))


def build(kind: str, draw: Draw) -> Design:
    """One dispenser."""
    made = _Work(draw)
    about = _pump(made) if kind == "pump" else _tank_with_taps(made, kind)
    return Design(about, tuple(made.parts), tuple(made.sites))


def _pump(made: _Work) -> str:
    """A bottle with a pump head, on a foot."""
    draw = made.draw
    radius, height = draw.ratio(0.026, 0.048), draw.ratio(0.07, 0.2)
    foot, style = draw.length(0.006, 0.014), draw.one(("round", "square", "waisted"))
    wide = 2 * radius + draw.length(0.006, 0.03)
    round_foot = style != "square"
    made.add("base", revolve([(wide / 2, 0), (wide / 2, foot)], 16) if round_foot else _slab(wide, wide, 0, foot))
    z = foot + _JOINT
    made.add("body", _bottle(style, radius, z, height))
    z, r = z + height + _JOINT, draw.length(0.011, 0.016)
    collar = draw.length(0.018, 0.028)
    made.add("body", revolve([(r, z), (r, z + collar)], 12))
    z, stem, s = z + collar + 0.0003, draw.length(0.014, 0.035), draw.length(0.018, 0.03)
    if draw.chance(0.5):
        made.lump((0.0047, -0.004, z + 0.0003), (r - 0.0055, 0.008, stem * 0.6))
    made.add("lever", revolve([(0.0045, z), (0.0045, z + stem)], 8))
    z += stem + _JOINT
    thick = draw.length(0.011, 0.016)
    made.add("lever", _slab(s, s, z, thick) if draw.chance(0.5) else revolve([(s / 2, z), (s / 2, z + thick)], 12))
    _knob(made, (0, 0, z + thick), s)
    y, reach, drop = (
        -s / 2 - (_JOINT if draw.chance(0.85) else -0.001),
        draw.length(0.02, 0.05),
        draw.length(0.012, 0.02),
    )
    _nozzle(made, (0, y, z + thick / 2), reach, drop, thick * 0.7)
    _residue(made, wide, wide)
    return f"{style} bottle with a pump"


def _bottle(style: str, radius: float, z: float, height: float) -> Manifold:
    if style == "square":
        lower = _slab(2 * radius, 2 * radius, z, height * 0.85, radius * 0.3)
        return Manifold.batch_hull([lower, _slab(radius, radius, z, height)])
    r, h, waist = radius, height, 0.7 if style == "waisted" else 1.0
    profile = [(r, z), (r, z + 0.3 * h), (r * waist, z + 0.55 * h), (r, z + 0.78 * h), (0.5 * r, z + h)]
    return revolve(profile if style == "waisted" else [(r, z), (r, z + 0.78 * h), (0.5 * r, z + h)], 16)


def _tank_with_taps(made: _Work, kind: str) -> str:
    """A tank with a tap or two; the place for a cup below."""
    draw, twin = made.draw, kind == "twin"
    wide, deep = draw.ratio(0.1, 0.2) * (1.6 if twin else 1.0), draw.ratio(0.09, 0.17)
    high = draw.ratio(0.2, 0.36)
    if kind == "press":
        wide, deep, high = draw.length(0.07, 0.1), draw.length(0.06, 0.09), draw.length(0.24, 0.36)
    s = draw.length(0.03, 0.042)
    floor, run = draw.length(0.09, 0.13), draw.length(0.012, 0.03)  # a tray's depth, behind it
    if kind == "pedestal":
        z, ground = _stand(made, wide, deep, floor + run + 0.8 * s)
        tap_z = z + high * draw.length(0.15, 0.25)
        style = _tank(made, wide, deep, z + _JOINT, high)
        back = deep / 2
    else:
        z, ground = _foot(made, wide, deep, kind == "press"), 0.0
        style = _tank(made, wide, deep, z + _JOINT, high)
        tap_z = z + high * (draw.length(0.7, 0.8) if kind == "press" else draw.length(0.45, 0.6))
        back = deep / 2 + 0.012 + 0.001  # the foot's front edge
    taps = [-0.25 * wide, 0.25 * wide] if twin else [0.0]
    spout_y = -back - run - floor / 2
    drop, arm = draw.length(0.8, 1.3) * s, draw.ratio(0.8, 2.4) * s
    for x in taps:
        _tap(made, (x, -deep / 2 - _JOINT, tap_z), s, spout_y, drop, arm)
    if draw.chance(0.8) or kind == "pedestal":
        _tray(made, taps, spout_y, ground, (0.5 * wide if twin else 0.0) + floor, floor, tap_z - drop)
    _residue(made, wide + 0.024, deep + 0.024) if kind != "pedestal" else None
    return f"{style} tank with {len(taps)} tap{'s' * twin}"


def _foot(made: _Work, wide: float, deep: float, flat: bool) -> float:
    """Make a foot all on the ground, a little larger than the body; its height."""
    draw, w, d = made.draw, wide + 0.024, deep + 0.024
    style = "plate" if flat else draw.one(("plate", "feet", "feet", "skids", "three"))
    h = draw.length(0.008, 0.02) if style == "plate" else draw.ratio(0.012, 0.04)
    if style == "plate":
        made.add("base", _slab(w, d, 0, h, draw.one((0.0, 0.01))))
    elif style == "skids":
        made.add("base", *(block((x - 0.01, -d / 2, 0), (x + 0.01, d / 2, h)) for x in (-w / 2 + 0.01, w / 2 - 0.01)))
    else:
        r = draw.length(0.009, 0.014)
        x, y = w / 2 - r, d / 2 - r
        places = [(-x, -y), (x, -y), (x, y), (-x, y)] if style == "feet" else [(-x, y / 2), (x, y / 2), (0, -y)]
        made.add("base", *(revolve([(0.8 * r, 0), (r, h)], 8).translate((px, py, 0)) for px, py in places))
    return h


def _stand(made: _Work, wide: float, deep: float, reach: float) -> tuple[float, float]:
    """Make a stand of two storeys: a foot for cups, posts, a shelf for the tank; heights of shelf and foot."""
    draw = made.draw
    w, d = wide + draw.length(0.1, 0.14), deep + 2 * reach
    rise, shelf = draw.length(0.15, 0.2), draw.length(0.012, 0.018)
    foot = 0.07 * float(np.linalg.norm((w, d, rise)))  # a plinth, by far the lowest piece
    made.add("base", _slab(w, d, 0, foot))
    x, z = w / 2 - 0.015, foot + _JOINT
    made.add("base", *(box((0.022, 0.022, rise), (side * x, 0, z + rise / 2)) for side in (-1, 1)))
    z += rise + _JOINT
    made.add("base", _slab(w, deep + 0.02, z, shelf))
    return z + shelf, foot + _JOINT


def _tank(made: _Work, wide: float, deep: float, z: float, high: float) -> str:
    """Make the body; its style."""
    draw = made.draw
    style = draw.one(("solid", "rounded", "lidded", "open"))
    if style in ("solid", "rounded"):
        made.add("body", _slab(wide, deep, z, high, 0.0 if style == "solid" else 0.2 * deep))
        return style
    made.add("body", *_boards(wide, deep, z, high, draw.length(0.006, 0.01)))
    if style == "lidded":
        made.add("body", _slab(wide, deep, z + high + _JOINT, draw.length(0.008, 0.02)))
    return style


def _boards(wide: float, deep: float, z: float, high: float, t: float) -> list[Manifold]:
    """Floor and walls of an open tank, joined."""
    low, w, d = z + t + _JOINT, wide / 2, deep / 2
    inner = d - t - _JOINT
    return [
        _slab(wide, deep, z, t),
        *(block((-w, y, low), (w, y + t, z + high)) for y in (-d, d - t)),
        *(block((x, -inner, low), (x + t, inner, z + high)) for x in (-w, w - t)),
    ]


def _tap(made: _Work, at: Point, s: float, spout_y: float, drop: float, arm: float) -> None:
    """Make a tap at a tank's face: boss, lever, nozzle; s: its width, arm: of its lever [m]."""
    draw, (x, y, z) = made.draw, at
    made.add("body", box((s, 0.8 * s, s), (x, y - 0.4 * s, z)))
    q, top = 0.35 * s, z + 0.5 * s + 0.0003
    hub: Point = (x, y - 0.4 * s, top + q / 2)
    grip = 0.6 * s
    shaft = box((0.3 * s, 0.3 * s, arm + q / 2), (x, hub[1], hub[2] + (arm + q / 2) / 2))
    made.add("lever", box((0.8 * s, q, q), hub) + shaft)
    head = top + q + arm + _JOINT
    made.add("lever", _slab(0.9 * s, grip, head, 0.35 * s).translate((x, hub[1], 0)))
    _knob(made, (x, hub[1], head + 0.35 * s), grip)
    made.sites.append(Site("lever", hub, (0.0, 30.0, 0.0), LEVEL, ("lever",)))
    if draw.chance(0.5):
        made.lump((x - 0.3 * s, y - 0.79 * s, top), (0.6 * s, 0.2 * s, 0.3 * s))
    front = y - 0.8 * s - (_JOINT if draw.chance(0.9) else -0.001)
    _nozzle(made, (x, front, z), front - spout_y, drop, 0.45 * s)


def _nozzle(made: _Work, at: Point, reach: float, drop: float, width: float) -> None:
    """Make a pipe that goes forward and down; sometimes a drip cap hangs at its end."""
    draw, (x, y, z) = made.draw, at
    end: Point = (x, y - reach, z - drop)
    bore = bar((x, end[1], end[2] - 1), (x, end[1], z - 0.1 * width), 0.5 * width, 8)
    made.add("nozzle", tube([at, (x, end[1], z), end], width, 8) - bore)
    below = ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
    made.sites.append(Site("outlet", (x, end[1], end[2] - 0.003), (0.024, 0.25 * width, 0.25 * width), below))
    if draw.chance(0.6):
        r, h, low = 0.7 * width, draw.length(0.012, 0.02), end[2] - _JOINT
        made.add("tray", revolve([(0.6 * r, low - h), (r, low)], 10).translate((x, end[1], 0)))


def _tray(made: _Work, taps: list[float], y: float, z: float, wide: float, deep: float, tip: float) -> None:
    """Make a drip tray below the nozzles, and the places of the cups in it."""
    draw, h = made.draw, made.draw.length(0.014, 0.026)
    inner = block((0.003 - wide / 2, y - deep / 2 + 0.003, z + _FLOOR * h), (wide / 2 - 0.003, y + deep / 2 - 0.003, 1))
    made.add("tray", block((-wide / 2, y - deep / 2, z), (wide / 2, y + deep / 2, z + h)) - inner)
    low = z + _FLOOR * h
    half, tall = draw.length(0.026, 0.034), min(0.06, 0.4 * (tip - low - 0.025))
    for x in taps:
        made.sites.append(Site("cup", (x, y, low + 0.003 + tall), (half, half, tall)))
        if draw.chance(0.4):
            made.lump((x + 0.01, y - 0.02, low + 0.0005), (0.02, 0.025, 0.012))


def _residue(made: _Work, wide: float, deep: float) -> None:
    """Make what sticks under a foot and what lies about."""
    draw = made.draw
    if draw.chance(0.8):
        side, t = draw.one((-1.0, 1.0)), wide * draw.length(0.06, 0.1)
        w = 0.14 * wide
        for _ in range(draw.number(1, 2)):
            y = draw.length(-0.3, 0.15) * deep
            made.lump((side * (0.5 * wide - w / 2) - w / 2, y, -t - 0.0006), (w, 0.12 * deep, t))
    if draw.chance(0.35):
        size, side = (draw.length(0.03, 0.06), draw.length(0.03, 0.06), draw.length(0.01, 0.03)), draw.one((0, 1))
        made.lump((wide / 2 + 0.0003 if side else -wide / 2 - 0.0003 - size[0], -0.01, 0.0005), size)
    if draw.chance(0.2):
        y = deep / 2 + 0.012
        path: list[Point] = [(-0.3 * wide, y, 0.005), (0.3 * wide, y, 0.005), (0.7 * wide, y + 0.05, 0.005)]
        made.add("misc", tube(path, 0.008, 6))


def _knob(made: _Work, at: Point, width: float) -> None:
    """The place of a knob that would be put there, for fingers from above."""
    x, y, z = at
    middle: Point = (x, y, z + _KNOB[1] * width)
    size = (0.3 * width, 0.5 * width + 0.003, 0.25 * width)
    made.sites.append(Site("knob", middle, size, ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0))))


def _slab(wide: float, deep: float, z: float, high: float, radius: float = 0.0) -> Manifold:
    return plate(rectangle(wide, deep, radius), z + high, high)
