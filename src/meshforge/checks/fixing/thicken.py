"""Thin hulls made thick enough."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Enclosure, Polytope, convex_hull, principal_extents

_MARGIN = 1e-6  # beyond the thickness that is asked for, against rounding


def thickened(hull: Polytope, thickness: float) -> Enclosure:
    """The hull swept along its thinnest principal axis, to both sides alike, until it is `thickness` [m] thick.

    It holds the hull it was, and sticks out by the step to each side at most; one that is thick enough stays as it is.
    """
    _, axes, extents = principal_extents(hull.vertices)
    lacking = thickness * (1 + _MARGIN) - float(extents[2])
    if lacking <= 0:
        return Enclosure(hull, 0.0)
    step = axes[2] * (lacking / 2)
    made = convex_hull(np.concatenate([hull.vertices - step, hull.vertices + step]), name="a thickened hull")
    return Enclosure(made, lacking / 2)
