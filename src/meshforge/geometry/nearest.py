"""The nearest points of triangles."""

from __future__ import annotations

import numpy as np

from meshforge.geometry.arrays import Floats

_TINY = 1e-300


def nearest_on_triangles(points: Floats, corners: Floats) -> Floats:
    """The point (n, 3) of each triangle, corners (n, 3, 3), that is nearest to a point (n, 3) each.

    Triangles may be needles or points.
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac, ap = b - a, c - a, points - a
    d1, d2, d3 = _dot(ab, ab), _dot(ab, ac), _dot(ac, ac)
    e1, e2 = _dot(ab, ap), _dot(ac, ap)
    area = d1 * d3 - d2 * d2
    safe = np.where(area > _TINY, area, 1.0)
    v, w = (d3 * e1 - d2 * e2) / safe, (d1 * e2 - d2 * e1) / safe
    inside = (area > _TINY) & (v >= 0) & (w >= 0) & (v + w <= 1)
    found = a + v[:, None] * ab + w[:, None] * ac
    if not inside.all():
        out = np.flatnonzero(~inside)
        found[out] = _on_edges(points[out], corners[out])
    return found


def _on_edges(points: Floats, corners: Floats) -> Floats:
    """The same for the outlines of the triangles."""
    start, along = corners, corners[:, [1, 2, 0]] - corners
    ahead = np.einsum("ikj,ikj->ik", points[:, None] - start, along)
    length = np.einsum("ikj,ikj->ik", along, along)
    share = np.clip(ahead / np.maximum(length, _TINY), 0.0, 1.0)
    places = start + share[..., None] * along
    gaps = np.einsum("ikj,ikj->ik", places - points[:, None], places - points[:, None])
    best: Floats = places[np.arange(len(points)), gaps.argmin(axis=1)]
    return best


def _dot(a: Floats, b: Floats) -> Floats:
    out: Floats = np.einsum("ij,ij->i", a, b)
    return out
