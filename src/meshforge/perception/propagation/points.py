"""Points in and on hulls, the same for the same hull: no chance is in them."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats
from meshforge.perception.propagation.ties import EQUAL, first_greatest

_PLASTIC = np.array([0.7548776662466927, 0.5698402909980532])
"""Steps of the two-dimensional sequence that fills a square most evenly (Roberts 2018)."""
_FAVOUR = 1e-3  # of the square of a hull's size, by which a vertex may be nearer and still come first
_ASIDE = 0.5  # what being far from the upright axis is worth beside being high


def inside(vertices: Floats, axis: Floats, count: int) -> Floats:
    """Points (count, 3) within a hull: its middle, and halfway from there to vertices far from each other.

    Of vertices that are equally far those come first that are high and far from an upright axis, which stands at
    `axis` (2,): a hull has the same points however it is turned about Z, unless it is its own mirror image.
    """
    middle = vertices.mean(axis=0)
    offsets = vertices - middle
    reach = (offsets**2).sum(axis=1)
    size = float(reach.max()) or 1.0
    favour = _FAVOUR * np.sqrt(size) * (offsets[:, 2] + _ASIDE * np.linalg.norm(vertices[:, :2] - axis, axis=1))
    chosen = [int(first_greatest(reach + favour, EQUAL * size))]
    gap = ((offsets - offsets[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < count - 1:
        chosen.append(int(first_greatest(gap + favour, EQUAL * size)))
        gap = np.minimum(gap, ((offsets - offsets[chosen[-1]]) ** 2).sum(axis=1))
    points: Floats = middle + np.concatenate([np.zeros((1, 3)), offsets[chosen] / 2])[:count]
    return points


def on_surface(triangles: Floats, count: int) -> Floats:
    """Points (count, 3) spread evenly over triangles (n, 3, 3)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    ends = np.cumsum(areas)
    at = np.searchsorted(ends, ((np.arange(count) + 0.5) / count - EQUAL) * ends[-1])
    face = np.minimum(at, len(triangles) - 1)
    share = (0.5 + np.arange(1, count + 1)[:, None] * _PLASTIC) % 1.0
    over = share.sum(axis=1) > 1.0
    share[over] = 1.0 - share[over]
    points: Floats = a[face] + share[:, :1] * (b - a)[face] + share[:, 1:] * (c - a)[face]
    return points
