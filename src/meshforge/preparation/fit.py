"""How well the hulls of a decomposition fit what they were made of, in a few words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshforge.asset import Surface
from meshforge.geometry import Floats, Polytope, volume_of_union
from meshforge.geometry.decompose import enclosed_volume
from meshforge.words import counted

_NEAR = 0.01  # of the diagonal: surface farther outside of all hulls than this is not covered
_POINTS = 4000
_SKIN = 0.01  # a surface that encloses less of its hulls is a sheet with two sides, which has no volume to speak of
_LEAST = 0.005  # shares below are told as none


def told_fit(surface: Surface, hulls: Sequence[Polytope], *, solid: bool) -> str:
    """`12 hulls, 3% more volume, 2% of the surface outside`; solid: whether what the surface encloses is its volume.

    An open surface encloses nothing, and parts that overlap, as those to look at may, enclose some of it twice.
    """
    parts = [counted(len(hulls), "hull")]
    volume, own = volume_of_union(hulls), enclosed_volume(surface.vertices, surface.faces) if solid else None
    if own and own > _SKIN * volume:
        excess = volume / own - 1
        parts.append("the same volume" if abs(excess) < _LEAST else f"{abs(excess):.0%} {_word(excess)} volume")
    bare = uncovered(surface, hulls)
    parts += [f"{bare:.0%} of the surface outside"] if bare >= _LEAST else []
    return ", ".join(parts)


def _word(excess: float) -> str:
    return "more" if excess > 0 else "less"


def uncovered(surface: Surface, hulls: Sequence[Polytope]) -> float:
    """The share of a surface's area that is farther outside of all hulls than 1% of its diagonal."""
    points = _spread(surface)
    reach = _NEAR * float(np.linalg.norm(np.ptp(points, axis=0)))
    outside = np.ones(len(points), dtype=bool)
    for hull in hulls:
        outside[outside] = _height(points[outside], hull) > reach
    return float(outside.mean())


def _height(points: Floats, hull: Polytope) -> Floats:
    """How far (n,) [m] points (n, 3) are above the face of a hull that they are highest above."""
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    normals, a = normals[lengths > 0] / lengths[lengths > 0, None], a[lengths > 0]
    heights: Floats = (points @ normals.T - np.einsum("ij,ij->i", normals, a)).max(axis=1, initial=-np.inf)
    return heights


def _spread(surface: Surface) -> Floats:
    """Points (n, 3) that lie evenly on a surface, the same every time."""
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(0)
    if not areas.sum() > 0:
        return a
    chosen = np.searchsorted(np.cumsum(areas) / areas.sum(), (np.arange(_POINTS) + 0.5) / _POINTS)
    chosen = np.minimum(chosen, len(areas) - 1)
    u, v = random.random((2, _POINTS, 1))
    folded = u + v > 1
    u, v = np.where(folded, 1 - u, u), np.where(folded, 1 - v, v)
    points: Floats = a[chosen] + u * (b[chosen] - a[chosen]) + v * (c[chosen] - a[chosen])
    return points
