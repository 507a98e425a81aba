"""What can be told of a triangle surface: closed, outward, convex, slivers."""

from __future__ import annotations

import numpy as np

from meshforge.geometry.arrays import Floats, Ints

_ALL_PAIRS = 50_000_000  # vertices times faces: about half a second
_BLOCK = 4_000_000  # heights of vertices above planes that are held in memory at once


def is_closed(faces: Ints) -> bool:
    """Whether every edge of faces (m, 3) lies in exactly two of them, once in each sense."""
    if len(faces) == 0:
        return False
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    count = int(faces.max()) + 1
    along, against = np.sort(start * count + end), np.sort(end * count + start)
    return bool((np.diff(along) > 0).all() and np.array_equal(along, against))


def is_convex(vertices: Floats, faces: Ints, tolerance: float = 1e-9) -> bool:
    """Whether no vertex lies outside any face plane by more than `tolerance` times the size.

    The plane of a needle, which is noise, is left out: its neighbours bound the shape there. Of a surface with very
    many faces each is held against its neighbours only: a closed surface like a sphere that bends outward at every
    edge is convex (Tietze, Nakajima), and all pairs would take minutes.
    """
    if len(vertices) * len(faces) <= _ALL_PAIRS or not is_closed(faces):
        return height_above(vertices, vertices, faces) <= tolerance * _size(vertices)
    is_sphere = len(np.unique(faces)) - len(faces) // 2 == 2
    return is_sphere and _highest_neighbour(vertices, faces) <= tolerance * _size(vertices)


def _highest_neighbour(vertices: Floats, faces: Ints) -> float:
    """How far [m] any corner lies above the plane of a face that shares an edge with its own; the faces are closed."""
    count = len(vertices)
    start, end, apex = (np.concatenate([faces[:, (k + turn) % 3] for k in range(3)]) for turn in (0, 1, 2))
    along, against = np.argsort(start * count + end), np.argsort(end * count + start)
    beyond = np.empty(len(start), dtype=np.int64)
    beyond[against] = apex[along]  # the corner across each edge
    a, b, c = vertices[start], vertices[end], vertices[apex]
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    keep = lengths > 1e-10 * _size(vertices) ** 2
    heights = np.einsum("ij,ij->i", normals[keep], vertices[beyond[keep]] - a[keep]) / lengths[keep]
    return float(heights.max(initial=-np.inf))


def height_above(points: Floats, vertices: Floats, faces: Ints) -> float:
    """How far [m] the outermost of points (n, 3) lies above a face plane of a convex surface; negative inside."""
    normals, offsets, middle = _planes(vertices, faces)
    step = max(1, _BLOCK // len(points))
    blocks = (slice(k, k + step) for k in range(0, len(normals), step))
    return max((float(((points - middle) @ normals[k].T - offsets[k]).max()) for k in blocks), default=-np.inf)


def outward(vertices: Floats, faces: Ints) -> bool:
    """Whether the faces (m, 3) of a convex surface all show their front to the outside: none faces its middle."""
    _, offsets, _ = _planes(vertices, faces)
    return bool((offsets > 0).all())


def lowest_altitudes(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """The lowest altitude (m,) [m] of each triangle, and which corner (m,) it stands on."""
    corners = vertices[faces]
    sides = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]  # the side opposite to each corner
    lengths = np.linalg.norm(sides, axis=2)
    double_areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    apex = np.argmax(lengths, axis=1)
    longest = np.maximum(lengths[np.arange(len(faces)), apex], np.finfo(float).tiny)
    return double_areas / longest, apex


def _planes(vertices: Floats, faces: Ints) -> tuple[Floats, Floats, Floats]:
    """Unit normals (k, 3) of the faces that are no needles, their offsets (k,) from the middle, and the middle (3,)."""
    middle = vertices.mean(axis=0)
    a, b, c = (vertices[faces[:, k]] - middle for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    keep = lengths > 1e-10 * _size(vertices) ** 2
    normals = normals[keep] / lengths[keep, None]
    return normals, np.einsum("ij,ij->i", normals, a[keep]), middle


def _size(vertices: Floats) -> float:
    return float(np.ptp(vertices, axis=0).max())
