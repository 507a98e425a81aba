"""Floor and desk lamps, lamps of two shades, and a few that hang from the ceiling; cords, and what is stuck to them."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, Manifold

from benchmark.assets.asset import Design, Site
from benchmark.assets.categories.lamp_shades import GAP, Shade, bars, draw_shade, struts
from benchmark.assets.draw import Draw
from script.samples.part import Part
from script.samples.solids import Point, bar, block, box, pebble, revolve, union

LABELS = ("base", "pole", "shade", "cord", "switch", "misc")
KINDS = {"floor": 9, "desk": 9, "twin": 4, "ceiling": 3}
RARE = frozenset({"ceiling"})


@dataclass(frozen=True)
class _Lamp:
    """What all parts must know [m]: height: of the rod's upper end; rod, foot: radii; plate: thickness of the base."""

    kind: str
    height: float
    rod: float
    foot: float
    plate: float
    glued: str
    draw: Draw


def build(kind: str, draw: Draw) -> Design:
    """One lamp."""
    if kind == "ceiling":
        return _pendant(draw)
    tall = kind == "floor" or (kind == "twin" and draw.chance(0.5))
    height = draw.ratio(0.75, 1.45) if tall else draw.ratio(0.24, 0.45)
    foot = draw.ratio(0.13, 0.19) if tall else draw.ratio(0.075, 0.12)
    rod = draw.length(0.011, 0.017) if tall else draw.length(0.007, 0.011)
    plate = foot * draw.length(0.14, 0.26)
    lamp = _Lamp(kind, height, rod, foot, plate, draw.one(("", "", "", "rod", "shade")), draw)
    shade = draw_shade(draw, foot * draw.ratio(0.95, 1.5), lamp.glued == "shade")
    style, base = _base(lamp)
    parts = [*base, *_rod(lamp)]
    spots, top = [(0.0, 0.0)], height
    if kind == "twin":
        reach, thick = shade.radius + draw.length(0.02, 0.06), 1.4 * rod
        spots = [(reach, 0.0), (-reach, 0.0)] if draw.chance(0.5) else [(0.0, reach), (0.0, -reach)]
        ends = [(x * 1.06, y * 1.06, height + GAP + thick / 2) for x, y in spots]
        parts.append(Part("arm", "pole", bar(ends[0], ends[1], thick, 6)))
        top = float(parts[-1].solid.bounding_box()[5])
    sites = [_grip(lamp, plate, height)]
    for k, (x, y) in enumerate(spots):
        made, site = _head(lamp, shade, top + GAP, k)
        parts += [part.move(x, y) for part in made]
        sites.append(Site(site.name, (x, y, site.at[2]), site.size, site.axes))
    parts += [_switch(lamp, 0.45 * height), _cord(lamp), *_residue(lamp, parts)]
    about = f"{style} base, {shade.style} shade, {len(spots)} of them, glued: {lamp.glued or 'nothing'}"
    return Design(about, tuple(parts), tuple(sites))


def _base(lamp: _Lamp) -> tuple[str, list[Part]]:
    """A base on the floor."""
    r, t, draw = lamp.foot, lamp.plate, lamp.draw
    style = draw.one(("disc", "square", "ring", "star", "tiles"))
    disc = CrossSection.circle(r, 20)
    solids: list[Manifold] = []
    if style == "disc":
        solids = [revolve([(r, 0), (r, 0.5 * t), (0.85 * r, t)], 20)]
    elif style == "square":
        solids = [box((1.8 * r, 1.8 * r, t), (0, 0, t / 2))]
    elif style == "ring":
        spokes = [box((1.8 * r, 0.3 * r, t), (0, 0, t / 2)).rotate((0, 0, turn)) for turn in (0, 90)]
        solids = [union([(disc - CrossSection.circle(0.78 * r, 20)).extrude(t), *spokes])]
    elif style == "star":
        toe, count = box((r, 0.26 * r, t), (r / 2, 0, t / 2)), draw.number(4, 6)
        toes = [toe.rotate((0, 0, 90 + k * 360 / count)) for k in range(count)]
        solids = [union([*toes, CrossSection.circle(0.35 * r, 12).extrude(t)])]
    else:
        quarter = disc ^ CrossSection.square((r, r)).translate((0.0012, 0.0012))
        solids = [quarter.extrude(t).rotate((0, 0, turn)) for turn in (0, 90, 180, 270)]
    return style, [Part(f"base_{k}", "base", solid) for k, solid in enumerate(solids)]


