"""Cups: a hollow wall on a base, with ears, some with a lid and its knob, few with a spoon in them."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi

import numpy as np
from manifold3d import CrossSection, Manifold

from benchmark.assets.asset import Design, Site
from benchmark.assets.draw import Draw
from script.samples.part import Part
from script.samples.solids import Point, bar, box, chamfer, pebble, revolve, taper, union

LABELS = ("wall", "base", "handle", "lid", "spoon", "misc")
KINDS = {"mug": 9, "teacup": 5, "square": 3, "lidded": 5, "spooned": 3}
RARE = frozenset({"spooned"})

SEAM = 0.00005  # between parts that are put together, not fused [m]
LIFT = 0.0006  # between what lies on a thing and the thing [m]
_ALONG_Y = ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))  # fingers along +Y close along X


@dataclass(frozen=True)
class _Wall:
    """The wall between two heights: half the width across its flat sides below and above, and how thick it is [m]."""

    low: float
    high: float
    below: float
    above: float
    thick: float
    sides: int

    def half(self, z: float) -> float:
        """Half the width at a height."""
        return self.below + (self.above - self.below) * (z - self.low) / (self.high - self.low)

    @property
    def solid(self) -> Manifold:
        """The wall, open above and below."""
        return self._fill(0.0) - self._fill(self.thick)

    def _fill(self, inset: float) -> Manifold:
        more = 0.002 if inset else 0.0
        bottom, top = (self.half(z) - inset for z in (self.low - more, self.high + more))
        outline = outline_polygon(bottom, self.sides)
        return outline.extrude(self.high - self.low + 2 * more, scale_top=(top / bottom,) * 2).translate(
            (0, 0, self.low - more)
        )


def build(kind: str, draw: Draw) -> Design:
    """A cup of that kind, its ears at +X."""
    half = draw.ratio(0.028, 0.055)
    sides = 4 if kind == "square" else draw.one((20, 20, 16, 12, 8))
    taper = draw.length(0.72, 0.88) if kind == "teacup" else draw.one((1.0, 1.0, draw.length(0.88, 1.05)))
    height = half * (draw.ratio(1.2, 2.0) if kind == "teacup" else draw.ratio(1.5, 3.6))
    low = max(0.17 * half, height * draw.length(0.06, 0.13))
    wall = _Wall(low + SEAM, low + height, half * taper, half, half * draw.length(0.09, 0.13), sides)
    parts = [Part("wall", "wall", wall.solid), *_base(wall, draw)]
    ears, sites = _ears(wall, draw)
    parts += ears
    if kind == "lidded" or (kind != "spooned" and draw.chance(0.1)):
        parts += _lid(wall, draw)
    if kind == "spooned":
        parts += _spoon(wall, draw)
    parts += _residue(wall, draw, [part.solid for part in parts])
    sites += _rooms(wall, empty=kind != "spooned", top=_top(parts))
    about = f"{sides} sides, {len(ears)} ears, {1e3 * half:.0f} x {1e3 * height:.0f} mm"
    return Design(about, tuple(parts), tuple(sites))


def outline_polygon(half: float, sides: int) -> CrossSection:
    """A regular polygon by half its width across flats, a flat to +X; of four sides, a square without its corners."""
    if sides == 4:
        return chamfer(2 * half, 2 * half, 0.3 * half)
    return CrossSection.circle(half / cos(pi / sides), sides).rotate(180 / sides)


def lump(near: Point, away: Point, size: float, others: list[Manifold], draw: Draw, gap: float = LIFT) -> Part:
    """A lump of residue that is pushed along `away` until it is as far as `gap` from all others."""
    solid, way = pebble(near, size, draw.rng, 10), np.asarray(away)
    whole = union(others)
    low, high = 0.0, 0.2
    for _ in range(24):
        middle = (low + high) / 2
        moved = solid.translate(tuple(middle * way))
        clear = (moved ^ whole).is_empty() and moved.min_gap(whole, 0.01) >= gap
        low, high = (low, middle) if clear else (middle, high)
    return Part("lump", "misc", solid.translate(tuple(high * way)))


def _base(wall: _Wall, draw: Draw) -> list[Part]:
    """What closes the wall below: a disc, a plinth, a ring below a disc, or a disc on feet."""
    fused = draw.chance(0.15)
    top, r = (wall.low + 0.0005 if fused else wall.low - SEAM), wall.below
    about = 16 if wall.sides != 4 else 4
    disc = outline_polygon(r, about).extrude(top * 0.6).translate((0, 0, top * 0.4))
    style = draw.one(("disc", "plinth", "ring", "feet"))
    if style == "disc":
        solid = outline_polygon(r * draw.length(0.9, 1.0), about).extrude(top)
    elif style == "plinth":
        spread = draw.length(1.05, 1.25)
        solid = outline_polygon(r * spread, about).extrude(top, scale_top=(1 / spread, 1 / spread))
    elif style == "ring":
        solid = disc + (outline_polygon(0.85 * r, about) - outline_polygon(0.6 * r, about)).extrude(top * 0.5)
    else:
        turns = (np.arange(count := draw.number(3, 5)) + 0.25) * 2 * pi / count
        spots = [(0.75 * r * np.cos(a), 0.75 * r * np.sin(a)) for a in turns]
        solid = union([disc, *(taper((x, y, 0), (x, y, top * 0.5), 0.2 * r, 0.3 * r, 6) for x, y in spots)])
    return [Part("base", "base", solid)]


def _ears(wall: _Wall, draw: Draw) -> tuple[list[Part], list[Site]]:
    """One ear or two, each of two arms that are screwed together outside; where a gripper takes them."""
    count = 2 if draw.chance(0.25) else 1
    fused = count == 1 and draw.chance(0.06)
    length = wall.high - wall.low
    bottom, top = wall.low + length * draw.length(0.1, 0.2), wall.low + length * draw.length(0.8, 0.92)
    step = (top - bottom + 0.003) / count
    reach = wall.above * draw.ratio(0.5, 1.3) / (1.2 if count == 2 else 1.0)
    parts, sites = [], []
    for k in range(count):
        low, high = bottom + k * step, bottom + (k + 1) * step - 0.003
        thick, wide = min(0.2 * reach, 0.2 * (high - low)), draw.length(0.14, 0.22) * wall.below * (1 + 0.5 * fused)
        tip = low + (high - low) * draw.length(0.35, 0.65)
        sunk = -SEAM if fused else SEAM
        inner, end = max(wall.half(low), wall.half(high)), max(wall.half(low), wall.half(high)) + reach
        roots = ((high - thick, high), (low, low + thick))
        arms = [_arm(wall, sunk, root, (end, tip), thick, wide) for root in roots]
        parts.append(Part(f"ear_{k}", "handle", union(arms)))
        at = (end - 0.1 * reach, 0.0, (low + high) / 2)
        size = (wide / 2 + 0.001, 0.2 * (end - inner), 0.2 * (high - low))
        sites.append(Site("handle", at, size, _ALONG_Y))
    return parts, sites


def _arm(
    wall: _Wall, sunk: float, root: tuple[float, float], tip: tuple[float, float], thick: float, wide: float
) -> Manifold:
    """A straight arm from the wall between two heights to the tip (x, z), whose outer end is on the tip's side."""
    x, z = tip
    side = 1 if root[0] > z else -1
    outline = [(wall.half(h) + sunk, h) for h in root]
    z += side * SEAM / 2
    outline += [(x, z), (x - 1.2 * thick, z), (x, z + side * 0.6 * thick)]
    return Manifold.hull_points(np.array([(a, b, c) for a, c in outline for b in (-wide / 2, wide / 2)]))


