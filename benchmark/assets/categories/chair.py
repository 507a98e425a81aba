"""Chairs, stools, settees and swivel chairs: feet under every leg, seats of many makes, things left on them."""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, Manifold

from benchmark.assets.asset import Design, Site
from benchmark.assets.categories.chair_legs import GAP, Chair, inset, leg_width, on_casters, on_legs
from benchmark.assets.draw import Draw
from script.samples.part import Part
from script.samples.solids import Point, bar, block, box, pebble, plate, rectangle, revolve, union

LABELS = ("seat", "back", "leg", "arm", "rail", "misc")
KINDS = {"plain": 8, "slatted": 4, "stool": 3, "settee": 3, "swivel": 4, "shelf": 3}
RARE = frozenset({"shelf"})

Spot = tuple[float, float]


def build(kind: str, draw: Draw) -> Design:
    """One chair."""
    chair = _draw_size(kind, draw)
    style, legs, spots = on_casters(chair) if kind == "swivel" else on_legs(chair)
    seat_style, seat = _seat(chair)
    back_style, back = _back(chair)
    rails, low = _rails(chair, style, legs, spots) if kind not in ("stool", "swivel") else ([], 0.0)
    parts = [*seat, back, *legs, *_arms(chair), *rails]
    residue = _residue(chair, back_style, legs)
    about = f"{seat_style} seat, {back_style} back, {style} legs, glued: {chair.glued or 'nothing'}"
    return Design(about, (*parts, *residue), _sites(chair, spots, low))


def _draw_size(kind: str, draw: Draw) -> Chair:
    width = draw.ratio(0.85, 1.1) if kind == "settee" else draw.ratio(0.3, 0.55)
    depth = draw.ratio(0.36, 0.48) if kind == "settee" else width * draw.length(0.85, 1.05)
    tall = 0.42 * draw.ratio(0.9, 1.7) if kind in ("stool", "plain") else 0.42 * draw.ratio(0.85, 1.15)
    top = tall * (0.75 if width < 0.36 else 1.0)
    glued = draw.one(("", "", "", "", "", "back", "legs", "rails"))
    glued = "" if kind == "slatted" else glued
    rounded = kind == "stool" or (kind in ("plain", "swivel") and draw.chance(0.3))
    apron = 0.0 if rounded else draw.length(0.03, 0.05)
    thick, lean, rise = draw.length(0.02, 0.04), draw.length(4, 16), min(width, 0.5) * draw.length(0.7, 1.3)
    return Chair(
        kind, width, depth, top, thick, apron, rise * (0.5 if kind == "stool" else 1), lean, glued, rounded, draw
    )


def _seat(chair: Chair) -> tuple[str, list[Part]]:
    styles = ("dished", "slab", "woven") if not chair.round else ("dished", "dished", "slab")
    style = "planks" if chair.kind == "slatted" else chair.draw.one(styles)
    w, d, top, thick = chair.width, chair.depth, chair.top, chair.thick
    solids: list[Manifold]
    if style == "planks":
        solids = _planks(chair)
    elif style == "woven":
        solids = [_woven(chair)]
    else:
        outline = CrossSection.circle(0.5, 20).scale((w, d)) if chair.round else rectangle(w, d, 0.03, 8)
        solid = plate(outline, top, thick)
        if style == "dished":
            sink = min(0.016, 0.55 * thick)
            hollow = Manifold.sphere(1.0, 20).scale((0.43 * w, 0.43 * d, sink)).translate((0, 0, top))
            solid -= hollow
        solids = [solid]
    parts = [Part(f"seat_{k}", "seat", solid) for k, solid in enumerate(solids)]
    if chair.kind == "shelf":
        parts.append(Part("shelf", "seat", _shelf(chair)))
    return style, parts


