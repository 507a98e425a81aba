"""The views that pictures for labelling choose from, how much of each hull one shows, and which to draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.rendering.camera import Up, View, axes_of
from meshforge.rendering.raycast import neighbour_slices

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


@dataclass(frozen=True, eq=False, slots=True)
class ViewPreview:
    """How much of a small picture shows each hull (n,): in all, and away from the borders of what is seen of it."""

    shares: Floats
    inner: Floats

    @staticmethod
    def of(items: Ints, count: int) -> ViewPreview:
        """Return what pixels (h, w) show of `count` hulls."""
        inner = items >= 0
        for axis in (0, 1):
            for here, there in (neighbour_slices(axis), neighbour_slices(axis)[::-1]):
                inner[here] &= items[here] == items[there]
        return ViewPreview(*(np.bincount(items[mask], minlength=count) / items.size for mask in (items >= 0, inner)))

    def quality(self, least: float) -> Floats:
        """Return how well each hull is seen (n,), from 0 to 1; not at all below a share of `least`."""
        wide, deep = (np.sqrt(np.minimum(part / _WELL, 1)) for part in (self.shares, self.inner))
        return np.where(self.shares >= least, 0.2 + 0.3 * wide + 0.5 * deep, 0.0)


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
