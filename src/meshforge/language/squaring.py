"""The turn about an axis that squares an asset up: the one with the smallest bounding rectangle of the footprint."""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull

from meshforge.geometry import Floats

SQUARE_ENOUGH = 1.05
"""The frame as it came is kept when its rectangle is at most this many times the smallest."""
_EQUAL = 1e-9  # areas and angles that differ by less are equal


def squaring_turn(footprint: Floats) -> float:
    """The angle [rad], at most an eighth of a turn, that squares up points (n, 2) which span an area.

    Of the four quarter turns that do, it is the one nearest to the incoming frame (of two, the positive one).
    A smallest rectangle has a side along an edge of the convex hull, so the edges are all that is tried.
    """
    outline = footprint[ConvexHull(footprint).vertices]
    edges = np.roll(outline, -1, axis=0) - outline
    turns = _folded(-np.arctan2(edges[:, 1], edges[:, 0]))
    areas = np.array([_area(outline, turn) for turn in turns])
    smallest = float(areas.min())
    if _area(outline, 0.0) <= smallest * SQUARE_ENOUGH:
        return 0.0
    tied = [float(turn) for turn in turns[areas <= smallest * (1 + _EQUAL)]]
    nearest = min(abs(turn) for turn in tied)
    return max(turn for turn in tied if abs(turn) <= nearest + _EQUAL)


def _folded(angles: Floats) -> Floats:
    """The angles up to quarter turns, in (-pi/4, pi/4]; what is -pi/4 but for rounding counts as pi/4."""
    quarter = np.pi / 2
    low = -quarter / 2 + _EQUAL
    folded: Floats = (angles - low) % quarter + low
    return folded


def _area(outline: Floats, turn: float) -> float:
    cosine, sine = np.cos(turn), np.sin(turn)
    turned = outline @ np.array([[cosine, sine], [-sine, cosine]])
    return float(np.prod(np.ptp(turned, axis=0)))
