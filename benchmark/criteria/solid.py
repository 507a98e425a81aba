"""Hulls as solids, for booleans."""

from __future__ import annotations

from manifold3d import Manifold

from meshforge.symbolic import Hull


def solid(hull: Hull) -> Manifold:
    """A hull as a manifold; a round one as its tessellation."""
    return Manifold.hull_points(hull.vertices)


def near(one: Manifold, other: Manifold) -> bool:
    """Whether the boxes of two solids overlap."""
    a, b = one.bounding_box(), other.bounding_box()
    return all(a[k] <= b[k + 3] and b[k] <= a[k + 3] for k in range(3))