def _planks(chair: Chair) -> list[Manifold]:
    """Loose boards from side to side or from front to back."""
    count, across = chair.draw.number(3, 7), chair.kind != "settee"
    length, pitch = (chair.width, chair.depth / count) if across else (chair.depth, chair.width / count)
    breadth, z = pitch * chair.draw.length(0.6, 0.85), chair.top - chair.thick / 2
    boards = [box((length, breadth, chair.thick), (0, (k - (count - 1) / 2) * pitch, z)) for k in range(count)]
    edge = chair.depth / 2 - breadth / 2 - (count - 1) / 2 * pitch
    wide = [board.translate((0, edge * (k * 2 / (count - 1) - 1), 0)) for k, board in enumerate(boards)]
    return wide if across else [board.rotate((0, 0, 90)) for board in wide]


def _woven(chair: Chair) -> Manifold:
    """A frame with straps across, which hang a little lower."""
    w, d, top, thick = chair.width, chair.depth, chair.top, chair.thick
    rim, low, high = 0.14 * min(w, d), top - 0.7 * thick, top - 0.3 * thick
    x, y, z = (w - rim) / 2, (d - rim) / 2, top - thick / 2
    frame = [box((rim, d, thick), (s * x, 0, z)) for s in (-1, 1)]
    frame += [box((w - 2 * rim - 2 * GAP, rim, thick), (0, s * y, z)) for s in (-1, 1)]
    count = chair.draw.number(3, 6)
    pitch, end = (w - 2 * rim) / count, d / 2 - rim - GAP
    half = pitch * chair.draw.length(0.2, 0.4)
    rows = [(k - (count - 1) / 2) * pitch for k in range(count)]
    return union([*frame, *(block((x - half, -end, low), (x + half, end, high)) for x in rows)])


def _shelf(chair: Chair) -> Manifold:
    """A second board between the legs, as wide as they leave room."""
    edge = inset(chair)
    z = chair.top * chair.draw.length(0.26, 0.38)
    room = chair.width / 2 - edge - leg_width(chair) / 2 - GAP
    return box((2 * room, chair.depth - edge, 0.7 * chair.thick), (0, 0, z))


def _rails(chair: Chair, style: str, legs: list[Part], spots: list[Spot]) -> tuple[list[Part], float]:
    """Rails under the seat, stretchers between straight legs; and up to what height these are in the way."""
    parts: list[Part] = []
    gap, top = chair.joint("rails"), chair.under - GAP
    corners = {(s > 0): leg for leg, (s, t) in zip(legs, spots, strict=True) if t < 0 and abs(s) == max(spots)[0]}
    if chair.round:
        return parts, 0.0
    for right, leg in corners.items():
        end, x = _face(leg, top - chair.apron, top) + gap, max(spots)[0] * (1 if right else -1)
        half = 0.3 * leg_width(chair)
        solid = block((x - half, end, top - chair.apron), (x + half, -end, top))
        parts.append(Part(f"apron_{right:d}", "rail", solid))
    if chair.kind == "shelf":
        return parts, chair.top * 0.38 + 0.7 * chair.thick
    if not {"square", "lathe"} & set(style.split()) or chair.draw.chance(0.4):
        return parts, 0.0
    z, r = chair.top * chair.draw.length(0.35, 0.5), 0.2 * leg_width(chair)
    for right, leg in corners.items():
        end, x = _face(leg, z - r, z + r) + gap, max(spots)[0] * (1 if right else -1)
        parts.append(Part(f"stretcher_{right:d}", "rail", bar((x, end, z), (x, -end, z), 2 * r, 8)))
    half = max(spots)[0] - r - GAP
    parts.append(Part("stretcher_2", "rail", bar((-half, 0, z), (half, 0, z), 1.8 * r, 8)))
    return parts, z + 1.5 * r


def _face(leg: Part, low: float, high: float) -> float:
    """How far a front leg reaches towards the middle between two heights."""
    slab = leg.solid.trim_by_plane((0, 0, 1), low).trim_by_plane((0, 0, -1), -high)
    return float(slab.bounding_box()[4])


