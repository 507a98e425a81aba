"""Thin hulls made thick enough."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Polytope, convex_hull, principal_extents

_MARGIN = 1e-6  # beyond the thickness that is asked for, against rounding


def thickened(hull: Polytope, thickness: float) -> Polytope:
    """The hull swept along its thinnest principal axis, to both sides alike, until it is `thickness` [m] thick.

    It holds the hull it was; one that is thick enough stays the same object.
    """
    _, axes, extents = principal_extents(hull.vertices)
    lacking = thickness * (1 + _MARGIN) - float(extents[2])
    if lacking <= 0:
        return hull
    step = axes[2] * (lacking / 2)
    return convex_hull(np.concatenate([hull.vertices - step, hull.vertices + step]), name="a thickened hull")
