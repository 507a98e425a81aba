"""Kettles: a hollow body on a base, a spout that is a pipe, a handle behind, a loose lid, on few a vent on it."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, cos, hypot, sin

import numpy as np
from manifold3d import Manifold

from benchmark.assets.asset import Design, Site
from benchmark.assets.categories.cup import LIFT, SEAM, lump, outline_polygon
from benchmark.assets.draw import Draw
from script.samples.part import Part
from script.samples.solids import Point, block, pebble, revolve, tube, union

LABELS = ("body", "base", "spout", "handle", "lid", "misc")
KINDS = {"stove": 8, "electric": 8, "pot": 6, "vented": 3}
RARE = frozenset({"vented"})

_SIDES = 12
_GRIP = ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))  # fingers along +Y close along X
_DOWN = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))  # fingers down close along Y


@dataclass(frozen=True)
class _Body:
    """The body between two heights: half its width below and above, how thick it is [m]."""

    low: float
    high: float
    below: float
    above: float
    thick: float

    @property
    def mouth(self) -> float:
        """Half the width of the opening above."""
        return self.above - self.thick

    def half(self, z: float) -> float:
        """Half the width at a height."""
        return self.below + (self.above - self.below) * (z - self.low) / (self.high - self.low)

    def beside(self, solid: Manifold, side: float, gap: float) -> Manifold:
        """What of a solid lies outside of the body's face at +X or -X, so far off it."""
        tilt = atan((self.below - self.above) / (self.high - self.low))
        offset = self.below * cos(tilt) + self.low * sin(tilt) + gap
        return solid.trim_by_plane((side * cos(tilt), 0, sin(tilt)), offset)

    @property
    def solid(self) -> Manifold:
        """The body, hollow and open above."""
        hollow = self._between(self.low + self.thick, self.high + 0.001, self.thick)
        return self._between(self.low, self.high, 0.0) - hollow

    def _between(self, low: float, high: float, inset: float) -> Manifold:
        bottom, top = self.half(low) - inset, self.half(high) - inset
        return outline_polygon(bottom, _SIDES).extrude(high - low, scale_top=(top / bottom,) * 2).translate((0, 0, low))


def build(kind: str, draw: Draw) -> Design:
    """A kettle of that kind, its spout at +X, its handle at -X."""
    below = draw.ratio(0.05, 0.1)
    taper = draw.length(0.72, 0.9) if kind == "stove" else draw.length(0.88, 1.04)
    height = below * (draw.ratio(1.9, 3.2) if kind == "electric" else draw.ratio(1.0, 2.0))
    low = max(0.008, draw.length(0.05, 0.1) * height)
    above = below * taper
    body = _Body(low, low + height, below, above, draw.length(0.08, 0.14) * below)
    parts = [Part("body", "body", body.solid), _base(body, draw)]
    spout, way = _spout(body, draw)
    handle, grip = _handle(body, draw)
    parts += [spout, handle]
    lid, top = _lid(body, draw)
    parts.append(lid)
    knobbed = draw.chance(0.8 if kind == "pot" else 0.35)
    if knobbed:
        parts.append(_knob(body, top, draw))
    if kind == "vented":
        parts.append(_vent(body, top, draw))
    parts += _residue(kind, body, way, draw, [part.solid for part in parts])
    knob = Site("knob", (0.0, 0.0, top + 0.0125), (0.004, 0.014, 0.004), _DOWN)
    about = f"{2e3 * below:.0f} x {1e3 * height:.0f} mm, {'a' if knobbed else 'no'} knob"
    return Design(about, tuple(parts), (way, grip, knob))


def _base(body: _Body, draw: Draw) -> Part:
    """A plate below the body."""
    top = body.low + (SEAM if draw.chance(0.1) else -SEAM)
    spread = draw.length(0.9, 1.2)
    foot = outline_polygon(body.below * spread, _SIDES).extrude(top, scale_top=(draw.length(0.85, 1.0),) * 2)
    return Part("base", "base", foot)


def _spout(body: _Body, draw: Draw) -> tuple[Part, Site]:
    """A pipe that rises straight from the body, its ends upright; the way of what flows through it."""
    height = body.high - body.low
    rise, share = height * draw.length(0.12, 0.2), draw.length(0.6, 0.7)
    tall, slope = share / (1 - share) * rise, draw.length(0.4, 0.9)
    wide, long = tall * draw.length(0.5, 0.9), rise / slope
    start = body.low + tall / 2 + height * draw.length(0.25, 0.98 - rise / height - tall / height)
    root = body.half(start)

    def pipe(inset: float) -> Manifold:
        ends = [(x, start + (x - root) * slope) for x in (0.6 * root - inset, root + long + inset)]
        rim = [(y * (wide / 2 - inset), z * (tall / 2 - inset)) for y in (-1, 1) for z in (-1, 1)]
        return Manifold.hull_points(np.array([(x, y, z + dz) for x, z in ends for y, dz in rim]))

    wall = 0.15 * min(tall, wide)
    solid = body.beside(pipe(0.0) - pipe(wall), 1.0, SEAM)
    lean = hypot(1.0, slope)
    probe = 0.8 * min(wide / 2 - wall, (tall / 2 - wall) / lean)
    first = root + probe * lean + 0.0015
    at = (first, 0.0, start + (first - root) * slope)
    axes = ((1 / lean, 0.0, slope / lean), (0.0, 1.0, 0.0), (-slope / lean, 0.0, 1 / lean))
    return Part("spout", "spout", solid), Site("way", at, (lean * (root + long - first) + probe, probe, probe), axes)


