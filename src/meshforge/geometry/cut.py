"""Cutting a shape along a plane."""

from __future__ import annotations

import math

import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats
from meshforge.geometry.convex import convex_hull, spans_volume
from meshforge.geometry.shapes import Polytope, Shape

_THIN = 1e-6  # a part that reaches less than this share of the shape's size beyond the plane is none


def cut(shape: Shape, point: Floats, normal: Floats) -> tuple[Polytope | None, Polytope | None]:
    """The parts of a shape below and above the plane through `point` (3,) across `normal` (3,).

    None stands for a part that is not there. Vertices of the shape stay what they are, bit for bit; a round primitive
    is cut as its tessellation. A part that is thinner than 1e-6 of the shape's size is left out.
    Raises GeometryError for a point that is not finite, or a normal without direction.
    """
    whole = shape.tessellate()
    if not np.isfinite(point).all():
        raise GeometryError("a plane needs a point whose coordinates are finite")
    direction = _direction(normal)
    with np.errstate(over="ignore"):  # far enough from the shape is far enough
        heights = (whole.vertices - point) @ direction
    thin = _THIN * whole.aabb.diagonal
    if heights.min() >= -thin:
        return None, whole
    if heights.max() <= thin:
        return whole, None
    crossing = _crossing(whole, heights)
    below, above = whole.vertices[heights < 0], whole.vertices[heights > 0]
    return _part(below, crossing), _part(above, crossing)


def _direction(normal: Floats) -> Floats:
    """The normal one long, however long it is. It is halved or doubled first, which rounds nothing."""
    most = float(np.abs(normal).max())
    if not (math.isfinite(most) and most > 0):
        raise GeometryError("a plane needs a normal that is finite and not zero")
    near = np.ldexp(normal, -math.frexp(most)[1])
    direction: Floats = near / np.linalg.norm(near)
    return direction


def _crossing(whole: Polytope, heights: Floats) -> Floats:
    """The points (n, 3) where edges meet the plane."""
    faces = whole.faces
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    through = (heights[start] < 0) & (heights[end] > 0)  # each edge has both senses, in its two faces
    start, end = start[through], end[through]
    share = (heights[start] / (heights[start] - heights[end]))[:, None]
    met = whole.vertices[start] * (1 - share) + whole.vertices[end] * share
    return np.concatenate([met, whole.vertices[heights == 0]])


def _part(side: Floats, crossing: Floats) -> Polytope | None:
    points = np.concatenate([side, crossing])
    return convex_hull(points, name="a part of a cut") if spans_volume(points) else None
