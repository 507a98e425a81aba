"""Sites of cabinets: handles to pull, and ways in where leaves are taken off."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from benchmark.assets.asset import Site
from benchmark.assets.decomposition import bounds
from meshforge.checks.physics.scene import TOLERANCE
from meshforge.geometry import Floats
from script.samples.part import Part
from script.samples.solids import block, union

_CLOSE_X = ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
_CLOSE_Z = ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
"""Fingers come from the front and close along X or Z."""
_LEVEL_WITH = 0.05  # of the diagonal of all handles: the uppermost ones reach up to so much below the highest
_FLAT = 0.1
"""Of half the opening of a gripper: fingers do not hold what stands out by less, such as a button."""
_SPOTS = (0.5, 0.3, 0.7, 0.15, 0.85)
"""Where a way may go through a leaf, up and across, in shares of the leaf."""
_WIDE = 0.1  # of the leaf, a way through it
_DEPTHS = (0.3, 0.1, 0.0)
"""How far a way may go beyond the leaf, in shares of the depth of the body; else to the middle of the leaf."""


def sites_of(parts: Sequence[Part]) -> list[Site]:
    """The sites of a cabinet: `handle`, `top_handle` and `open`."""
    handles = [part for part in parts if part.label == "handle"]
    low, high = bounds(parts)
    near = TOLERANCE * float(np.linalg.norm(high - low))
    grips = [(part, _grip(part, parts, near)) for part in handles]
    grips = [(part, grip) for part, grip in grips if grip.size[0] > _FLAT * grip.size[1]]
    highest = find_highest(handles)
    upper = [replace(grip, name="top_handle") for part, grip in grips if part in highest]
    return [*(grip for _, grip in grips), *upper, *_ways(parts, near)]


def find_highest(handles: Sequence[Part]) -> list[Part]:
    """The handles that reach as high as the highest one."""
    low, high = bounds(handles)
    slack = _LEVEL_WITH * float(np.linalg.norm(high - low))
    return [part for part in handles if part.solid.bounding_box()[5] >= high[2] - slack]


def _grip(handle: Part, parts: Sequence[Part], near: float) -> Site:
    """Where a gripper takes a handle from the front: across the thinner of its sides, as deep as nothing is behind."""
    low, high = bounds([handle])
    wide, _, tall = high - low
    thin, long = min(wide, tall), max(wide, tall)
    opening, half = 0.7 * thin, 0.2 * long
    x, _, z = (low + high) / 2
    aside, up = (1.25 * opening + opening / 4, half) if wide <= tall else (half, 1.25 * opening + opening / 4)
    room = block((x - aside, low[1], z - up), (x + aside, high[1], z + up))
    rest = union([part.solid for part in parts if part is not handle]) ^ room
    ends = [float(part.solid.bounding_box()[1]) for part in parts if part.label == "leaf"]
    ends += [float(high[1])] if rest.is_empty() else [float(rest.bounding_box()[1])]
    end = min([at for at in ends if at > low[1]], default=float(high[1])) - 2 * near
    at = (float(x), float(low[1] + end) / 2, float(z))
    size = (float(end - low[1]) / 2, float(opening), float(half))
    return Site("handle", at, size, _CLOSE_X if wide <= tall else _CLOSE_Z)


def _ways(parts: Sequence[Part], near: float) -> Iterator[Site]:
    """For each leaf a way from the front through it, as deep as nothing but leaves and their handles is in it."""
    low, _ = bounds(parts)
    leaves = [part for part in parts if part.label == "leaf"]
    rest = union([part.solid for part in parts if part not in leaves and not _is_on(part, leaves, near)])
    deep = float(np.ptp(bounds([part for part in parts if part.label == "body"]), axis=0)[1])
    for leaf in leaves:
        thick = float(np.ptp(bounds([leaf]), axis=0)[1])
        ends = [*(deep * depth - near for depth in _DEPTHS), -thick / 2]
        rooms = (_room(leaf, low, beyond, spot) for beyond, *spot in itertools.product(ends, _SPOTS, _SPOTS))
        free = next((room for room in rooms if (rest ^ block(*room)).is_empty()), None)
        if free:
            yield _way(*np.array(free))


def _is_on(part: Part, leaves: Sequence[Part], near: float) -> bool:
    return part.label == "handle" and any(float(part.solid.min_gap(leaf.solid, 2 * near)) <= near for leaf in leaves)


Room = tuple[tuple[float, float, float], tuple[float, float, float]]


def _room(leaf: Part, low: Floats, beyond: float, spot: Sequence[float]) -> Room:
    """The box that a way sweeps, from the front of the cabinet to so far beyond the leaf [m]."""
    least, most = bounds([leaf])
    sides = most - least
    z, x = least[2] + spot[0] * sides[2], least[0] + spot[1] * sides[0]
    half, rise = _WIDE / 2 * sides[0], _WIDE / 2 * sides[2]
    a, b = (x - half, low[1], z - rise), (x + half, most[1] + beyond, z + rise)
    return (float(a[0]), float(a[1]), float(a[2])), (float(b[0]), float(b[1]), float(b[2]))


def _way(low: Floats, high: Floats) -> Site:
    (x, _, z), half = (low + high) / 2, (high - low) / 2
    at = (float(x), float(low[1]), float(z))
    return Site("open", at, (float(2 * half[1]), float(half[0]), float(half[2])), _CLOSE_X)
