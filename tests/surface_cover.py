"""Whether hulls hold a surface: where none is near any more, a sphere passes through."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from meshforge.geometry import Bools, Floats, Ints, Shape, heights_above, sample_surface

NEAR = 0.005
"""Of the diagonal: the radius of a sphere of 1%."""
COUNT = 2000  # points on the surface


def sample_lost(vertices: Floats, faces: Ints, before: Iterable[Shape], after: Iterable[Shape]) -> Floats:
    """Points (n, 3) of a surface that were near some hull before, and are near none after."""
    points, _ = sample_surface(vertices, faces, COUNT)
    reach = NEAR * float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))
    found: Floats = points[_are_near(points, before, reach) & ~_are_near(points, after, reach)]
    return found


def _are_near(points: Floats, shapes: Iterable[Shape], reach: float) -> Bools:
    found: Bools = np.any([heights_above(points, shape.tessellate()) <= reach for shape in shapes], axis=0)
    return found