def _back(chair: Chair) -> tuple[str, Part]:
    """A back that stands on the rear of the seat and leans."""
    draw = chair.draw
    bent = () if chair.kind == "settee" else ("curved",)
    style = draw.one(("panel", "slats", "ladder", "splat", *bent))
    w = chair.width * (0.6 if chair.round else 0.94)
    h, t = chair.rise, 0.055 * min(chair.width, 0.5)
    post = 1.3 * t
    posts = [block((x - post / 2, -t / 2, 0), (x + post / 2, t / 2, h)) for x in (post / 2 - w / 2, w / 2 - post / 2)]
    head = block((-w / 2, -t / 2, 0.86 * h), (w / 2, t / 2, h))
    if style == "panel":
        solid = plate(rectangle(w, t), h, h) - box((0.3 * w, 1, 0.1 * h), (0, 0, 0.8 * h))
    elif style == "curved":
        solid = _bend(w, t, h)
    elif style == "slats":
        n = draw.number(2, 6)
        slats = [box((0.4 * w / n, 0.7 * t, h), ((k - (n - 1) / 2) * w / (n + 0.6), 0, h / 2)) for k in range(n)]
        solid = union([*posts, head, *(slat.trim_by_plane((0, 0, -1), -0.9 * h) for slat in slats)])
    elif style == "ladder":
        n = draw.number(1, 4)
        rungs = [box((w, 0.7 * t, 0.5 * h / (n + 1)), (0, 0, (k + 0.8) * 0.86 * h / (n + 0.5))) for k in range(n)]
        solid = union([*posts, head, *rungs])
    else:
        outline = [(-0.1 * w, 0.0), (0.1 * w, 0.0), (0.2 * w, 0.5 * h), (0.12 * w, 0.9 * h)]
        points = np.array([*outline, *((-x, z) for x, z in reversed(outline[2:]))])
        splat = CrossSection([points]).extrude(0.6 * t).rotate((90, 0, 0)).translate((0, 0.3 * t, 0))
        solid = union([*posts, head, splat])
    return style, Part("back", "back", _lean(chair, solid))


def _bend(w: float, t: float, h: float) -> Manifold:
    """A panel that bends round whoever sits there."""
    turn, r = np.linspace(-0.3, 0.3, 6), w / 2 / np.sin(0.3)
    inner, outer = (np.stack([k * np.sin(turn), k * np.cos(turn) - r], axis=1) for k in (r - t, r))
    return CrossSection([np.concatenate([inner, outer[::-1]])]).extrude(h).translate((0, t / 2, 0))


def _lean(chair: Chair, solid: Manifold) -> Manifold:
    """What was built upright about x = y = 0 as part of the back, on the rear of the seat, leaning."""
    t = 0.055 * min(chair.width, 0.5)
    y = chair.depth / 2 * (0.8 if chair.round else 1.0) - 0.7 * t
    dip = t / 2 * float(np.sin(np.radians(chair.lean)))
    return solid.rotate((-chair.lean, 0, 0)).translate((0, y, chair.top + chair.joint("back") + dip))


def _arms(chair: Chair) -> list[Part]:
    """An arm rest on either side, on a post in front."""
    if chair.kind in ("stool", "shelf") or chair.round or chair.draw.chance(0.5):
        return []
    t, z = 0.06 * min(chair.width, 0.5), chair.top + 0.42 * chair.width / (2 if chair.kind == "settee" else 1)
    x, front, rear = chair.width / 2 - t / 2, -0.35 * chair.depth, 0.35 * chair.depth
    arm = block((-t / 2, front, chair.top + GAP), (t / 2, front + t, z)) + block((-t, front - t, z - t), (t, rear, z))
    return [Part(f"arm_{k}", "arm", arm.translate((s * x, 0, 0))) for k, s in enumerate((-1, 1))]


