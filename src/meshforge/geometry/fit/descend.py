"""Going down from many starts at once, for functions with creases, such as the volume of a box around points."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from meshforge.geometry.arrays import Floats

_TRIES = 24  # directions tried from each start in a round
_ROUNDS = 120


def descend(objective: Callable[[Floats], Floats], starts: Floats, step: float) -> Floats:
    """The arguments (d,) of the lowest value found from starts (k, d); the same for the same input.

    objective: values (m,) of arguments (m, d). Each round tries fixed scattered directions from every start; a step
    that helps grows, one that does not shrinks.
    """
    scatter = np.random.default_rng(0)
    points, values = starts.copy(), objective(starts)
    steps = np.full(len(points), step)
    each = np.arange(len(points))
    for _ in range(_ROUNDS):
        ways = scatter.normal(size=(_TRIES, points.shape[1]))
        tried = points[:, None] + steps[:, None, None] * ways
        found = objective(tried.reshape(-1, points.shape[1])).reshape(len(points), -1)
        best = np.argmin(found, axis=1)
        better = found[each, best] < values
        points = np.where(better[:, None], tried[each, best], points)
        values = np.where(better, found[each, best], values)
        steps = steps * np.where(better, 1.6, 0.6)
    lowest: Floats = points[int(np.argmin(values))]
    return lowest