def _rod(lamp: _Lamp) -> list[Part]:
    """A rod on the base, with a collar below."""
    start = lamp.plate + (-0.003 if lamp.glued == "rod" else GAP)
    solid = revolve([(lamp.rod, start), (lamp.rod, lamp.height)], 12)
    return [Part("rod", "pole", solid)]


def _head(lamp: _Lamp, shade: Shade, top: float, number: int) -> tuple[list[Part], Site]:
    """A socket, a shade about and above it, and what holds the shade; where a bulb goes in from above."""
    cup, high = 2.2 * lamp.rod, 3.0 * lamp.rod
    socket = revolve([(0.8 * lamp.rod, top), (cup, top + 0.6 * high), (cup, top + high)], 12)
    low = top + high + 0.01 + 0.004 * lamp.height
    body = shade.solid.translate((0, 0, low))
    parts = [Part(f"socket_{number}", "pole", socket), Part(f"shade_{number}", "shade", body)]
    wire = max(0.0025, 0.3 * lamp.rod)
    held = struts(shade, shade.wires, 0.7 * cup, top + high + GAP, low, wire)
    held += bars(shade, shade.crossing, 0.78, low, wire)
    parts += [Part(f"wire_{number}_{k}", "pole", solid) for k, solid in enumerate(held)]
    radius = 0.32 * shade.inner(0.95)
    start, end = low + shade.height + 1.3 * radius, top + high + 1.25 * radius + 0.004
    axes: tuple[Point, Point, Point] = ((0, 0, -1), (1, 0, 0), (0, -1, 0))
    return parts, Site("bulb", (0, 0, start), (start - end, radius, radius), axes)


def _grip(lamp: _Lamp, low: float, high: float) -> Site:
    """Where the rod is gripped."""
    axes: tuple[Point, Point, Point] = ((0, 1, 0), (1, 0, 0), (0, 0, -1))
    return Site("pole", (0, 0, low + 0.68 * (high - low)), (2.0 * lamp.rod, 2.5 * lamp.rod, 1.2 * lamp.rod), axes)


def _switch(lamp: _Lamp, z: float) -> Part:
    size = 2.2 * lamp.rod
    if lamp.draw.chance(0.5):
        return Part("switch", "switch", box((0.7 * size, size, 1.6 * size), (lamp.rod + GAP + 0.35 * size, 0, z)))
    knob = revolve([(0.25 * size, 0), (0.6 * size, 0.3 * size), (0.5 * size, size)], 10).rotate((0, 90, 0))
    return Part("switch", "switch", knob.translate((lamp.rod + GAP, 0, z)))


def _cord(lamp: _Lamp) -> Part:
    """A cord from the rear of the base along the floor; mostly it hangs down over an edge."""
    draw, r = lamp.draw, lamp.foot
    thick = 0.05 * r + 0.003
    z, x, away = 0.6 * thick, draw.length(-0.5, 0.5) * r, draw.length(0.7, 1.6) * r
    y = r + GAP + thick / 2 * abs(x) / float(np.hypot(x, away))
    far = y + away
    if draw.chance(0.78):
        path: list[Point] = [(0, y, z), (x, far, z), (x * 1.3, far + 0.3 * r, -draw.length(0.2, 1.2) * r)]
    else:
        path = [(0, y, z), (x, far, z), (x + r, far + draw.length(-0.3, 0.6) * r, z)]
    return Part("cord", "cord", union([bar(a, b, thick, 6) for a, b in itertools.pairwise(path)]))


