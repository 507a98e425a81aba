"""The last look at every shape that an edit makes: convex, closed, of positive volume, finite."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Ints, Polytope, Shape, convex_hull, is_convex, principal_extents

_CONVEXITY = 1e-7  # relative to the size; what the hulls of this program are verified to
_FLAT = 1e-7  # an extent below this share of the largest counts as none


def sound(shape: Shape, name: str, thickness: float) -> Shape:
    """The shape itself where it is sound, else the convex hull of its points, thickened to `thickness` [m].

    Raises GeometryError naming `name` where no sound shape can be made of it.
    """
    return shape if is_sound(shape) else convex_hull(shape.vertices, name=name, thicken=thickness)


def is_sound(shape: Shape) -> bool:
    """Whether a shape is finite, closed, convex, and spans a volume."""
    vertices = shape.vertices
    if not np.isfinite(vertices).all() or not (np.isfinite(shape.volume) and shape.volume > 0):
        return False
    extents = principal_extents(vertices)[2]
    if extents.min() <= _FLAT * extents.max():
        return False
    return not isinstance(shape, Polytope) or (is_closed(shape.faces) and is_convex(vertices, shape.faces, _CONVEXITY))


def is_closed(faces: Ints) -> bool:
    """Whether every edge of the triangles (m, 3) is met once in each direction."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    forward = np.unique(edges, axis=0)
    return len(forward) == len(edges) and np.array_equal(forward, np.unique(edges[:, ::-1], axis=0))
