"""The convex hull of any points, verified after it is made."""

from __future__ import annotations

import manifold3d
import numpy as np
from scipy.spatial import ConvexHull, QhullError

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.shapes.polytope import Polytope

FLATNESS = 1e-4
"""Degenerate input is thickened to this share of the reference diagonal."""
_CONVEXITY = 1e-9  # how far, relative to its size, a vertex may lie outside a face plane
_RANK = 1e-7  # extents below this share of the largest count as none


def convex_hull(points: Floats, *, name: str = "points", thicken: float | None = None) -> Polytope:
    """The convex hull of points (n, 3).

    thicken: the thickness [m] given to points that span no volume; None refuses them.
    Raises GeometryError naming `name`: no points, a coordinate that is not finite, no extent, or no convex result.
    """
    points = np.unique(np.asarray(points, dtype=np.float64).reshape(-1, 3), axis=0)
    if len(points) == 0:
        raise GeometryError("a convex hull needs points, there are none", where=name)
    if not np.isfinite(points).all():
        raise GeometryError("a coordinate is not a finite number", where=name, remedy="Mend the file's vertices.")
    center, axes, extents = principal_extents(points)
    flat = extents <= _RANK * max(float(extents.max()), np.finfo(float).tiny)
    if thicken is not None and thicken > 0:
        flat = flat | (extents < thicken * 0.5)
        for axis in axes[flat]:
            inward = points - np.outer((points - center) @ axis, axis)
            points = np.concatenate([inward - axis * (thicken / 2), inward + axis * (thicken / 2)])
    elif flat.any():
        raise GeometryError(
            f"its points span no volume (extents {', '.join(f'{e:.3g}' for e in extents)} m)",
            where=name,
            remedy="Give the piece a thickness, or delete it.",
        )
    return _verified(points, name)


def principal_extents(points: Floats) -> tuple[Floats, Floats, Floats]:
    """Middle (3,), principal axes as rows (3, 3), and the extent of the points along each (3,), widest first."""
    center = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - center, full_matrices=True)
    along = (points - center) @ axes.T
    return center, axes, np.ptp(along, axis=0)


def is_convex(vertices: Floats, faces: Ints, tolerance: float = _CONVEXITY) -> bool:
    """Whether no vertex lies outside any face plane by more than `tolerance` times the size."""
    size = float(np.ptp(vertices, axis=0).max())
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    keep = lengths > 1e-10 * size * size  # the plane of a needle is noise; its neighbours bound the shape there
    normals = normals[keep] / lengths[keep, None]
    heights = vertices @ normals.T - np.einsum("ij,ij->i", normals, a[keep])
    return bool(heights.max(initial=-np.inf) <= tolerance * size)


def _verified(points: Floats, name: str) -> Polytope:
    for attempt in (_by_manifold, _by_qhull):
        made = attempt(points)
        if made is not None and made.volume > 0 and is_convex(made.vertices, made.faces, 1e-7):
            return made
    raise GeometryError("no convex hull of its points could be made", where=name)


def _by_manifold(points: Floats) -> Polytope | None:
    shift = points.mean(axis=0)
    scale = float(np.abs(points - shift).max()) or 1.0
    unit_points = (points - shift) / scale + 0.0  # no negative zeros: vertices are found again by their bytes
    mesh = manifold3d.Manifold.hull_points(unit_points).to_mesh64()
    triangles = np.asarray(mesh.tri_verts, dtype=np.int64)
    if len(triangles) < 4:
        return None
    unit = np.asarray(mesh.vert_properties)[:, :3] + 0.0
    return Polytope(_snapped(unit, unit_points, points), triangles)


def _snapped(unit: Floats, unit_points: Floats, points: Floats) -> Floats:
    """The given points that the hull's vertices are, so that no rounding creeps in by shift and scale."""
    index = {row.tobytes(): k for k, row in enumerate(np.ascontiguousarray(unit_points))}
    return points[[index[row.tobytes()] for row in np.ascontiguousarray(unit)]]


def _by_qhull(points: Floats) -> Polytope | None:
    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        return None
    center = points[hull.vertices].mean(axis=0)
    used, faces = np.unique(hull.simplices, return_inverse=True)
    vertices, faces = points[used], faces.reshape(-1, 3).copy()
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - center) < 0
    faces[inward] = faces[inward][:, ::-1]
    return Polytope(vertices, faces)
