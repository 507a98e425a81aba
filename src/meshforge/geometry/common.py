"""What convex shapes have in common, as a shape; and a shape parted by others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.convex import convex_hull, spans_volume
from meshforge.geometry.overlap import solid, volume_of_union
from meshforge.geometry.shapes import Polytope, Shape


@dataclass(frozen=True, eq=False, slots=True)
class Parting:
    """The parts of a shape, in the order of what parted it.

    dropped: how many parts were too small; lost: the share of the shape's volume that is in no part.
    """

    parts: tuple[Polytope, ...]
    dropped: int
    lost: float


def common(a: Shape, b: Shape) -> Polytope | None:
    """What two convex shapes have in common, to rounding; None where that spans no volume.

    Round primitives count as their tessellations.
    """
    low, high = np.maximum(a.aabb.min, b.aabb.min), np.minimum(a.aabb.max, b.aabb.max)
    if not (low < high).all():
        return None
    bounds = Aabb.union([a.aabb, b.aabb])
    met = solid(a.tessellate(), bounds) ^ solid(b.tessellate(), bounds)
    corners = np.asarray(met.to_mesh64().vert_properties, dtype=np.float64)[:, :3] * bounds.diagonal + bounds.center
    return convex_hull(corners, name="the common part") if len(corners) > 3 and spans_volume(corners) else None


def parted(shape: Shape, by: Sequence[Shape], least: float = 1e-3) -> Parting:
    """A shape parted by convex shapes that together cover it more or less.

    least: parts of a smaller share of its volume are dropped.
    """
    found = [part for other in by if (part := common(shape, other))]
    parts = tuple(part for part in found if part.volume >= least * shape.volume)
    lost = 1.0 - volume_of_union(parts) / shape.tessellate().volume
    return Parting(parts, len(found) - len(parts), min(max(lost, 0.0), 1.0))