def _residue(lamp: _Lamp, parts: list[Part]) -> list[Part]:
    """A price tag on the rod, lumps on the shade and beside the lamp."""
    draw, r, made = lamp.draw, lamp.foot, list[Part]()
    if draw.chance(0.6):
        low, size = 0.22 * lamp.height, 0.3 * r
        tag = block((-lamp.rod - GAP - 0.004, -0.6 * size, low), (-lamp.rod - GAP, 0.6 * size, low + size))
        made.append(Part("tag", "misc", tag))
    shade = next(part.solid for part in parts if part.label == "shade").bounding_box()
    if draw.chance(0.5):
        side = 0.14 * r
        at = (shade[3] + 0.5 * side + GAP, (shade[1] + shade[4]) / 2, (shade[2] + shade[5]) / 2)
        made.append(Part("leaf", "misc", box((side, 2 * side, side), at)))
    if draw.chance(0.5):
        for k in range(draw.number(1, 3)):
            turn, away = draw.length(-2.6, -0.5), r * draw.length(1.3, 1.8)
            at = (away * float(np.cos(turn)), away * float(np.sin(turn)), 0.13 * r)
            made.append(Part(f"lump_{k}", "misc", pebble(at, 0.22 * r, draw.rng)))
    return made


def _pendant(draw: Draw) -> Design:
    """A lamp that hangs: a canopy at the ceiling, a hub on two hangers, a rod, a shade that is closed above."""
    canopy, top = draw.ratio(0.06, 0.1), draw.length(2.0, 2.5)
    lamp = _Lamp("ceiling", top, draw.length(0.008, 0.012), canopy, 0.25 * canopy, "", draw)
    shade = draw_shade(draw, draw.ratio(0.17, 0.25), False, closed=True)
    under = top - lamp.plate
    room, deep, wide = canopy * draw.length(0.9, 1.3), 0.6 * canopy, 0.6 * canopy
    hub_top = under - room
    hub = revolve([(0.6 * wide, hub_top - deep), (wide, hub_top - 0.6 * deep), (wide, hub_top)], 14)
    rod_top = hub_top - deep - GAP
    rod_low = rod_top - draw.ratio(0.14, 0.32)
    low = rod_low - GAP - shade.height
    wire = 0.35 * lamp.rod
    parts = [
        Part("canopy", "base", revolve([(0.8 * canopy, under), (canopy, under + 0.4 * lamp.plate), (canopy, top)], 18)),
        Part("hub", "base", hub),
        Part("rod", "pole", revolve([(lamp.rod, rod_low), (lamp.rod, rod_top)], 12)),
        Part("shade_0", "shade", shade.solid.translate((0, 0, low))),
    ]
    for k, s in enumerate((-1, 1)):
        hanger = box((2 * wire, 2 * wire, room - 2 * GAP), (s * 0.7 * wide, 0, under - room / 2))
        parts.append(Part(f"hanger_{k}", "pole", hanger))
    cross = bars(shade, shade.crossing, 0.3, low, wire)
    parts += [Part(f"wire_0_{k}", "pole", solid) for k, solid in enumerate(cross)]
    radius = 0.32 * shade.inner(0.6)
    start, end = low - 1.3 * radius, low + shade.height - shade.wall - 1.2 * radius - 0.004
    up: tuple[Point, Point, Point] = ((0, 0, 1), (1, 0, 0), (0, 1, 0))
    sites = [
        _grip(lamp, rod_low, rod_top),
        Site("bulb", (0, 0, start), (end - start, radius, radius), up),
        Site("reach", (0, -canopy - 0.05, under - room / 2), (2 * canopy + 0.1, 0.35 * wide, 0.3 * room), _ACROSS),
    ]
    parts.append(_switch(lamp, (rod_low + rod_top) / 2 - 0.06 * (rod_top - rod_low)))
    thick = 0.008
    z, y = top - thick, canopy + GAP
    path: list[Point] = [(0, y, z), (0.05, y + 0.15, z), (0.05, y + 0.2, top + 0.1)]
    parts.append(Part("cord", "cord", union([bar(a, b, thick, 6) for a, b in itertools.pairwise(path)])))
    if draw.chance(0.6):
        at = (0.0, -shade.radius - 0.012 - GAP, low + 0.1 * shade.height)
        parts.append(Part("leaf", "misc", box((0.02, 0.024, 0.02), at)))
    return Design(f"{shade.style} shade below a canopy, a hub and a rod", tuple(parts), tuple(sites))


_ACROSS: tuple[Point, Point, Point] = ((0, 1, 0), (-1, 0, 0), (0, 0, 1))
