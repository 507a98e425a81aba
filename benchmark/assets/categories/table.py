"""Tables: dining tables, desks, night tables, coffee tables, and the rare serving table with rails for towels.

Panels are the top (boards, leaves, pierced, waisted ...), its battens and a shelf of slats; a rail is a handle on no
drawer. Joints are hairlines, as in files of CAD: within the contact distance, yet solids of their own.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from manifold3d import CrossSection, Manifold

from benchmark.assets.asset import Design, Site
from benchmark.assets.categories.table_legs import HAIRLINE, Size, stand
from benchmark.assets.categories.table_tops import top
from benchmark.assets.draw import Draw
from meshforge.geometry import Floats
from script.samples import extras
from script.samples.drawers import FRONT, WALL, drawer
from script.samples.part import Part
from script.samples.solids import (
    Point,
    block,
    box,
    pebble,
    revolve,
    union,
)

LABELS = ("panel", "leg", "handle", "drawer", "misc")
KINDS = {"dining": 4, "round": 3, "desk": 5, "night": 5, "coffee": 5, "serving": 3}
RARE = frozenset({"serving"})

_APART = 0.012  # between drawers [m]
_SPOT = (0.3, 0.28)  # where things lie on a top, of its width and depth
_BACK = ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
_GRIP = ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
_DOWN = ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0))


def build(kind: str, draw: Draw) -> Design:
    """One table."""
    size, round_ = _size(kind, draw), kind == "round"
    board, slit, told = top(size, round_, draw)
    parts, about = [*board], [told]
    below, told = stand(size, round_, kind, draw)
    parts += below
    boxes, sites = _drawers(size, kind, draw)
    parts += boxes
    drawers = [part for part in boxes if part.label == "drawer"]
    about += [told, f"{len(drawers) or 'no'} drawer{'s' * (len(drawers) != 1)}"]
    if kind in ("night", "coffee", "serving"):
        low = min([size.low, *(part.solid.bounding_box()[2] for part in drawers)])
        shelf, more = _shelf(size, low, draw)
        parts, sites = parts + shelf, sites + more
        about.append("shelf")
    if kind == "serving":
        rails, more = _rails(size, draw)
        parts, sites = parts + rails, sites + more
        about.append("rails")
    surface = Site("surface", (0, 0, size.height), (0.2 * size.width, 0.2 * size.depth, slit))
    residue, more = _residue(size, below, draw)
    return Design(f"{kind}, " + ", ".join(about), (*parts, *residue), (surface, *sites, *more))


def _size(kind: str, draw: Draw) -> Size:
    """The measures of a table of a kind."""
    low, high, flat, tall = {
        "dining": (0.8, 2.0, 0.62, (0.66, 0.8)),
        "round": (0.5, 1.2, 1.0, (0.5, 0.78)),
        "desk": (1.0, 1.9, 0.48, (0.68, 0.8)),
        "night": (0.38, 0.6, 0.8, (0.45, 0.72)),
        "coffee": (0.6, 1.3, 0.6, (0.34, 0.48)),
        "serving": (0.7, 1.1, 0.55, (0.74, 0.95)),
    }[kind]
    width = draw.ratio(low, high)
    depth = width if kind == "round" else width * flat * draw.ratio(0.85, 1.2)
    thick = min(max(0.03 * width, 0.016), 0.04)
    return Size(width, depth, draw.length(*tall), thick, thick * draw.length(0.5, 0.8))


def _stacks(kind: str, draw: Draw) -> dict[float, int]:
    """Where stacks of drawers hang, of the width, and how many drawers each has."""
    if kind == "round":
        return {}
    if kind == "desk":
        return {-0.27: draw.number(1, 3), 0.27: draw.number(0, 3)}
    if kind == "serving":
        return draw.one(({}, {0.0: 1}, {-0.2: 1, 0.2: 1}))
    return {0.0: draw.number(1, 2) if kind == "night" else draw.number(0, 1)}


def _drawers(size: Size, kind: str, draw: Draw) -> tuple[list[Part], list[Site]]:
    """Drawers under the top, in stacks side by side, and where their insides and handles are tried."""
    w, d = size.width, size.depth
    stacks = _stacks(kind, draw)
    several = max(stacks.values(), default=0)
    wide = {"desk": 0.2, "serving": 0.66 if len(stacks) == 1 else 0.32, "night": 0.66}.get(kind, 0.4) * w
    deep = draw.length(0.55, 0.75) * d
    tall = min(0.16, 0.55 * size.low / max(several, 1), {"coffee": 0.3, "night": 0.22}.get(kind, 0.2) * size.low)
    jointed = draw.chance(0.5 if sum(stacks.values()) < 3 else 0.8)
    make, grip = _handle(min(0.5 * wide, 0.16), tall, draw)
    parts, sites = list[Part](), list[Site]()
    for x, count in stacks.items():
        for k in range(count):
            z = size.low - 0.008 - (tall + _APART) * (k + 1)
            front = -0.4 * d - (draw.length(0.2, 0.6) * deep if draw.chance(0.4) else 0.0)
            whole, pull = drawer(f"drawer_{len(parts) // 2 + 1}", (wide, deep, tall), make, x * w, front, z)
            parts += [_saw(whole) if jointed else whole, pull]
            rise = 0.3 * tall
            inside = (x * w, front + 0.5 * deep, z + 0.024 + rise)
            sites += [
                Site("drawer", inside, (0.3 * wide, 0.3 * deep, rise)),
                Site("handle", (x * w, front - grip[1] / 2, z + tall / 2), _fingers(grip), _GRIP),
            ]
    return parts, sites


def _saw(drawer: Part) -> Part:
    """A drawer sawn into its boards: its front, its sides, and its bottom with its back."""
    x0, y0, z0, x1, y1, z1 = drawer.solid.bounding_box()
    tall, deep, thin = 2 * (z1 - z0), 2 * (y1 - y0 - FRONT), WALL + 0.004
    saws = [box((1, HAIRLINE, tall), ((x0 + x1) / 2, y0 + FRONT, z0))]
    saws += [box((HAIRLINE, deep, tall), (x, y1, z0)) for x in (x0 + thin, x1 - thin)]
    middle = (x0 + x1) / 2
    saws.append(box((x1 - x0 - 2 * thin, HAIRLINE, tall), (middle, y1 - WALL, z0)))
    return Part(drawer.name, drawer.label, drawer.solid - union(saws))


def _handle(width: float, tall: float, draw: Draw) -> tuple[Callable[[], Manifold], Point]:
    """A handle without an eye, before the plane y = 0, and its size; split: of two pieces side by side."""
    w, e, h = width * draw.length(0.6, 1.0), draw.length(0.03, 0.045), min(0.22 * tall, draw.length(0.016, 0.026))
    style = draw.one(("block", "round", "wedge", "split"))
    back = -HAIRLINE
    whole = block((-w / 2, -e, -h / 2), (w / 2, back, h / 2))
    if style == "round":
        turn = np.linspace(0, np.pi, 9)
        arc = np.stack([w / 2 * np.cos(turn), back - (e + back) * np.sin(turn)], axis=1)
        whole = CrossSection([arc[::-1]]).extrude(h).translate((0, 0, -h / 2))
    if style == "wedge":
        rim = box((w, 0.004, 0.5 * h), (0, -e + 0.002, 0))
        whole = union([rim, box((0.7 * w, 0.004, h), (0, back - 0.002, 0))]).hull()
    if style == "split":
        whole -= box((HAIRLINE, 1, 1), (0, 0, 0))
    return lambda: whole, (w, e, h)


def _fingers(grip: Point) -> Point:
    """A gripper for a handle of that size, from above and below."""
    w, e, h = grip
    return 0.15 * e, 0.5 * h + 0.008, 0.2 * w


def _shelf(size: Size, low: float, draw: Draw) -> tuple[list[Part], list[Site]]:
    """A shelf of slats between the legs, the way between it and what is above, and the way where it is."""
    w, d, thick = size.width, size.depth, max(0.4 * size.thick, 0.008)
    count, gap = draw.number(1, 3), draw.length(0.02, 0.035)
    each = (0.7 * d - gap * (count - 1)) / count
    z = draw.length(0.25, 0.4) * low
    slats = [
        box((0.74 * w, each, thick), (0, (k - (count - 1) / 2) * (each + gap), z - thick / 2)) for k in range(count)
    ]
    between, across = low - z, (0.2 * w, 0.2 * w)
    sites = [
        Site("between", (0, -d / 2, (low + z) / 2), (d, across[0], 0.35 * between), _BACK),
        Site("below", (0, -d / 2, z), (d, across[1], 0.25 * z), _BACK),
    ]
    return [Part(f"slat_{k}", "panel", slat) for k, slat in enumerate(slats, 1)], sites


def _rails(size: Size, draw: Draw) -> tuple[list[Part], list[Site]]:
    """A rail at each end: a rod on two posts, and the eye behind it."""
    long, reach, rod = draw.length(0.5, 0.7) * size.depth, draw.length(0.05, 0.07), 0.016
    z, parts, sites = size.height - size.thick / 2, list[Part](), list[Site]()
    for side in (-1, 1):
        x = side * (size.width / 2 + reach)
        parts.append(Part(f"rail_{side}", "handle", box((rod, long, rod), (x, 0, z))))
        for end in (-1, 1):
            post = box((reach - rod / 2 - 2 * HAIRLINE, rod, rod), (side * (size.width + reach - rod / 2) / 2, 0, z))
            parts.append(Part(f"post_{side}_{end}", "handle", post.translate((0, end * 0.42 * long, 0))))
        eye = (side * (size.width + reach - rod / 2) / 2, 0.0, z + 0.04)
        sites.append(Site("rail", eye, (0.08, 0.2 * reach, 0.25 * long), _DOWN))
    return parts, sites


def _residue(size: Size, below: list[Part], draw: Draw) -> tuple[list[Part], list[Site]]:
    """What lies on the top and sticks to the feet, and the places to be cleared."""
    w, d, scale = size.width, size.depth, min(1.0, size.width / 1.1)
    spots = [(x * _SPOT[0] * w, y * _SPOT[1] * d) for x in (-1, 1) for y in (-1, 1)]
    parts, sites = list[Part](), list[Site]()
    for k in draw.rng.permutation(4)[: draw.number(2, 3)]:
        x, y = spots[k]
        thing = _thing(scale, draw)
        parts.append(thing.rename(f"{thing.name}_{k}").move(x, y, size.height + extras.LIFT))
        sites.append(Site("cleared", (x, y, size.height), (0.04 * w, 0.04 * d, 0.025)))
    for k in range(draw.number(0, 2)):
        at = (draw.one((-1, 1)) * draw.length(0.2, 0.33) * w, draw.length(0.4, 0.46) * d, 0.06 * size.height)
        parts.append(Part(f"crumb_{k}", "misc", pebble(at, 0.05 * scale, draw.rng)))
    for k in range(draw.number(1, 2) if draw.chance(0.8) else 0):
        x, y = _foot(below[k * (len(below) - 1)])
        lump = pebble((x, y, -0.012), draw.length(0.06, 0.09), draw.rng, 20)
        parts.append(Part(f"lump_{k}", "misc", lump.trim_by_plane((0, 0, -1), HAIRLINE)))
    return parts, sites


def _thing(scale: float, draw: Draw) -> Part:
    """Something that lies about, on z = 0."""
    name = draw.one(("heap", "heap", "book", "vase", "parcel"))
    solid = pebble((0, 0, 0), 0.14, draw.rng, 24).trim_by_plane((0, 0, 1), -0.02).translate((0, 0, 0.02))
    if name == "book":
        solid = extras.book(0, 0, 0, 0).solid
    elif name == "vase":
        solid = revolve([(0.04, 0), (0.055, 0.06), (0.02, 0.12), (0.03, 0.16)], 8)
    elif name == "parcel":
        solid = block((-0.08, -0.06, 0), (0.08, 0.06, 0.07)) + block((-0.02, -0.03, 0), (0.07, 0.05, 0.11))
    solid = solid.rotate((0, 0, draw.length(0, 360))).scale((scale,) * 3)
    return Part(name, "misc", solid.translate((0, 0, -solid.bounding_box()[2])))


def _foot(leg: Part) -> tuple[float, float]:
    """A place under a leg: the middle of its foot, of a wide one a place near its rim."""
    points: Floats = np.asarray(leg.solid.to_mesh64().vert_properties, np.float64)[:, :3]
    sole = points[points[:, 2] < 0.002, :2]
    middle = sole.mean(axis=0)
    far = sole[np.argmax((sole - middle) @ np.array([0.6, 0.8]))]
    x, y = middle if np.ptp(sole, axis=0).max() < 0.12 else middle + 0.85 * (far - middle)
    return float(x), float(y)
