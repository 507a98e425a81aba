"""Convex shapes cut by planes, intersected, and partitioned by other shapes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats
from meshforge.geometry.convex import convex_hull, spans_volume
from meshforge.geometry.measure import to_manifold, volume_of_union
from meshforge.geometry.shape import Polytope, Shape

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
    direction = _normalize(normal)
    with np.errstate(over="ignore"):  # far enough from the shape is far enough
        heights = (whole.vertices - point) @ direction
    thin = _THIN * whole.aabb.diagonal
    if heights.min() >= -thin:
        return None, whole
    if heights.max() <= thin:
        return whole, None
    crossing = _cross_edges(whole, heights)
    below, above = whole.vertices[heights < 0], whole.vertices[heights > 0]
    return _hull_of_part(below, crossing), _hull_of_part(above, crossing)


def _normalize(normal: Floats) -> Floats:
    """The normal one long, however long it is. It is halved or doubled first, which rounds nothing."""
    most = float(np.abs(normal).max())
    if not (math.isfinite(most) and most > 0):
        raise GeometryError("a plane needs a normal that is finite and not zero")
    near = np.ldexp(normal, -math.frexp(most)[1])
    direction: Floats = near / np.linalg.norm(near)
    return direction


def _cross_edges(whole: Polytope, heights: Floats) -> Floats:
    """The points (n, 3) where edges meet the plane."""
    faces = whole.faces
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    through = (heights[start] < 0) & (heights[end] > 0)  # each edge has both senses, in its two faces
    start, end = start[through], end[through]
    share = (heights[start] / (heights[start] - heights[end]))[:, None]
    crossings = whole.vertices[start] * (1 - share) + whole.vertices[end] * share
    return np.concatenate([crossings, whole.vertices[heights == 0]])


def _hull_of_part(side: Floats, crossing: Floats) -> Polytope | None:
    points = np.concatenate([side, crossing])
    return convex_hull(points, name="a part of a cut") if spans_volume(points) else None


@dataclass(frozen=True, eq=False, slots=True)
class Partition:
    """The parts of a shape, in the order of what parted it.

    dropped: how many parts were too small; lost: the share of the shape's volume that is in no part.
    """

    parts: tuple[Polytope, ...]
    dropped: int
    lost: float


def intersect(a: Shape, b: Shape) -> Polytope | None:
    """What two convex shapes have in common, to rounding; None where that spans no volume.

    Round primitives count as their tessellations.
    """
    if not a.aabb.intersects(b.aabb):
        return None
    bounds = Aabb.union([a.aabb, b.aabb])
    common = to_manifold(a.tessellate(), bounds) ^ to_manifold(b.tessellate(), bounds)
    corners = np.asarray(common.to_mesh64().vert_properties, dtype=np.float64)[:, :3] * bounds.diagonal + bounds.center
    return convex_hull(corners, name="the common part") if len(corners) > 3 and spans_volume(corners) else None


def partition(shape: Shape, by: Sequence[Shape], least: float = 1e-3) -> Partition:
    """A shape parted by convex shapes that together cover it more or less.

    least: parts of a smaller share of its volume are dropped.
    """
    found = [part for other in by if (part := intersect(shape, other))]
    parts = tuple(part for part in found if part.volume >= least * shape.volume)
    lost = 1.0 - volume_of_union(parts) / shape.tessellate().volume
    return Partition(parts, len(found) - len(parts), min(max(lost, 0.0), 1.0))
