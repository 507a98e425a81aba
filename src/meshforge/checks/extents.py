"""How long, wide and thick a hull is."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats, principal_extents


def extents(points: Floats) -> Floats:
    """The sides (3,) of a small box around points (n, 3), longest first [m].

    Of the boxes that are square to a principal axis, the smallest: where extents along other principal axes are alike,
    these axes are chance, and the box is turned about the first as it fits best.
    """
    middle, axes, _ = principal_extents(points)
    local = (points - middle) @ axes.T
    found = [_boxed(local, k) for k in range(3)]
    best: Floats = np.sort(min(found, key=lambda sides: float(np.prod(sides))))[::-1]
    return best


def _boxed(local: Floats, axis: int) -> Floats:
    """The sides (3,) of the smallest box that is square to one axis: it lies along an edge of the outline."""
    from scipy.spatial import ConvexHull, QhullError

    flat = np.delete(local, axis, axis=1)
    size = np.maximum(np.ptp(flat, axis=0), np.finfo(float).tiny)
    try:
        ring = flat[ConvexHull(flat / size).vertices]
    except QhullError:  # no outline: the points span no volume
        return np.asarray(np.ptp(local, axis=0))
    edges = np.roll(ring, -1, axis=0) - ring
    along = edges / np.maximum(np.linalg.norm(edges, axis=1, keepdims=True), np.finfo(float).tiny)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    sides = np.stack([np.ptp(ring @ along.T, axis=0), np.ptp(ring @ across.T, axis=0)], axis=1)
    best = sides[sides.prod(axis=1).argmin()]
    return np.array([float(np.ptp(local[:, axis])), *best])
