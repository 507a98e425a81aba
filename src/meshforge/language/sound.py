"""The last look at every shape that an edit makes: convex, closed, of positive volume, finite."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Polytope, Shape, convex_hull, is_closed, is_convex, outward, spans_volume

_CONVEXITY = 1e-7  # relative to the size


def sound(shape: Shape, name: str, thickness: float) -> Shape:
    """The shape itself where it is sound, else the convex hull of its points, thickened to `thickness` [m].

    Raises GeometryError naming `name` where no sound shape can be made of it.
    """
    return shape if is_sound(shape) else convex_hull(shape.vertices, name=name, thicken=thickness)


def is_sound(shape: Shape) -> bool:
    """Whether a shape is finite, closed, convex, and spans a volume."""
    with np.errstate(all="ignore"):
        vertices, volume = shape.vertices, shape.volume
    if not np.isfinite(vertices).all() or not (np.isfinite(volume) and volume > 0):
        return False
    return spans_volume(vertices) and (not isinstance(shape, Polytope) or _is_hull(shape))


def _is_hull(shape: Polytope) -> bool:
    vertices, faces = shape.vertices, shape.faces
    return is_closed(faces) and outward(vertices, faces) and is_convex(vertices, faces, _CONVEXITY)
