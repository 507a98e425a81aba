"""Sites of chairs: the seat, a way over it that only arms are in, and one below it that only rails are in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from benchmark.assets.asset import Site
from benchmark.assets.decomposition import bounds
from meshforge.geometry import Floats
from script.samples.part import Part
from script.samples.solids import block, union

_ALONG = (
    ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
)
_SPOTS = (0.5, 0.4, 0.6, 0.3, 0.7)
"""Where a way may go, across it, in shares of the width of the chair."""
_FREE = 1e-6  # of a way's volume, in parts that it should be free of


def sites_of(parts: Sequence[Part]) -> list[Site]:
    """The sites of a chair: `seat`, `over`, and `under` where there is room between legs."""
    low, high = _room_to_sit(parts)
    return [_seat(low, high), _over(parts, low, high), *_under(parts)]


def _room_to_sit(parts: Sequence[Part]) -> tuple[Floats, Floats]:
    """What of the seat's box is before the back and between the arms."""
    low, high = bounds([part for part in parts if part.label == "seat"])
    for part in parts:
        box = np.asarray(part.solid.bounding_box())
        if part.label == "back":
            high[1] = min(high[1], max(box[1], (low[1] + high[1]) / 2))
        if part.label == "arm" and box[3] < 0:
            low[0] = max(low[0], box[3])
        if part.label == "arm" and box[0] > 0:
            high[0] = min(high[0], box[0])
    return low, high


def _seat(low: Floats, high: Floats) -> Site:
    """The middle of where one sits, at the height of the seat."""
    x, y = (low[:2] + high[:2]) / 2
    long, wide = 0.35 * (high[:2] - low[:2])
    return Site("seat", (float(x), float(y), float(high[2])), (float(long), float(wide), 0.1 * float(min(long, wide))))


def _over(parts: Sequence[Part], low: Floats, high: Floats) -> Site:
    """A way over the seat, from one side of the chair to the other."""
    left, right = bounds(parts)
    tall = float(right[2] - left[2])
    depth = high[1] - low[1]
    a = np.array([left[0], low[1] + 0.3 * depth, high[2] + 0.02 * tall])
    b = np.array([right[0], low[1] + 0.7 * depth, high[2] + 0.08 * tall])
    return _site("over", 0, a, b)


def _under(parts: Sequence[Part]) -> Iterator[Site]:
    """A way below the seat that is free but for rails; of several one with rails in it."""
    low, high = bounds(parts)
    ceiling = bounds([part for part in parts if part.label == "seat"])[0][2]
    rest = union([part.solid for part in parts if part.label != "rail"])
    rails = [part.solid for part in parts if part.label == "rail"]
    found = []
    for along in (0, 1):
        for spot in _SPOTS:
            a, b = low.copy(), high.copy()
            middle = low[1 - along] + spot * (high - low)[1 - along]
            half = 0.06 * (high - low)[1 - along]
            a[1 - along], b[1 - along] = middle - half, middle + half
            a[2], b[2] = low[2] + 0.1 * (ceiling - low[2]), low[2] + 0.75 * (ceiling - low[2])
            way = block(tuple(a.tolist()), tuple(b.tolist()))
            if float((rest ^ way).volume()) <= _FREE * float(way.volume()):
                found.append((sum(float((rail ^ way).volume()) > 0 for rail in rails), along, a, b))
    if found:
        _, along, a, b = max(found, key=lambda row: row[0])
        yield _site("under", along, a, b)


def _site(name: str, along: int, low: Floats, high: Floats) -> Site:
    """A way through a box (two corners), along an axis."""
    middle, half = (low + high) / 2, (high - low) / 2
    start = middle.copy()
    start[along] = low[along]
    at = (float(start[0]), float(start[1]), float(start[2]))
    return Site(name, at, (float(2 * half[along]), float(half[1 - along]), float(half[2])), _ALONG[along])
