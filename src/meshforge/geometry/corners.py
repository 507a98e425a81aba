"""The corners of the hull of points, by two libraries, without the vertices that are none."""

from __future__ import annotations

from collections.abc import Callable

import manifold3d
import numpy as np

from meshforge.geometry.arrays import Floats, Ints, cross
from meshforge.geometry.surface import lowest_altitudes

Corners = tuple[Ints, Ints]
"""Indices of the points that are vertices of their hull, and triangles (m, 3) of these vertices."""
_ROUNDS = 40


def pruned(unit: Floats, attempt: Callable[[Floats], Corners | None], altitude: float) -> Corners | None:
    """The hull without vertices that are none: within `altitude` of an edge between two others, or inside a face."""
    kept = np.arange(len(unit))
    for _ in range(_ROUNDS):
        made = attempt(unit[kept])
        if made is None:
            return None
        vertices, faces = kept[made[0]], made[1]
        spare = _spare(unit[vertices], faces, altitude) or _flat(unit[vertices], faces, altitude)
        if len(spare) == 0:
            return vertices, faces
        kept = np.delete(vertices, spare)
    return None


def _flat(vertices: Floats, faces: Ints, angle: float) -> list[int]:
    """Vertices whose faces lie in one plane or two, to `angle` [rad]: no corners, they can all go at once."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    spread = np.zeros((len(vertices), 3, 3))
    np.add.at(spread, faces.ravel(), np.repeat(normals[:, :, None] * normals[:, None, :], 3, axis=0))
    return [int(k) for k in np.flatnonzero(np.linalg.eigvalsh(spread)[:, 0] < angle * angle)]


def _spare(vertices: Floats, faces: Ints, altitude: float) -> list[int]:
    """Vertices that can go at once, each next to an edge whose ends stay."""
    heights, apex = lowest_altitudes(vertices, faces)
    spare: list[int] = []
    staying: set[int] = set()
    for k in np.flatnonzero(heights < altitude)[np.argsort(heights[heights < altitude], kind="stable")]:
        corner = int(faces[k, apex[k]])
        ends = {int(faces[k, (apex[k] + 1) % 3]), int(faces[k, (apex[k] + 2) % 3])}
        if corner not in staying and corner not in spare and ends.isdisjoint(spare):
            spare.append(corner)
            staying |= ends
    return spare


def by_manifold(points: Floats) -> Corners | None:
    """The hull by manifold3d; it leaves out points within 1e-7 of it. None where it finds none."""
    points = points + 0.0  # no negative zeros: vertices are found again by their bytes
    mesh = manifold3d.Manifold.hull_points(points).to_mesh64()
    faces = np.asarray(mesh.tri_verts, dtype=np.int64)
    if len(faces) < 4:
        return None
    index = dict(zip(_rows(points)[::-1], range(len(points) - 1, -1, -1), strict=True))
    vertices = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3] + 0.0
    return np.array([index[row] for row in _rows(vertices)]), faces


def _rows(points: Floats) -> list[bytes]:
    """The bytes of each of points (n, 3)."""
    rows: list[bytes] = np.ascontiguousarray(points).view("V24").ravel().tolist()
    return rows


def by_qhull(points: Floats) -> Corners | None:
    """The hull by Qhull; None where it finds none."""
    from scipy.spatial import ConvexHull, QhullError  # half of this room's import time, and hardly ever needed

    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        return None
    used, faces = np.unique(hull.simplices, return_inverse=True)
    vertices, faces = points[used], faces.reshape(-1, 3).copy()
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - vertices.mean(axis=0)) < 0
    faces[inward] = faces[inward][:, ::-1]
    return used.astype(np.int64), faces
