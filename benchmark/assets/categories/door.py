"""Doors, from cupboard to barn: panelled, boarded, louvred, glazed; rare: with pegs for coats on the frame.

A rebated jamb is one hull at any setting, and that hull reaches into the leaf: the door jams. The hinges are on the
left, the leaf opens to the front. Hinges balance about the middle of the leaf by a plate on its back. A door that is
drawn again has an arched hood: many doors are all of convex solids, which are the same hulls at any setting.
"""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, Manifold

from benchmark.assets.asset import Design, Site
from benchmark.assets.categories.door_leaves import HAIRLINE, LEAVES, Size
from benchmark.assets.draw import Draw
from meshforge.geometry import convex_hull
from script.samples.part import Part
from script.samples.solids import Point, block, box, pebble, taper, union

LABELS = ("frame", "sill", "leaf", "handle", "hinge", "misc")
KINDS = {"panelled": 6, "boarded": 6, "louvred": 5, "glazed": 5, "pegged": 3}
RARE = frozenset({"pegged"})

_AXIS = ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
_MOVING = ("leaf", "handle", "hinge")


def build(kind: str, draw: Draw) -> Design:
    """One door."""
    size = _size(draw)
    style = kind if kind != "pegged" else draw.one(("panelled", "boarded", "louvred", "glazed", "flush"))
    stile = size.width * draw.length(0.15, 0.2)
    leaf = LEAVES[style](size, stile, draw)
    frame = _frame(size, draw)
    handles, sites = _handles(size, stile, draw)
    axis, hinges = _hinges(size, stile, draw)
    parts = [*frame, *leaf, *handles, *hinges]
    for name, turn in (("ajar", 50.0), ("open", 90.0)):
        sites.append(Site(name, axis, (0.0, turn, 0.0), _AXIS, _MOVING))
    if kind == "pegged":
        pegs, more = _pegs(size, draw)
        parts, sites = parts + pegs, sites + more
    parts += _residue(size, axis, draw)
    about = f"{style}, {'rebated' if size.stop else 'plain'} frame, {len(handles)} handle{'s' * (len(handles) > 1)}"
    return Design(about, tuple(parts), tuple(sites))


def _size(draw: Draw) -> Size:
    height = draw.ratio(0.8, 2.4)
    width = height * draw.ratio(0.36, 0.56)
    scale = max(0.45, height / 2.1)
    stop = 0.0 if draw.chance(0.12) else 0.018 * width
    foot = (0.02 + 0.03 * draw.rng.random()) * scale + 0.006
    return Size(width, height, (0.03 + 0.015 * draw.rng.random()) * scale + 0.006, foot,
                draw.length(0.07, 0.14) * scale, 0.005 * width, stop, scale)  # fmt: skip


def _frame(size: Size, draw: Draw) -> list[Part]:
    """Two jambs, a lintel, sometimes a cornice, and a sill whose middle is below the frame's."""
    edge, top = size.width / 2 + size.gap, size.head + size.gap + size.jamb
    back, low, rebate = size.thick + 0.003, size.foot - 0.006, size.width / 2 - size.stop
    profile = [(edge, 0.0), (edge + size.jamb, 0.0), (edge + size.jamb, size.deep), (edge, size.deep)]
    if size.stop:
        profile[3:] = [(rebate, size.deep), (rebate, back), (edge, back)]
    right = CrossSection([np.array(profile)]).extrude(top - low).translate((0, 0, low + HAIRLINE))
    reach, inner = edge - HAIRLINE, rebate - HAIRLINE
    lintel = block((-reach, 0, size.head + size.gap), (reach, size.deep, top + HAIRLINE))
    if size.stop:
        ends = [block((x, back - HAIRLINE, 0), (x + 9, 1, 9)) for x in (inner, -inner - 9)]
        lintel = union([lintel, block((-inner, back, size.head - size.stop), (inner, size.deep, top))]) - union(ends)
    wide, lap = edge + size.jamb, 0.03 * size.scale
    solids = [("jamb_left", right.mirror((1, 0, 0))), ("jamb_right", right), ("lintel", lintel)]
    if draw.chance(0.4):
        z = top + 3 * HAIRLINE
        solids.append(("cornice", block((-wide - lap, -lap, z), (wide + lap, size.deep, z + 1.6 * lap))))
    if draw.attempt:
        right = _hood(wide, _middle([solid for _, solid in solids]), solids[-1][1], size, draw)
        solids += [("hood_left", right.mirror((1, 0, 0))), ("hood_right", right)]
    half, middle = draw.length(0.7, 1.3) * size.deep, _middle([solid for _, solid in solids])
    sill = Part("sill", "sill", block((-wide, middle - half, 0), (wide, middle + half, low)))
    return [sill, *(Part(name, "frame", solid) for name, solid in solids)]


