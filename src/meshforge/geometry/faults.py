"""What keeps a shape from being a hull."""

from __future__ import annotations

from typing import Literal

import numpy as np

from meshforge.geometry.convex import spans_volume
from meshforge.geometry.shape import Polytope, Shape
from meshforge.geometry.surface import is_closed, is_convex, is_convex_hull, is_outward

HullFault = Literal["finite", "solid", "flat", "closed", "volume", "convex", "outward"]
_CONVEXITY = 1e-6  # of files: single precision leaves 1e-7


@np.errstate(all="ignore")
def find_fault(shape: Shape, convexity: float = _CONVEXITY) -> HullFault | None:
    """Return what a shape lacks to be a hull, the first of several, from which the others follow; None for a hull.

    finite: coordinates and volume are finite numbers; solid: it has four vertices; flat: it spans no volume; closed:
    its surface is not; volume: it is not positive; convex: it is not; outward: some face looks inwards.
    convexity: how far a vertex may lie outside of a face's plane, relative to the size.
    """
    vertices = shape.vertices
    if not (np.isfinite(vertices).all() and np.isfinite(shape.volume)):
        return "finite"
    if len(vertices) < 4:
        return "solid"
    if not spans_volume(vertices):
        return "flat"
    is_polytope = isinstance(shape, Polytope)
    if is_polytope and shape.volume > 0 and is_convex_hull(vertices, shape.faces, convexity):
        return None  # nearly always, and its planes are made once
    if is_polytope and not is_closed(shape.faces):
        return "closed"
    if shape.volume <= 0:
        return "volume"
    if is_polytope and not is_convex(vertices, shape.faces, convexity):
        return "convex"
    return "outward" if is_polytope and not is_outward(vertices, shape.faces) else None


_WORDS: dict[HullFault, str] = {
    "finite": "has coordinates that are not finite numbers",
    "solid": "has too few vertices for a volume",
    "flat": "has no thickness",
    "closed": "is not closed",
    "volume": "has no positive volume (inside out, or empty)",
    "convex": "is not convex",
    "outward": "has faces that look inwards",
}


def describe_fault(fault: HullFault) -> str:
    """Return the fault as the end of a sentence: `is not convex`."""
    return _WORDS[fault]
