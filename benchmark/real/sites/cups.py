"""Sites of cups: the mouth, the room inside, the way in from above, and ears to take them by."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from manifold3d import Manifold

from benchmark.assets.asset import Site
from benchmark.assets.decomposition import bounds
from meshforge.checks.physics.scene import TOLERANCE
from meshforge.geometry import Floats
from script.samples.part import Part
from script.samples.solids import Point, block, union

_WIDE = 0.5  # of half the width of the wall, the radius of what is put in
_LOW, _HIGH = 0.08, 0.6
"""Where it stands, in shares of the height of the wall."""
_DOWN = ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
_OPEN, _HALF = 0.7, 0.2
"""Half the opening of a gripper, of the thickness of an ear, and half the height of its fingers, of the ear's."""


def sites_of(parts: Sequence[Part]) -> list[Site]:
    """The sites of a cup: `mouth` where nothing covers it, `room`, `way` and an `ear` each."""
    low, high = bounds([part for part in parts if part.label == "wall"])
    x, y = (float(value) for value in (low[:2] + high[:2]) / 2)
    wide, tall = float(min(high[:2] - low[:2])) / 2, float(high[2] - low[2])
    foot, rim = float(low[2]) + _LOW * tall, float(low[2]) + _HIGH * tall
    sites = [Site("room", (x, y, (foot + rim) / 2), (_WIDE * wide, _WIDE * wide, (rim - foot) / 2))]
    top = float(bounds(parts)[1][2])
    sites.append(Site("way", (x, y, top + 0.2 * tall), (top + 0.2 * tall - rim, 0.4 * wide, 0.4 * wide), _DOWN))
    if not any(part.label == "lid" for part in parts):
        sites.append(Site("mouth", (x, y, float(high[2])), (0.6 * wide, 0.6 * wide, 0.25 * wide)))
    return [*sites, *_ears(parts, np.array([x, y, 0.0]))]


def _ears(parts: Sequence[Part], axis: Floats) -> Iterator[Site]:
    """For each ear a gripper that comes from outside, across the ear, as deep as nothing is behind it."""
    least, most = bounds(parts)
    near = TOLERANCE * float(np.linalg.norm(most - least))
    for ear in parts:
        if ear.label == "handle" and not _is_on_top(ear, parts):
            yield _take(ear, [part for part in parts if part is not ear], axis, near)


def _is_on_top(handle: Part, parts: Sequence[Part]) -> bool:
    """Whether a handle is the knob of a lid."""
    lids = [part for part in parts if part.label == "lid"]
    return bool(lids) and float(handle.solid.bounding_box()[2]) > float(bounds(lids)[0][2])


def _take(ear: Part, others: Sequence[Part], axis: Floats, near: float) -> Site:
    low, high = bounds([ear])
    middle, sides = (low + high) / 2, high - low
    along = int(np.argmax(np.abs((middle - axis)[:2])))
    side, across = float(np.sign((middle - axis)[along])), 1 - along
    opening, half = _OPEN * float(sides[across]), _HALF * float(sides[2])
    reach = np.array([0.0, 0.0, half])
    reach[along], reach[across] = sides[along] / 2, 1.5 * opening
    room = union([part.solid for part in others]) ^ _block(middle - reach, middle + reach)
    ends = (float(high[along]), float(low[along]))
    if not room.is_empty():
        box = room.bounding_box()
        ends = (min(ends[0], float(box[along])), max(ends[1], float(box[along + 3])))
    wall = bounds([part for part in others if part.label == "wall"])
    ends = (min(ends[0], float(wall[0][along])), max(ends[1], float(wall[1][along])))
    outer, inner = (float(high[along]), ends[1]) if side > 0 else (float(low[along]), ends[0])
    inner += side * 2 * near
    at, inward = middle.copy(), np.zeros(3)
    at[along], inward[along] = (outer + inner) / 2, -side
    axes = (_point(inward), _point(np.cross([0.0, 0.0, 1.0], inward)), (0.0, 0.0, 1.0))
    return Site("ear", _point(at), (abs(outer - inner) / 2, opening, half), axes)


def _point(values: Floats) -> Point:
    return (float(values[0]), float(values[1]), float(values[2]))


def _block(low: Floats, high: Floats) -> Manifold:
    return block(_point(low), _point(high))