def _hood(wide: float, middle: float, below: Manifold, size: Size, draw: Draw) -> Manifold:
    """The right half of an arch over what is below, its middle as far back as the frame's.

    As one solid its hulls would be heavier on one side, and doors that stand by sill and frame would lean.
    """
    rise, thick = draw.length(0.5, 1.0), size.jamb * draw.length(0.6, 1.0)
    arch = CrossSection.circle(wide, 24) - CrossSection.circle(wide - thick, 24)
    arch = (arch ^ CrossSection.square((wide, wide)).translate((HAIRLINE / 2, 0))).scale((1, rise))
    solid = arch.extrude(size.deep).rotate((90, 0, 0))
    return solid.translate((0, middle + size.deep / 2, below.bounding_box()[5] + HAIRLINE))


def _middle(solids: list[Manifold]) -> float:
    """How far back the middle of these is, each as its convex hull."""
    hulls = [convex_hull(np.asarray(solid.to_mesh64().vert_properties, np.float64)[:, :3]) for solid in solids]
    volumes = [hull.volume for hull in hulls]
    return float(np.average([hull.centroid[1] for hull in hulls], weights=volumes))


def _handles(size: Size, stile: float, draw: Draw) -> tuple[list[Part], list[Site]]:
    """One or two handles without an eye, above one another, each upright."""
    count = draw.one((1, 1, 2))
    wide = min(draw.length(0.03, 0.045) * size.scale, 0.5 * stile)
    deep, long = draw.length(0.05, 0.075) * size.scale, draw.length(0.07, 0.17) * size.height
    middle = size.foot + draw.length(0.46, 0.54) * size.height
    style, back = draw.one(("block", "wedge", "split", "tapered")), -HAIRLINE
    x, parts, sites = size.width / 2 - stile / 2, list[Part](), list[Site]()
    for k in range(count):
        z = middle + (k - (count - 1) / 2) * (long + 0.04 * size.height)
        solid = _grip((wide, deep, long), back, style).translate((x, 0, z))
        parts.append(Part(f"handle_{k + 1}", "handle", solid))
        sites.append(Site("handle", (x, -0.825 * deep, z), (0.5 * wide, 0.4 * deep, 0.2 * long)))
    return parts, sites


def _grip(size: Point, back: float, style: str) -> Manifold:
    """A lump to hold on to before the plane y = 0; split: of two pieces."""
    w, e, h = size
    whole = block((-w / 2, -e, -h / 2), (w / 2, back, h / 2))
    if style == "split":
        return whole - box((9, 9, HAIRLINE), (0, 0, 0.1 * h))
    if style == "wedge":
        rim = box((w, 0.005, h), (0, -e + 0.0025, 0))
        return union([rim, box((0.6 * w, 0.004, 0.8 * h), (0, back - 0.002, 0))]).hull()
    if style == "tapered":
        rim = box((0.6 * w, 0.005, 0.7 * h), (0, -e + 0.0025, 0))
        return union([rim, box((w, 0.004, h), (0, back - 0.002, 0))]).hull()
    return whole


