"""The distance of convex shapes by another road than the program's: a bracket that closes on the least norm point."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import nnls

from meshforge.geometry import Floats, Shape


class Bracket(NamedTuple):
    """A lower and an upper bound [m] of a distance, and the vector (3,) from one nearest point to the other."""

    below: float
    above: float
    way: Floats


def distance_bracket(a: Shape, b: Shape) -> Bracket:
    """The bracket of the distance from `a` to `b`; its bounds are equal but for rounding in nearly all cases.

    Support points of the difference are gathered one by one (Gilbert); the point of least norm in their hull, by
    non-negative least squares, is the upper bound, the separation along it the lower.
    """
    nearest = b.centroid - a.centroid
    below, above = 0.0, np.inf
    gathered: list[Floats] = []
    for _ in range(200):
        norm = float(np.linalg.norm(nearest))
        unit = nearest / norm if norm > 0 else np.array([1.0, 0.0, 0.0])
        extreme = b.support(-unit) - a.support(unit)
        below = max(below, float(unit @ extreme))
        gathered.append(extreme)
        weights = _least_norm(np.array(gathered))
        gathered = [point for point, weight in zip(gathered, weights, strict=True) if weight > 0]
        nearest = weights[weights > 0] @ np.array(gathered)
        above = min(above, float(np.linalg.norm(nearest)))
        if above - below <= 1e-12:
            break
    return Bracket(below, above, nearest)


def _least_norm(points: Floats) -> Floats:
    """The weights (n,), none negative, together one, of the least norm point in the hull of points (n, 3)."""
    heavy = 1e6 * float(np.abs(points).max())
    system = np.vstack([points.T, np.full(len(points), heavy)])
    weights, _ = nnls(system, np.array([0.0, 0.0, 0.0, heavy]))
    return np.asarray(weights / weights.sum())