def _lid(wall: _Wall, draw: Draw) -> list[Part]:
    """A lid that lies on the rim, and a knob on it."""
    z, r, thick = wall.high + 0.001, wall.above * draw.length(0.95, 1.06), draw.length(0.003, 0.006)
    plate = outline_polygon(r, 16).extrude(thick, scale_top=(draw.length(0.75, 1.0),) * 2).translate((0, 0, z))
    w, h = r * draw.length(0.18, 0.35), draw.length(0.01, 0.02)
    waist = draw.length(0.6, 1.0)
    knob = revolve([(w * waist, 0), (w, 0.5 * h), (0.7 * w, h)], 10).translate((0, 0, z + thick + SEAM))
    return [Part("lid", "lid", plate), Part("knob", "handle", knob)]


def _spoon(wall: _Wall, draw: Draw) -> list[Part]:
    """A spoon that stands in the cup and leans towards its ears, its grip above the rim."""
    room = wall.below - wall.thick
    foot = np.array([-0.5 * room, 0.0, wall.low + 0.3 * room])
    edge = np.array([0.55 * (wall.above - wall.thick), 0.0, wall.high + 0.006])
    way = (edge - foot) / np.linalg.norm(edge - foot)
    width = draw.length(0.05, 0.08) * room + 0.002
    bowl = Manifold.sphere(1.0, 12).scale((0.16 * room, 0.24 * room, 0.26 * room)).translate(tuple(foot))
    stem = bar(tuple(foot), tuple(edge), width, 6)
    start = edge + way * SEAM
    grip = bar(tuple(start), tuple(start + way * draw.length(0.05, 0.1)), 1.6 * width, 8)
    return [Part("spoon", "spoon", bowl + stem), Part("spoon_grip", "handle", grip)]