def _hinges(size: Size, stile: float, draw: Draw) -> tuple[Point, list[Part]]:
    """The axis, and hinges: a barrel, perhaps a strap in front, and behind the leaf a plate that balances them."""
    radius, slim = 0.011 * size.scale, 0.005 * size.scale
    x, y, half = -size.width / 2 - size.gap / 2, -radius - HAIRLINE, size.thick / 2
    tall, strap = 0.045 * size.height, draw.length(0.7, 1.0) * stile if draw.chance(0.5) else 0.0
    barrel = taper((x, y, -tall), (x, y, tall), 2 * radius, 2 * radius, 10)
    arm = half + HAIRLINE + slim / 2
    moment = barrel.volume() * (half - y) + strap * slim * tall * arm
    start = -size.width / 2 + size.stop + 0.01 * size.scale
    plate = block((start, 2 * half + HAIRLINE, -0.5 * tall),
                  (start + moment / (arm * slim * tall), 2 * half + HAIRLINE + slim, 0.5 * tall))  # fmt: skip
    pieces = {"barrel": barrel, "plate": plate}
    if strap:
        begin = -size.width / 2 + radius
        pieces["strap"] = block((begin, -HAIRLINE - slim, -0.5 * tall), (begin + strap, -HAIRLINE, 0.5 * tall))
    rises = (0.13, 0.87) if draw.chance(0.6) else (0.13, 0.5, 0.87)
    parts = [
        Part(f"{name}_{k}", "hinge", solid.translate((0, 0, size.foot + rise * size.height)))
        for k, rise in enumerate(rises, 1)
        for name, solid in pieces.items()
    ]
    return (x, y, size.foot), parts


def _pegs(size: Size, draw: Draw) -> tuple[list[Part], list[Site]]:
    """Slanting pegs on the right jamb, the way of a loop onto each, and the way along the jamb where they are."""
    x, s, parts, sites = size.width / 2 + size.gap + size.jamb / 2, size.scale, list[Part](), list[Site]()
    rises = (0.55, 0.68, 0.8)[: draw.number(1, 3)]
    for k, rise in enumerate(rises, 1):
        z = size.foot + rise * size.height
        foot = box((0.024 * s, 0.004, 0.03 * s), (x, -HAIRLINE - 0.002, z))
        tip = box((0.02 * s,) * 3, (x, -0.08 * s, z + 0.08 * s))
        parts.append(Part(f"peg_{k}", "handle", union([foot, tip]).hull()))
        sites.append(Site("peg", (x, -0.033 * s, z + 0.14 * s), (0.06 * s, 0.009 * s, 0.009 * s), _AXIS))
    top = (x, -0.045 * s, size.foot + 0.9 * size.height)
    return parts, [*sites, Site("jamb", top, (0.4 * size.height, 0.02 * s, 0.02 * s), _AXIS)]


def _residue(size: Size, axis: Point, draw: Draw) -> list[Part]:
    """What stands behind the door, lies on the frame and, often, where the leaf swings when it opens wide."""
    s, wide, parts = size.scale, size.width / 2, list[Part]()
    if draw.chance(0.7):
        turn = np.radians(draw.length(76, 84))
        radius, tall = draw.length(0.5, 0.8) * size.width, draw.length(0.1, 0.3) * size.height
        x, y = axis[0] + radius * np.cos(turn), axis[1] - radius * np.sin(turn)
        parcel = box((0.1 * size.width, 0.12 * size.width, tall), (0, 0, tall / 2)).rotate((0, 0, draw.length(0, 90)))
        parts.append(Part("parcel", "misc", parcel.translate((x, y, 0))))
    for k in range(draw.number(0, 2)):
        at = (draw.length(-wide, wide), size.deep + 0.15 * s, 0.06 * s)
        parts.append(Part(f"crumb_{k}", "misc", pebble(at, 0.09 * s, draw.rng)))
    if draw.chance(0.6):
        z, side = draw.length(0.3, 0.8) * size.height, draw.one((-1, 1))
        at = (side * (wide + size.gap + size.jamb + 0.03 * s + HAIRLINE), size.deep / 2, z)
        parts.append(Part("wire", "misc", box((0.06 * s, 0.04 * s, 0.3 * s), at)))
    return parts
