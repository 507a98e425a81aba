"""Which sights to draw, such that together they show each hull well."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from meshforge.geometry import Floats
from meshforge.views.camera import View
from meshforge.views.labelling.sights import FIRST, LIKED

_AGAIN = 0.25  # what a second good sight of a hull is worth
_WORTHLESS = 0.05  # a sight that adds less than this a hull is not drawn


def chosen(quality: Mapping[View, Floats], most: int) -> list[View]:
    """At most so many sights, the most telling first; quality: how well each shows each hull (n,), from 0 to 1."""
    taken: list[View] = []
    while len(taken) < min(most, len(quality)):
        before = _value(taken, quality)
        gains = {view: _value([*taken, view], quality) - before for view in quality if view not in taken}
        best = max(gains if taken else FIRST, key=lambda view: gains[view] * LIKED[view])
        if taken and gains[best] <= _WORTHLESS * len(quality[best]):
            break
        taken.append(best)
    return taken


def _value(views: Sequence[View], quality: Mapping[View, Floats]) -> float:
    """What the best two sights of each hull are worth."""
    if not views:
        return 0.0
    ranked = np.sort([quality[view] for view in views], axis=0)[::-1]
    return float(ranked[0].sum() + _AGAIN * ranked[1:2].sum())
