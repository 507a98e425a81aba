"""Flat surfaces: engines refuse them, so they are decomposed as thick sheets and pressed flat again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from meshforge.geometry.arrays import Floats, Ints, frozen_floats, frozen_ints
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents, spans_volume
from meshforge.geometry.shapes import Polytope

_THICK = 0.02  # of the diagonal: thick enough for voxels and cuts, thin enough to count as a sheet
_WHOLE = 0.95  # a sheet that fills this share of its outline is one hull, as a piece is that fills it of its volume

Decompose = Callable[[Floats, Ints], list[Polytope]]


def is_sheet(vertices: Any) -> bool:
    """Whether points (n, 3) lie in a plane."""
    return not spans_volume(frozen_floats(vertices, (-1, 3)))


def sheet_hulls(vertices: Any, faces: Any, decompose: Decompose, name: str) -> list[Polytope]:
    """The thin hulls of a flat surface of vertices (n, 3) [m] and faces (m, 3), 1e-4 of its diagonal thick.

    decompose: what makes hulls of a solid one. Raises GeometryError naming `name` where the surface has no area.
    """
    points, triangles = frozen_floats(vertices, (-1, 3)), frozen_ints(faces, (-1, 3))
    used, local = np.unique(triangles, return_inverse=True)
    points, triangles = points[used], local.reshape(-1, 3)
    thin = FLATNESS * float(np.linalg.norm(np.ptp(points, axis=0)))
    whole = convex_hull(points, name=name, thicken=thin)
    if _area(points, triangles) >= _WHOLE * whole.volume / thin:
        return [whole]
    center, axes, _ = principal_extents(points)
    thick = decompose(*_thickened(points, triangles, axes[2] * (_THICK / FLATNESS * thin)))
    pressed = (h.vertices - np.outer((h.vertices - center) @ axes[2], axes[2]) for h in thick)
    return [convex_hull(flat, name=name, thicken=thin) for flat in pressed]


def _area(points: Floats, triangles: Ints) -> float:
    """The area [m^2] of distinct triangles: a sheet may be written with both its sides."""
    a, b, c = (points[np.unique(np.sort(triangles, axis=1), axis=0)[:, k]] for k in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2


def _thickened(points: Floats, triangles: Ints, rise: Floats) -> tuple[Floats, Ints]:
    """The closed surface of a sheet of triangles (m, 3) that reaches half of `rise` (3,) to both sides."""
    corners = points[triangles]
    down = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) @ rise < 0
    up = np.where(down[:, None], triangles[:, ::-1], triangles)
    up = up[np.unique(np.sort(up, axis=1), axis=0, return_index=True)[1]]
    start, end = up.ravel(), up[:, [1, 2, 0]].ravel()
    n = len(points)
    rim = ~np.isin(start * n + end, end * n + start)
    a, b = start[rim], end[rim]
    walls = np.concatenate([np.column_stack([b, a, a + n]), np.column_stack([b, a + n, b + n])])
    return np.concatenate([points + rise / 2, points - rise / 2]), np.concatenate([up, up[:, ::-1] + n, walls])
