"""Decomposition of flat surfaces: engines refuse them, so they are decomposed as thick sheets, of which a slice is
taken."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats, Ints, freeze_floats, freeze_ints
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents, spans_volume
from meshforge.geometry.cut import intersect
from meshforge.geometry.shape import Box, Polytope

_THICK = 0.1  # of the length: thick enough for voxels and cuts, thin enough to count as a sheet
_SLICE = 0.1, 0.2  # of the thickness, out of the middle, where engines like to cut
_WHOLE = 0.95  # a sheet that fills this share of its outline is one hull, as a piece is that fills it of its volume

DecomposeSolid = Callable[[Floats, Ints], list[Polytope]]


def is_sheet(vertices: Any) -> bool:
    """Whether points (n, 3) lie in a plane."""
    return not spans_volume(freeze_floats(vertices, (-1, 3)))


def is_line(vertices: Any) -> bool:
    """Whether points (n, 3) lie on a line, so that there are no hulls of what they span."""
    points = freeze_floats(vertices, (-1, 3))
    return not spans_volume(points) and _is_narrow(principal_extents(points)[2])


def sheet_hulls(vertices: Any, faces: Any, decompose: DecomposeSolid, name: str) -> list[Polytope]:
    """The thin hulls of a flat surface of vertices (n, 3) [m] and faces (m, 3), 1e-4 of its length thick.

    decompose: what makes hulls of a solid one. Raises GeometryError naming `name` where the surface has no area.
    """
    points, triangles = freeze_floats(vertices, (-1, 3)), freeze_ints(faces, (-1, 3))
    used, local = np.unique(triangles, return_inverse=True)
    points, triangles = points[used], local.reshape(-1, 3)
    center, axes, extents = principal_extents(points)
    thin = FLATNESS * float(extents[0])
    if _is_narrow(extents):
        raise GeometryError("it is a line: it has no area", where=name, remedy="Delete it.")
    whole = convex_hull(points, name=name, thicken=thin)
    if _area(points, triangles) >= _WHOLE * whole.volume / thin:
        return [whole]
    flat = (points - center) @ axes.T * [1, 1, 0]  # in its own frame, since engines cut along the coordinate axes
    rise = _THICK * float(extents[0])
    slices = (_slice(hull, rise) for hull in decompose(*_thicken(flat, triangles, rise)))
    hulls = [convex_hull(s @ axes + center, name=name, thicken=thin) for s in slices if s is not None]
    return hulls or [whole]


def _is_narrow(extents: Floats) -> bool:
    """Whether what has these extents (3,), widest first, is too narrow to be a sheet."""
    return bool(extents[1] <= FLATNESS * extents[0])


def _slice(hull: Polytope, rise: float) -> Floats | None:
    """The outline (n, 3) of a hull between two levels, pressed flat; None where it does not reach there."""
    low, high = hull.aabb.min.copy(), hull.aabb.max.copy()
    low[2], high[2] = np.multiply(_SLICE, rise)
    part = intersect(hull, Box.of_bounds(Aabb(low, high)))
    return part.vertices * [1, 1, 0] if part else None


def _area(points: Floats, triangles: Ints) -> float:
    """The area [m^2] of distinct triangles: a sheet may be written with both its sides."""
    a, b, c = (points[np.unique(np.sort(triangles, axis=1), axis=0)[:, k]] for k in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2


def _thicken(flat: Floats, triangles: Ints, rise: float) -> tuple[Floats, Ints]:
    """The closed surface of triangles (m, 3) in the plane z = 0 that reach half of `rise` up and down."""
    corners = flat[triangles]
    down = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] < 0
    up = np.where(down[:, None], triangles[:, ::-1], triangles)
    up = up[np.unique(np.sort(up, axis=1), axis=0, return_index=True)[1]]
    start, end = up.ravel(), up[:, [1, 2, 0]].ravel()
    n = len(flat)
    rim = ~np.isin(start * n + end, end * n + start)
    a, b = start[rim], end[rim]
    walls = np.concatenate([np.column_stack([b, a, a + n]), np.column_stack([b, a + n, b + n])])
    half = np.array([0, 0, rise / 2])
    return np.concatenate([flat + half, flat - half]), np.concatenate([up, up[:, ::-1] + n, walls])
