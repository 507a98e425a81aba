"""The smallest ball around points or balls, in the plane (a circle) and in space."""

from __future__ import annotations

import itertools

import numpy as np

from meshforge.geometry.arrays import Floats

_SLACK = 1e-12  # relative; what reaches this far out is on the surface
_EXTRA_ROUNDS = 200  # besides one a point: around balls the search comes ever nearer, without an end


def smallest_ball(centers: Floats, radii: Floats | None = None) -> tuple[Floats, float]:
    """Return centre (d,) and radius of the smallest ball around balls of centres (n, d); d is 2 or 3.

    radii: (n,), 0 where None: the centres are points then. All are inside, the radius sees to it. The ball around the
    few points that bear it grows by the farthest point outside, until there is none.
    """
    own = np.zeros(len(centers)) if radii is None else radii
    largest = int(np.argmax(own))
    bearing, center, radius = centers[[largest]], centers[largest], float(own[largest])
    for _ in range(len(centers) + _EXTRA_ROUNDS):
        reach = np.linalg.norm(centers - center, axis=1) + own
        farthest = int(np.argmax(reach))
        if reach[farthest] <= radius * (1 + _SLACK):
            break
        away = centers[farthest] - center
        length = float(np.linalg.norm(away))
        unit = away / length if length > 0 else np.eye(len(center))[0]
        point = centers[farthest] + own[farthest] * unit
        center, radius, bearing = _ball_around_few(np.concatenate([bearing, point[None]]))
    return center, float((np.linalg.norm(centers - center, axis=1) + own).max())


def _ball_around_few(points: Floats) -> tuple[Floats, float, Floats]:
    """The smallest ball around at most d + 2 points (n, d), with those of them that bear it."""
    best: tuple[Floats, float, Floats] | None = None
    for count in range(1, points.shape[1] + 2):
        for chosen in itertools.combinations(range(len(points)), count):
            some = points[list(chosen)]
            center = _circumcentre(some)
            if center is None:
                continue
            radius = float(np.linalg.norm(some - center, axis=1).max())
            inside = bool((np.linalg.norm(points - center, axis=1) <= radius * (1 + _SLACK)).all())
            if inside and (best is None or radius < best[1]):
                best = center, radius, some
    if best:
        return best
    center = points.mean(axis=0)  # rounding: nearly collinear points on a ball without end
    return center, float(np.linalg.norm(points - center, axis=1).max()), points[: points.shape[1] + 1]


def _circumcentre(points: Floats) -> Floats | None:
    """The centre of the ball through points with as few of them across; None where they are in line or in a plane."""
    if len(points) < 3:
        return np.asarray(points.mean(axis=0))
    sides = points[1:] - points[0]
    offset, _, rank, _ = np.linalg.lstsq(sides, np.square(sides).sum(axis=1) / 2, rcond=1e-14)
    if rank < len(sides):
        return None
    center: Floats = points[0] + offset
    return center
