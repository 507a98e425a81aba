"""Knives that lie flat, tip to +X: a blade, a handle of scales or in one piece, a guard, often a sheath."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from manifold3d import CrossSection, Manifold

from benchmark.assets.asset import Design, Site
from benchmark.assets.categories.knife_blades import EDGE, blade
from benchmark.assets.draw import Draw
from script.samples.part import Part
from script.samples.solids import Point, block, box, revolve, tube, union

LABELS = ("blade", "handle", "guard", "sheath", "clip", "misc")
KINDS = {"chef": 5, "cleaver": 3, "bread": 3, "hunting": 4, "dagger": 4, "folding": 3, "belted": 3}
RARE = frozenset({"belted"})

_JOINT = 0.0002  # between parts that are joined, as in a file of an assembly [m]
_AIR = 0.0003  # between a blade and what it slides in [m]
_KNOB = 0.85  # of the template knob.obj, for a width of 1: how far behind the handle the middle of its head is
_FAR = 12.0  # a blade that is drawn goes on an arc so wide [m]
_MOUTH = 0.02  # of a sheath, from the guard [m]


@dataclass
class _Work:
    """What has been made so far, about the plane z = 0, the guard's face at x = 0, and its measures [m].

    thick: of the blade; long, wide, high: of the handle; end: how thick it is at its end, of its thickness;
    blade: its lowest and highest y, its length.
    """

    draw: Draw
    thick: float
    long: float
    wide: float
    high: float
    end: float = 1.0
    blade: tuple[float, float, float] = (0.0, 0.0, 0.0)
    parts: list[Part] = field(default_factory=list)
    sites: list[Site] = field(default_factory=list)

    def add(self, label: str, *solids: Manifold) -> None:
        for solid in solids:
            self.parts.append(Part(f"{label}_{len(self.parts)}", label, solid))

    def crumb(self, at: Point, size: Point) -> None:
        """A lump with a flat foot, its middle at `at`."""
        foot = np.array([(x, y, 0.0) for x in (-0.5, 0.5) for y in (-0.5, 0.5)])
        cloud = self.draw.rng.uniform((-0.6, -0.6, 0.3), (0.6, 0.6, 1.0), (7, 3))
        self.add("misc", Manifold.hull_points(np.concatenate([foot, cloud]) * size + at))


def build(kind: str, draw: Draw) -> Design:
    """One knife."""
    made = _Work(
        draw,
        thick=draw.length(0.0038, 0.006),
        long=draw.ratio(0.085, 0.15),
        wide=draw.length(0.024, 0.034),
        high=draw.length(0.018, 0.026),
    )
    shape = draw.one(("chef", "hunting", "dagger")) if kind == "belted" else kind
    if kind == "folding":
        about, sheathed = _pocket_knife(made), False
    else:
        about = _rigid_knife(made, shape)
        sheathed = kind == "belted" or draw.chance(0.65)
    if sheathed:
        _sheath(made, kind == "belted")
    _clips(made, kind == "belted")
    _residue(made, sheathed)
    _places(made)
    return _lay(made, f"{about}, sheathed" if sheathed else about)


def _lay(made: _Work, about: str) -> Design:
    """Lift all so that it lies on z = 0."""
    up = -min(part.solid.bounding_box()[2] for part in made.parts)
    sites = [replace(site, at=(site.at[0], site.at[1], site.at[2] + up)) for site in made.sites]
    return Design(about, tuple(part.move(z=up) for part in made.parts), tuple(sites))


def _rigid_knife(made: _Work, shape: str) -> str:
    """A blade that is fixed, by a tang between scales or in front of a grip."""
    draw = made.draw
    scales, g = draw.chance(0.6), draw.length(0.006, 0.016)
    solid, made.blade = blade(draw, shape, made.thick)
    half = made.thick / 2 + _JOINT
    big = draw.length(1.0, 1.5)
    tall, deep = made.high * min(big, 1.2) / 2, made.wide * big / 2
    if scales:
        end = 0.35 * made.long
        tang = block((-end, -0.2 * made.wide, -made.thick / 2), (0.001, 0.2 * made.wide, made.thick / 2))
        made.add("blade", union([solid, tang]))
        if draw.chance(0.5):
            side, room = 0.4 * made.wide, half - _JOINT
            made.add("handle", block((-made.long, -side, -room), (-end - 0.002, side, room)))
        made.add("guard", *(block((-g, -deep, low), (0, deep, low + tall - half)) for low in (half, -tall)))
        _scales(made, -g - _JOINT, half)
    else:
        made.add("blade", solid.translate((_JOINT, 0, 0)))
        made.add("guard", block((-g, -deep, -tall), (0, deep, tall)) if draw.chance(0.6) else _along(deep, tall, -g, 0))
        glued = draw.chance(0.4) and g * big**2 > 0.15 * made.long  # a thin guard would vanish in the grip's hull
        _grip(made, -g + 0.001 if glued else -g - _JOINT)
    return f"{shape} knife with {'scales' if scales else 'a grip'}"


def _along(y: float, z: float, begin: float, end: float) -> Manifold:
    """An oval disc about the X axis."""
    return revolve([(1.0, begin), (1.0, end)], 12).rotate((0, 90, 0)).scale((1, y, z))


def _scales(made: _Work, front: float, half: float) -> None:
    """Two plates of wood, sometimes hollowed for the fingers."""
    draw, back, w = made.draw, -made.long, made.wide / 2
    top = made.high / 2
    outline = CrossSection.square((front - back, 2 * w)).translate((back, -w))
    style = draw.one(("straight", "waisted", "fingers"))
    if style == "waisted":
        cut = CrossSection.circle(1.0, 24).scale((0.3 * made.long, 0.22 * w))
        outline -= cut.translate(((front + back) / 2, -w)) + cut.translate(((front + back) / 2, w))
    if style == "fingers":
        cut = CrossSection.circle(1.0, 12).scale((0.1 * made.long, 0.25 * w))
        for k in range(3):
            outline -= cut.translate((back + (0.28 + 0.22 * k) * made.long, -w))
    made.add("handle", *(outline.extrude(top - half).translate((0, 0, low)) for low in (half, -top)))


def _grip(made: _Work, front: float) -> None:
    """A handle in one piece."""
    draw, back, w, h = made.draw, -made.long, made.wide / 2, made.high / 2
    style = draw.one(("block", "oval", "barrel", "bobbin"))
    if style == "block":
        made.add("handle", block((back, -w, -h), (front, w, h)))
        return
    rows = {
        "oval": [(1.0, 0.0), (1.0, 1.0)],
        "barrel": [(0.8, 0.0), (1.0, 0.4), (0.8, 1.0)],
        "bobbin": [(1.0, 0.0), (1.0, 0.15), (0.72, 0.35), (0.72, 0.6), (0.95, 1.0)],
    }[style]
    profile = [(r, back + t * (front - back)) for r, t in rows]
    made.add("handle", revolve(profile, 12).rotate((0, 90, 0)).scale((1, w, h)))
    made.end = 0.9 if style == "barrel" else 1.0


def _pocket_knife(made: _Work) -> str:
    """A blade that turns about a pivot between the bolsters, into the handle."""
    draw = made.draw
    made.wide, made.high = 0.042, made.thick + draw.length(0.01, 0.014)
    half, w = made.thick / 2 + _AIR, made.wide / 2
    made.long = draw.length(0.1, 0.14)
    solid, (low, top, long) = blade(draw, "folding", made.thick)
    fit = min(1.0, (made.long - 0.02) / long)
    tall = 0.018 / -low
    made.add("blade", solid.scale((fit, tall, 1)))
    made.blade = (-0.018, top * tall, long * fit)
    g = 0.02
    made.add("guard", *(block((-g, -w, z), (0.008, w, z + made.high / 2 - half)) for z in (half, -made.high / 2)))
    _scales(made, -g - _JOINT, half)
    if draw.chance(0.7):
        room = half - _JOINT
        made.add("handle", block((-made.long, w - 0.002, -room), (-g - 0.005, w, room)))
    made.sites.append(Site("draw", (-0.004, 0, 0), (0.0, -165.0, 0.0), _ABOUT_Z, ("blade",)))
    return "folding knife"


_ABOUT_Z: tuple[Point, Point, Point] = ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def _sheath(made: _Work, belted: bool) -> None:
    """Two boards and what keeps them apart; of a belted one, two hooks that a belt lies on."""
    draw, (low, top, long) = made.draw, made.blade
    half, t, rim = made.thick / 2 + _AIR, draw.length(0.0025, 0.005), draw.length(0.004, 0.008)
    y0, y1, end = low - 0.005 - rim, top + 0.005 + rim, long + 0.008 + rim
    made.add("sheath", *(block((_MOUTH, y0, z), (end, y1, z + t)) for z in (half, -half - t)))
    room = half - _JOINT
    made.add("sheath", *(block((_MOUTH, y, -room), (end - rim - _JOINT, y + rim, room)) for y in (y0, y1 - rim)))
    if draw.chance(0.6):
        made.add("sheath", block((end - rim, y0, -room), (end, y1, room)))
    if belted:
        y, reach, s = y1 + _JOINT, draw.length(0.025, 0.035), half + t
        places = [_MOUTH + share * (end - _MOUTH) for share in (0.2, 0.75)]
        made.add("clip", *(block((x, y, -s), (x + 0.01, y + reach, 0)) for x in places))
        at: Point = ((places[0] + places[1]) / 2 + 0.005, y + 0.5 * reach, 0.005)
        made.sites.append(Site("belt", at, (0.45 * (end - _MOUTH), 0.3 * reach, 0.003)))
        return
    angle = -float(np.degrees((long + 0.01) / _FAR))
    middle: Point = (_MOUTH - long / 2, _FAR, 0)
    made.sites.append(Site("draw", middle, (0.0, angle, 0.0), _ABOUT_Z, ("blade", "handle", "guard", "clip", "misc")))


def _clips(made: _Work, always: bool) -> None:
    """What sticks out of the handle: a ring at its end, a clip on its side."""
    draw, back = made.draw, -made.long
    if always or draw.chance(0.5):
        r, x = draw.length(0.009, 0.014), back - _JOINT - 0.002
        ring: list[Point] = [(x - r + r * np.cos(a), r * np.sin(a), 0.0) for a in np.arange(7) * np.pi / 3]
        made.add("clip", union([tube(ring, 0.004, 6), Manifold.sphere(0.002, 6).translate(ring[0])]))
    if draw.chance(0.45):
        z, s = made.high / 2 + _JOINT, draw.length(0.35, 0.6) * made.long
        x = back + 0.25 * made.long
        foot = block((x, -0.004, z), (x + 0.01, 0.004, z + 0.006))
        made.add("clip", union([foot, block((x, -0.004, z + 0.004), (x + s, 0.004, z + 0.006))]))


def _residue(made: _Work, sheathed: bool) -> None:
    """Crumbs on the blade, a label on the handle, bits about."""
    draw, (low, top, long) = made.draw, made.blade
    if draw.chance(0.7):
        y = low + 0.55 * (top - low) if low + top else 0.0
        share = (y + 0.0045 - low) / (top - low) if y else 1.0
        z = EDGE + share * (made.thick / 2 - EDGE) + _JOINT
        reach = (0.006, _MOUTH - 0.006) if sheathed else (0.012, 0.5 * long)
        for k in range(1 if sheathed else draw.number(1, 3)):
            x = reach[0] + (reach[1] - reach[0]) * (draw.length(0.1, 0.9) + k) / 3
            made.crumb((x, y, z), (0.006, 0.009, draw.length(0.004, 0.01)))
    if draw.chance(0.4):
        size = (0.018, 0.016, 0.002)
        made.add("misc", box(size, (-0.6 * made.long, 0, -made.high / 2 - _JOINT - size[2] / 2)))
    for _ in range(draw.number(0, 2)):
        s = draw.length(0.006, 0.015)
        made.crumb((-draw.length(0.2, 1.0) * made.long, made.wide + s, -made.high / 2), (s, s, s))


def _places(made: _Work) -> None:
    """Where grippers would hold the handle, and a knob at its end."""
    m = min(made.wide, made.high) * made.end
    grip = ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0))
    made.sites.append(Site("grip", (-0.55 * made.long, 0, 0), (0.3 * made.wide, made.high / 2 + 0.003, 0.008), grip))
    knob = ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0))
    made.sites.append(Site("knob", (-made.long - _KNOB * m, 0, 0), (0.25 * m, 0.5 * m + 0.004, 0.2 * m), knob))
