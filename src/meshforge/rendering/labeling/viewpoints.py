"""The views that pictures for labelling choose from, how well each shows a hull, and which to draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from meshforge.geometry import Floats
from meshforge.rendering.camera import Up, View, axes_of

VIEW_WORDS: Mapping[View, str] = {
    "front-right-above": "from the front right, above",
    "front-left-above": "from the front left, above",
    "front": "front",
    "back-left-above": "from the back left, above",
    "back-right-above": "from the back right, above",
    "top": "top",
    "right": "right",
    "left": "left",
    "back": "back",
    "bottom": "bottom",
    "front-left-below": "from the front left, below",
    "front-right-below": "from the front right, below",
    "back-left-below": "from the back left, below",
    "back-right-below": "from the back right, below",
}
"""What each view is called; those that people know things best by come first."""
VIEW_PREFERENCES: Mapping[View, float] = {view: 1.0 - 0.015 * k for k, view in enumerate(VIEW_WORDS)}
"""How much each view is liked: one from below must show clearly more to be preferred."""
FIRST_VIEWS: tuple[View, ...] = ("front-right-above", "front-left-above", "back-left-above", "back-right-above")
"""The views that tell best what a thing is, one of which is always drawn."""
_WELL = 1 / 250  # the share of a picture from which on a hull is seen as well as it needs to be

_AGAIN = 0.25  # what a second good view of a hull is worth
_WORTHLESS = 0.05  # a view that adds less than this a hull is not drawn


def outermost_points(points: Floats, up: Up) -> Floats:
    """Return those of points (n, 3) that are the outermost in a picture from some view."""
    along = np.concatenate([axes_of(view, up)[:2] for view in VIEW_WORDS]) @ points.T
    kept: Floats = points[np.unique(np.concatenate([along.argmin(axis=1), along.argmax(axis=1)]))]
    return kept


def measure_quality(shares: Floats, least: float) -> Floats:
    """Return how well each hull is seen (n,), from 0 to 1, by its share of a picture; not at all below `least`."""
    return np.where(shares >= least, 0.2 + 0.8 * np.sqrt(np.minimum(shares / _WELL, 1)), 0.0)


def choose_views(quality: Mapping[View, Floats], most: int) -> list[View]:
    """Return at most so many views, the most telling first; quality: how well each shows each hull (n,), from 0 to
    1."""
    taken: list[View] = []
    while len(taken) < min(most, len(quality)):
        before = _value_of(taken, quality)
        gains = {view: _value_of([*taken, view], quality) - before for view in quality if view not in taken}
        best = max(gains if taken else FIRST_VIEWS, key=lambda view: gains[view] * VIEW_PREFERENCES[view])
        if taken and gains[best] <= _WORTHLESS * len(quality[best]):
            break
        taken.append(best)
    return taken


def _value_of(views: Sequence[View], quality: Mapping[View, Floats]) -> float:
    if not views:
        return 0.0
    ranked = np.sort([quality[view] for view in views], axis=0)[::-1]
    return float(ranked[0].sum() + _AGAIN * ranked[1:2].sum())