def _residue(wall: _Wall, draw: Draw, others: list[Manifold]) -> list[Part]:
    """Crumbs on the floor and about, a sticker or a tag beside the wall, something that sticks to an ear."""
    r, made = wall.above, list[Part]()
    size = draw.length(0.12, 0.3) * r
    for k in range(draw.number(0, 3)):
        turn = draw.length(0.6, 2 * pi - 0.6)
        way = (float(np.cos(turn)), float(np.sin(turn)), 0.0)
        z = draw.one((size / 2, wall.low + 0.5 * (wall.high - wall.low)))
        at = (1.15 * r * way[0], 1.15 * r * way[1], z)
        made.append(lump(at, way, size, [*others, *(part.solid for part in made)], draw).rename(f"crumb_{k}"))
    if draw.chance(0.35):
        face = max(wall.below, wall.above) / (cos(pi / wall.sides) if wall.sides != 4 else 1.0)
        tag = box((0.35 * r, 0.0012, 0.5 * r), (0, -face - 0.0018, wall.low + 0.55 * (wall.high - wall.low)))
        made.append(Part("tag", "misc", tag))
    if draw.chance(0.35):
        ear = others[2].bounding_box()
        at = ((ear[0] + ear[3]) / 2, 0.0, (ear[2] + ear[5]) / 2)
        whole = [*others, *(part.solid for part in made)]
        made.append(lump(at, (0, draw.one((-1.0, 1.0)), 0), size, whole, draw, SEAM).rename("gum"))
    return made


def _top(parts: list[Part]) -> float:
    """How high wall and lid reach [m]."""
    return max(float(part.solid.bounding_box()[5]) for part in parts if part.label in ("wall", "lid"))


def _rooms(wall: _Wall, empty: bool, top: float) -> list[Site]:
    """What fits into the cup once it is empty, and as it is; the way of what is pushed over its top."""
    depth = wall.high - wall.low
    radius = 0.955 * (min(wall.below, wall.above) - wall.thick)
    half = 0.3 * depth
    inside = Site("inside", (0.0, 0.0, wall.low + 0.06 * depth + half), (radius, radius, half))
    r = wall.above
    above = Site("above", (-1.5 * r, 0.0, top + 0.009), (3 * r, r, 0.0015))
    return [inside, above, *([Site("room", inside.at, inside.size)] if empty else [])]
