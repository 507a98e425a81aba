"""Sites of tables: the surface of the top, and a way below the top that only rails are in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from benchmark.assets.asset import Site
from benchmark.assets.decomposition import bounds
from meshforge.geometry import Floats
from script.samples.part import Part
from script.samples.solids import block, union

_ALONG_X = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_ALONG_Y = ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
_SPOTS = (0.5, 0.3, 0.7, 0.15, 0.85)
"""Where a way may go, across it, in shares of the width of the table."""
_FREE = 1e-6  # of a way's volume, in parts that it should be free of


def sites_of(parts: Sequence[Part]) -> list[Site]:
    """The sites of a table: `surface`, `under` and `floor`."""
    top = top_of(parts)
    return [_surface(top), *_ways(parts, top)]


def top_of(parts: Sequence[Part]) -> list[Part]:
    """The panels that reach as high as the highest one."""
    panels = [part for part in parts if part.label == "panel"]
    low, high = bounds(panels)
    slack = 0.05 * float(np.linalg.norm(high - low))
    return [part for part in panels if part.solid.bounding_box()[5] >= high[2] - slack]


def _surface(top: Sequence[Part]) -> Site:
    """The middle of the largest board of the top."""
    board = max(top, key=lambda part: float(part.solid.volume()))
    low, high = bounds([board])
    x, y = (low[:2] + high[:2]) / 2
    long, wide = 0.4 * (high[:2] - low[:2])
    return Site(
        "surface", (float(x), float(y), float(high[2])), (float(long), float(wide), 0.1 * float(min(long, wide)))
    )


def _ways(parts: Sequence[Part], top: Sequence[Part]) -> Iterator[Site]:
    """`under`: a way just below the top; `floor`: one near the floor. Where all that is in the way is to be removed."""
    low, high = bounds(parts)
    ceiling = min(float(part.solid.bounding_box()[2]) for part in top)
    for name, labels, levels in (
        ("under", {"rail"}, (ceiling - 0.08 * (ceiling - low[2]), ceiling - 0.01 * (ceiling - low[2]))),
        ("floor", {"rail", "panel"}, (low[2] + 0.1 * (ceiling - low[2]), low[2] + 0.6 * (ceiling - low[2]))),
    ):
        rest = union([part.solid.hull() for part in parts if part.label not in labels or part in top])
        free = [
            (spot, along, room)
            for along in (1, 0)
            for spot in _SPOTS
            for room in [_room(low, high, along, spot, levels)]
            if float((rest ^ block(*room)).volume()) <= _FREE * _volume(room)
        ]
        blocked = union(
            [part.solid for part in parts if part.label in labels and part not in top] or [block((0, 0, 0), (0, 0, 0))]
        )
        free.sort(key=lambda row: float((blocked ^ block(*row[2])).volume()) <= 0)
        if free:
            yield _site(name, free[0][1], free[0][2])


Room = tuple[tuple[float, float, float], tuple[float, float, float]]


def _room(low: Floats, high: Floats, along: int, spot: float, levels: tuple[float, float]) -> Room:
    """The box that a way along an axis sweeps, 0.12 of the table's width wide."""
    across = 1 - along
    middle = low[across] + spot * (high - low)[across]
    half = 0.06 * (high - low)[across]
    a, b = low.copy(), high.copy()
    a[across], b[across] = middle - half, middle + half
    a[2], b[2] = levels
    return (float(a[0]), float(a[1]), float(a[2])), (float(b[0]), float(b[1]), float(b[2]))


def _volume(room: Room) -> float:
    return float(np.prod(np.subtract(room[1], room[0])))


def _site(name: str, along: int, room: Room) -> Site:
    low, high = np.array(room)
    middle, half = (low + high) / 2, (high - low) / 2
    start = middle.copy()
    start[along] = low[along]
    at = (float(start[0]), float(start[1]), float(start[2]))
    size = (float(2 * half[along]), float(half[1 - along]), float(half[2]))
    return Site(name, at, size, _ALONG_Y if along else _ALONG_X)
