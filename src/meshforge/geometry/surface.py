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


def neighbours(faces: Ints) -> Ints:
    """The pairs (k, 2) of faces (m, 3) that share an edge."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    owners = np.tile(np.arange(len(faces)), 3)[order]
    same = (edges[order][1:] == edges[order][:-1]).all(axis=1)
    return np.column_stack([owners[:-1][same], owners[1:][same]])


def _highest_neighbour(vertices: Floats, faces: Ints) -> float:
    """How far [m] any corner lies above the plane of a face that shares an edge with its own."""
    normals, offsets, middle, kept = _planes(vertices, faces)
    place = np.full(len(faces), -1)
    place[kept] = np.arange(len(normals))
    pairs = neighbours(faces)
    pairs = np.concatenate([pairs, pairs[:, ::-1]])
    pairs = pairs[place[pairs[:, 0]] >= 0]
    plane = place[pairs[:, 0]]
    corners = vertices[faces[pairs[:, 1]]] - middle
    heights = np.einsum("ij,ikj->ik", normals[plane], corners) - offsets[plane, None]
    return float(heights.max(initial=-np.inf))


def height_above(points: Floats, vertices: Floats, faces: Ints) -> float:
    """How far [m] the outermost of points (n, 3) lies above a face plane of a convex surface; negative inside."""
    normals, offsets, middle, _ = _planes(vertices, faces)
    step = max(1, _BLOCK // len(points))
    blocks = (slice(k, k + step) for k in range(0, len(normals), step))
    return max((float(((points - middle) @ normals[k].T - offsets[k]).max()) for k in blocks), default=-np.inf)


def outward(vertices: Floats, faces: Ints) -> bool:
    """Whether the faces (m, 3) of a convex surface all show their front to the outside: none faces its middle."""
    offsets = _planes(vertices, faces)[1]
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


def _planes(vertices: Floats, faces: Ints) -> tuple[Floats, Floats, Floats, Ints]:
    """Unit normals (k, 3) of the faces that are no needles, their offsets (k,) from the middle, the middle (3,).

    Last the indices (k,) of these faces.
    """
    middle = vertices.mean(axis=0)
    a, b, c = (vertices[faces[:, k]] - middle for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    kept = np.flatnonzero(lengths > 1e-10 * _size(vertices) ** 2)
    normals = normals[kept] / lengths[kept, None]
    return normals, np.einsum("ij,ij->i", normals, a[kept]), middle, kept


def _size(vertices: Floats) -> float:
    return float(np.ptp(vertices, axis=0).max())
