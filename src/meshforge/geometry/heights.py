"""Whether points rise above the planes of a convex surface, very many points and planes too."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshforge.geometry.arrays import Floats, Ints, cross

_ALL_PAIRS = 1_000_000  # points times planes; beyond, most are ruled out by the boxes of groups of points
_GROUP = 128


@dataclass(frozen=True, eq=False, slots=True)
class Planes:
    """Planes of faces: unit normals (k, 3), offsets (k,) from the middle (3,), and the numbers (k,) of the faces."""

    normals: Floats
    offsets: Floats
    middle: Floats
    face_indices: Ints


def planes_of(vertices: Floats, faces: Ints) -> Planes:
    """The planes of the faces (m, 3) that are no needles: of these the plane is noise."""
    middle = vertices.mean(axis=0)
    around = vertices - middle
    a, b, c = (around[faces[:, k]] for k in range(3))
    normals = cross(b - a, c - a)
    lengths = np.sqrt(np.einsum("ij,ij->i", normals, normals))
    kept = np.flatnonzero(lengths > 1e-10 * float(np.ptp(vertices, axis=0).max()) ** 2)
    normals = normals[kept] / lengths[kept, None]
    return Planes(normals, np.einsum("ij,ij->i", normals, a[kept]), middle, kept)


def rises_above(points: Floats, vertices: Floats, faces: Ints, height: float) -> bool:
    """Whether any of points (n, 3) lies more than `height` [m] above a face plane of a convex surface."""
    planes = planes_of(vertices, faces)
    points = points - planes.middle
    limits = planes.offsets + height
    if len(points) * len(limits) > _ALL_PAIRS:
        return _some_group_rises(points, planes.normals, limits)
    return bool((points @ planes.normals.T > limits).any())


def _some_group_rises(points: Floats, normals: Floats, limits: Floats) -> bool:
    """The same in groups of points that are near each other; the box of a group bounds what its points can reach."""
    from scipy.spatial import cKDTree

    slopes = np.abs(normals)
    for group in np.array_split(points[cKDTree(points).indices], len(points) // _GROUP + 1):
        low, high = group.min(axis=0), group.max(axis=0)
        reach = normals @ ((low + high) / 2) + slopes @ ((high - low) / 2)
        near = np.flatnonzero(reach * (1 + 1e-12) > limits)
        if len(near) and (group @ normals[near].T > limits[near]).any():
            return True
    return False