def _residue(chair: Chair, back: str, legs: list[Part]) -> list[Part]:
    """What lies on the seat, hangs over the back, and lies about the legs."""
    draw, parts, size = chair.draw, [], min(chair.width, 0.5)
    x, y = (chair.width - size) / 2 * draw.length(-1, 1), -0.02
    left = draw.one(("book", "book", "mug", "cushion", "lumps", "nothing"))
    if left == "book":
        solid = Manifold.cube((0.4 * size, 0.3 * size, 0.06 * size), True).rotate((0, 0, draw.length(0, 360)))
        parts.append(Part("book", "misc", solid.translate((x, y, chair.top + 0.03 * size + GAP))))
    elif left == "mug":
        ear = block((0.03, -0.006, 0.03), (0.065, 0.006, 0.075))
        solid = revolve([(0.037, 0), (0.04, 0.095)], 12) + ear
        parts.append(Part("mug", "misc", solid.rotate((0, 0, draw.length(0, 360))).translate((x, y, chair.top + GAP))))
    elif left == "cushion":
        lump = Manifold.sphere(1.0, 12).scale((0.32 * size, 0.3 * size, 0.08 * size))
        parts.append(Part("cushion", "misc", lump.translate((x, y, chair.top + 0.08 * size + GAP))))
    elif left == "lumps":
        for k in range(draw.number(2, 4)):
            at = (x + draw.length(-0.2, 0.2) * size, y + draw.length(-0.2, 0.2) * size, chair.top + 0.05 * size)
            parts.append(Part(f"lump_{k}", "misc", pebble(at, 0.09 * size, draw.rng)))
    if back != "curved" and draw.chance(0.4):
        parts.append(_jacket(chair))
    if draw.chance(0.4):
        parts.append(_cable(chair, legs))
    return parts


def _cable(chair: Chair, legs: list[Part]) -> Part:
    """A cable on the floor, against the legs in front or behind."""
    boxes = np.array([leg.solid.bounding_box() for leg in legs])
    side = chair.draw.one((-1, 1))
    y = side * (max(side * boxes[:, 1 if side < 0 else 4]) + 0.007 + GAP)
    x = 0.6 * chair.width
    ends: list[Point] = [(-x, y, 0.007), (0.2 * x, y, 0.007), (x, y + side * 0.1, 0.007)]
    return Part("cable", "misc", bar(ends[0], ends[1], 0.014, 6) + bar(ends[1], ends[2], 0.014, 6))


def _jacket(chair: Chair) -> Part:
    """Something that hangs behind the back."""
    w, h, t = 0.4 * chair.width, chair.rise, 0.055 * min(chair.width, 0.5)
    x = chair.draw.length(-0.2, 0.2) * w
    hung = block((x - w / 2, t / 2 + GAP, 0.3 * h), (x + w / 2, t / 2 + 0.04, 1.02 * h))
    return Part("jacket", "misc", _lean(chair, hung))


def _sites(chair: Chair, spots: list[Spot], low: float) -> tuple[Site, ...]:
    """The seat; and where feet go under it, between the legs."""
    small = min(chair.width, chair.depth)
    sites = [Site("seat", (0, 0, chair.top), (0.31 * chair.width, 0.31 * chair.depth, 0.06 * small))]
    if chair.kind not in ("stool", "swivel"):
        columns = sorted({x for x, _ in spots})
        x0, x1 = columns[len(columns) // 2 - 1], columns[len(columns) // 2]
        high = chair.under - chair.apron
        z, half = (low + high) / 2, 0.3 * (high - low)
        wide = 0.5 * ((x1 - x0) / 2 - leg_width(chair) / 2)
        axes: tuple[Point, Point, Point] = ((0, 1, 0), (-1, 0, 0), (0, 0, 1))
        at = ((x0 + x1) / 2, -chair.depth / 2 - 0.05, z)
        sites.append(Site("under", at, (chair.depth + 0.1, wide, half), axes))
    return tuple(sites)
