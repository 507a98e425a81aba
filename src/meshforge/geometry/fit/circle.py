"""The smallest circle around points in a plane."""

from __future__ import annotations

import itertools

import numpy as np

from meshforge.geometry.arrays import Floats

_SLACK = 1e-12  # relative; points this far outside are on the circle


def smallest_circle(points: Floats) -> tuple[Floats, float]:
    """Centre (2,) and radius of the smallest circle around points (n, 2); all are inside, the radius sees to it.

    The circle of the few points that bear it grows by the farthest point outside, until there is none.
    """
    bearing = points[:1]
    center, radius = points[0], 0.0
    for _ in range(len(points) + 8):
        reach = np.linalg.norm(points - center, axis=1)
        farthest = int(np.argmax(reach))
        if reach[farthest] <= radius * (1 + _SLACK):
            break
        center, radius, bearing = _around_few(np.concatenate([bearing, points[farthest : farthest + 1]]))
    return center, float(np.linalg.norm(points - center, axis=1).max())


def _around_few(points: Floats) -> tuple[Floats, float, Floats]:
    """The smallest circle around at most four points, with those of them that bear it."""
    best: tuple[float, Floats, Floats] | None = None
    for count in (1, 2, 3):
        for chosen in itertools.combinations(range(len(points)), count):
            some = points[list(chosen)]
            center = _through(some)
            if center is None:
                continue
            radius = float(np.linalg.norm(some - center, axis=1).max())
            inside = bool((np.linalg.norm(points - center, axis=1) <= radius * (1 + _SLACK)).all())
            if inside and (best is None or radius < best[0]):
                best = radius, center, some
    if best is None:  # rounding: nearly collinear points on a circle without end
        center = points.mean(axis=0)
        return center, float(np.linalg.norm(points - center, axis=1).max()), points[:3]
    return best[1], best[0], best[2]


def _through(points: Floats) -> Floats | None:
    """The centre of the circle through one to three points with as few of them across; None where they are in line."""
    if len(points) < 3:
        return np.asarray(points.mean(axis=0))
    a, b = points[1] - points[0], points[2] - points[0]
    twice = 2 * (a[0] * b[1] - a[1] * b[0])
    if abs(twice) <= 1e-14 * float(a @ a + b @ b):
        return None
    aa, bb = float(a @ a), float(b @ b)
    center: Floats = points[0] + np.array([b[1] * aa - a[1] * bb, a[0] * bb - b[0] * aa]) / twice
    return center
