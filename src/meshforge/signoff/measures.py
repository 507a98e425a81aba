"""What an edit did, in figures that need neither labels nor a program: volume, extents, hulls, free space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import isfinite

import numpy as np
import numpy.typing as npt

from meshforge.common import GeometryError
from meshforge.geometry import Aabb, Floats, Shape, convex_hull, planes_of
from meshforge.symbolic import Hull, SymbolicMesh

POINTS = 2048
"""Places in the box of an asset; at those within its convex hull free space is looked at."""
_PLASTIC = 1.2207440846057596  # the root of x^4 = x + 1, whose powers spread points evenly in space (Roberts 2018)
_FLAT = 1e-12  # share of its box from which on a hull has a volume

_Mask = npt.NDArray[np.bool_]

Extents = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class EditMeasures:
    """One edit. hulls: how many; removed: the share of the hulls of before that are gone; volumes: sums over hulls,
    what overlaps counts twice [m^3]; extents: sides of the box around all hulls, in the frame of the file [m].

    Of the convex hull of all hulls before, which turns with the asset, free: the share that none of them covers;
    filled: the share of the free space that hulls cover after; freed: the share of the covered space free after.
    """

    hulls_before: int
    hulls_after: int
    removed: float
    volume_before: float
    volume_after: float
    extents_before: Extents
    extents_after: Extents
    free: float
    filled: float
    freed: float


def measure_edit(before: SymbolicMesh, after: SymbolicMesh) -> EditMeasures:
    """The measures of an edit; both meshes are in one frame, as a program leaves them."""
    free, filled, freed = _compare_space(before, after)
    gone = {hull.name for hull in before.hulls} - {hull.name for hull in after.hulls}
    return EditMeasures(
        hulls_before=len(before.hulls),
        hulls_after=len(after.hulls),
        removed=len(gone) / max(len(before.hulls), 1),
        volume_before=_sum_volumes(before.hulls),
        volume_after=_sum_volumes(after.hulls),
        extents_before=_extents_of(before.aabb),
        extents_after=_extents_of(after.aabb),
        free=free,
        filled=filled,
        freed=freed,
    )


def _sum_volumes(hulls: Sequence[Hull]) -> float:
    return sum((_volume_of(hull.shape) for hull in hulls), 0.0)


def _volume_of(shape: Shape) -> float:
    """The volume of a shape [m^3], 0 where it is flat, turned inside out or not finite."""
    volume = float(shape.volume)
    return volume if isfinite(volume) and volume > 0 else 0.0


def _extents_of(box: Aabb | None) -> Extents:
    x, y, z = (0.0, 0.0, 0.0) if box is None else box.size.tolist()
    return x, y, z


def _compare_space(before: SymbolicMesh, after: SymbolicMesh) -> tuple[float, float, float]:
    points = _points_within(before)
    kept = {id(hull.shape) for hull in before.hulls} & {id(hull.shape) for hull in after.hulls}
    both = _cover(points, [hull.shape for hull in before.hulls if id(hull.shape) in kept])
    was, now = (
        both | _cover(points, [hull.shape for hull in mesh.hulls if id(hull.shape) not in kept])
        for mesh in (before, after)
    )
    free = int(np.count_nonzero(~was))
    filled, freed = int(np.count_nonzero(now & ~was)), int(np.count_nonzero(was & ~now))
    return free / max(len(points), 1), filled / max(free, 1), freed / max(len(points) - free, 1)


def _points_within(mesh: SymbolicMesh) -> Floats:
    """Points (n, 3) that lie evenly within the convex hull of a mesh; none where that is flat."""
    if mesh.aabb is None:
        return np.zeros((0, 3))
    try:
        around = convex_hull(np.concatenate([hull.vertices for hull in mesh.hulls]))
    except GeometryError:
        return np.zeros((0, 3))
    points = mesh.aabb.min + _spread_points(POINTS) * mesh.aabb.size
    return points[_cover(points, [around])]


@cache
def _spread_points(count: int) -> Floats:
    """Points (count, 3) in the unit cube that lie evenly, the same each time."""
    steps = _PLASTIC ** -np.arange(1.0, 4.0)
    points: Floats = (0.5 + np.arange(1.0, count + 1)[:, None] * steps) % 1.0
    points.flags.writeable = False
    return points


def _cover(points: Floats, shapes: Sequence[Shape]) -> _Mask:
    """Which of points (n, 3) lie in any of some shapes; round ones count as their tessellations."""
    found = np.zeros(len(points), dtype=bool)
    for shape in shapes:
        box = shape.aabb
        if _volume_of(shape) <= _FLAT * float(np.prod(box.size)):
            continue
        inside = ((points >= box.min) & (points <= box.max)).all(axis=1)
        near = np.flatnonzero(inside & ~found)
        if len(near):
            planes = planes_of(shape.vertices, shape.faces)
            heights = (points[near] - planes.middle) @ planes.normals.T
            found[near] = (heights <= planes.offsets).all(axis=1)
    return found