def _handle(body: _Body, draw: Draw) -> tuple[Part, Site]:
    """A bow, a bow with a slanted back, or a hook that is open below; where a gripper takes it."""
    height = body.high - body.low
    low, high = body.low + height * draw.length(0.1, 0.25), body.low + height * draw.length(0.75, 0.92)
    fused = draw.chance(0.12)
    thick = min((0.2 if fused else draw.length(0.12, 0.2)) * body.below, 0.18 * (high - low))
    reach = max(body.half(low), body.half(high)) + thick * draw.length(3.2, 5.0)
    inside, gap = 0.5 * body.below, -SEAM if fused else SEAM
    a, b, lean = low + thick, high - thick, draw.length(0.0, 0.5) * thick
    style = draw.one(("bow", "slanted", "hook"))
    path: list[Point] = [(-inside, 0, b), (-reach, 0, b)]
    path += [(-reach + lean, 0, a)] if style != "slanted" else [(-reach, 0, (a + 2 * b) / 3), (-reach + lean, 0, a)]
    if style != "hook":
        path.append((-inside, 0, a))
    solid = body.beside(tube(path, thick, 6), -1.0, gap)
    box = solid.bounding_box()
    deep, tall = box[3] - box[0], box[5] - box[2]
    at = (box[0] + 0.1 * deep, 0.0, box[2] + 0.5 * tall)
    return Part("handle", "handle", solid), Site("handle", at, (thick / 2 + 0.001, 0.2 * deep, 0.15 * tall), _GRIP)


def _lid(body: _Body, draw: Draw) -> tuple[Part, float]:
    """A disc that lies loosely over the mouth, on some a plug below it; and the height of its upper face."""
    z, r, thick = body.high + 0.0012, body.above * draw.length(0.9, 1.05), draw.length(0.004, 0.01)
    solid = outline_polygon(r, _SIDES).extrude(thick, scale_top=(draw.length(0.85, 1.0),) * 2).translate((0, 0, z))
    if draw.chance(0.4):
        deep = 1.2 * body.thick
        solid += outline_polygon(body.mouth - 0.0015, _SIDES).extrude(deep + 0.001).translate((0, 0, z - deep))
    return Part("lid", "lid", solid), z + thick


def _knob(body: _Body, top: float, draw: Draw) -> Part:
    """A knob on the lid."""
    w, h = body.mouth * draw.length(0.15, 0.3), draw.length(0.01, 0.022)
    profile = [(w * draw.length(0.5, 1.0), 0.0), (w, 0.6 * h), (0.7 * w, h)]
    return Part("knob", "handle", revolve(profile, 10).translate((0, 0, top + SEAM)))


def _vent(body: _Body, top: float, draw: Draw) -> Part:
    """A small nozzle for steam on the lid's front."""
    w, h = body.mouth * draw.length(0.1, 0.16), draw.length(0.008, 0.018)
    return Part("vent", "spout", revolve([(w, 0.0), (0.6 * w, h)], 10).translate((0.68 * body.mouth, 0, top + SEAM)))


def _residue(kind: str, body: _Body, way: Site, draw: Draw, others: list[Manifold]) -> list[Part]:
    """Crumbs, a cable at the base, scale in the spout, something that sticks to the handle."""
    made = list[Part]()
    size = draw.length(0.1, 0.25) * body.below
    for k in range(draw.number(0, 2)):
        turn = draw.length(0.6, 2.4) * draw.one((-1, 1))
        out = (float(np.cos(turn)), float(np.sin(turn)), 0.0)
        z = draw.one((size / 2, body.low + 0.5 * (body.high - body.low)))
        at = (1.25 * body.below * out[0], 1.25 * body.below * out[1], z)
        made.append(lump(at, out, size, [*others, *(part.solid for part in made)], draw).rename(f"crumb_{k}"))
    if kind == "electric" and draw.chance(0.6):
        edge = -others[1].bounding_box()[0] + LIFT
        first = block((-edge - 0.02, -0.003, 0), (-edge, 0.003, 0.006))
        path: list[Point] = [(-edge - 0.018, 0, 0.003), (-edge - 0.04, 0.03, 0.003), (-edge - 0.05, 0.09, 0.003)]
        made.append(Part("cable", "misc", union([first, tube(path, 0.006, 6)])))
    if draw.chance(0.35):
        middle = np.asarray(way.at) + np.asarray(way.axes[0]) * 0.5 * way.size[0]
        at = (float(middle[0]), 0.0, float(middle[2]))
        made.append(Part("scale", "misc", pebble(at, 1.5 * way.size[1], draw.rng, 10)))
    if draw.chance(0.35):
        low = others[3].bounding_box()
        spot = (low[0] + 0.1 * (low[3] - low[0]), 0.0, (low[2] + low[5]) / 2)
        whole = [*others, *(part.solid for part in made)]
        made.append(lump(spot, (0, draw.one((-1.0, 1.0)), 0), 0.8 * size, whole, draw, SEAM).rename("gum"))
    return made
