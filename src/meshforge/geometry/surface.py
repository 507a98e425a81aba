"""What can be told of a triangle surface: closed, outward, convex, slivers."""

from __future__ import annotations

import numpy as np

from meshforge.geometry.arrays import Floats, Ints, cross
from meshforge.geometry.heights import planes_of, rises_above

_ALL_PAIRS = 50_000_000  # vertices times faces


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
        return not rises_above(vertices, vertices, faces, tolerance * _size(vertices))
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
    planes = planes_of(vertices, faces)
    place = np.full(len(faces), -1)
    place[planes.face_indices] = np.arange(len(planes.face_indices))
    pairs = neighbours(faces)
    pairs = np.concatenate([pairs, pairs[:, ::-1]])
    pairs = pairs[place[pairs[:, 0]] >= 0]
    plane = place[pairs[:, 0]]
    corners = vertices[faces[pairs[:, 1]]] - planes.middle
    heights = np.einsum("ij,ikj->ik", planes.normals[plane], corners) - planes.offsets[plane, None]
    return float(heights.max(initial=-np.inf))


def outward(vertices: Floats, faces: Ints) -> bool:
    """Whether the faces (m, 3) of a convex surface all show their front to the outside: none faces its middle."""
    return bool((planes_of(vertices, faces).offsets > 0).all())


def lowest_altitudes(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """The lowest altitude (m,) [m] of each triangle, and which corner (m,) it stands on."""
    corners = vertices[faces]
    sides = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]  # the side opposite to each corner
    lengths = np.linalg.norm(sides, axis=2)
    double_areas = np.linalg.norm(cross(sides[:, 0], sides[:, 1]), axis=1)
    apex = np.argmax(lengths, axis=1)
    longest = np.maximum(lengths[np.arange(len(faces)), apex], np.finfo(float).tiny)
    return double_areas / longest, apex


def _size(vertices: Floats) -> float:
    return float(np.ptp(vertices, axis=0).max())
