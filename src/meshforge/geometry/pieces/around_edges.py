"""Solids that share places in a soup of triangles, told apart around their edges or by the order they are written."""

from __future__ import annotations

import numpy as np

from meshforge.geometry.arrays import Floats, Ints, cross
from meshforge.geometry.pieces.connect import edges_of, linked, numbered, row_ids

_TURN = 1e-7  # [rad] triangles around an edge closer than this lie on each other


def closed_runs(corners: Ints) -> Ints:
    """The run (m,) of each triangle: consecutive ones, cut wherever all edges so far have an even number of them.

    Programs write solid by solid, so this tells solids apart that share places in a file without groups.
    """
    edges, _ = edges_of(corners)
    ids, first = row_ids(*edges.T)
    marks = np.random.default_rng(0).integers(1, 2**63, len(first), dtype=np.uint64)
    marks[edges[first, 0] == edges[first, 1]] = 0
    of_edge = marks[ids].reshape(3, -1)
    open_edges = np.bitwise_xor.accumulate(of_edge[0] ^ of_edge[1] ^ of_edge[2])
    ends = (open_edges == 0) & (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    run = np.concatenate([[0], np.cumsum(ends)[:-1]])
    last = max(int(ends.sum()) - int(open_edges[-1] == 0), 0)
    return np.asarray(np.minimum(run, last), dtype=np.int64)


def is_simple(corners: Ints) -> bool:
    """Whether no edge has more than two triangles."""
    edges, _ = edges_of(corners)
    return int(np.bincount(row_ids(*edges.T)[0]).max(initial=0)) <= 2


def by_edges(points: Floats, corners: Ints, inward: bool) -> Ints:
    """The component (m,) of each triangle, connected across edges only.

    Where more than two triangles meet in an edge, each goes with the next one around the edge through the solid,
    so that solids which touch in an edge or a wall come apart. inward: the windings are turned inside out.
    """
    edges, forward = edges_of(corners)
    face = np.tile(np.arange(len(corners)), 3)
    ids, first = row_ids(*edges.T)
    angle = _angles(points, corners, edges, first[ids])
    begins = forward == inward  # going around the edge, the solid begins at this triangle
    order = np.lexsort((begins, np.round(angle / _TURN), ids))
    starts = np.searchsorted(ids[order], np.arange(len(first)))
    following = np.append(order[1:], order[0])
    ends = np.append(starts[1:], len(order)) - 1
    following[ends] = order[starts]
    joined = (np.bincount(ids)[ids[order]] == 2) | (begins[order] & ~begins[following])
    return numbered(linked(face[order[joined]], face[following[joined]], len(corners)))


def _angles(points: Floats, corners: Ints, edges: Ints, reference: Ints) -> Floats:
    """The angle (3m,) of each triangle around each of its edges, from that of another triangle there, in 0..2 pi."""
    opposite = np.concatenate([corners[:, 2], corners[:, 0], corners[:, 1]])
    low, high = points[edges[:, 0]], points[edges[:, 1]]
    axis = high - low
    axis = axis / np.maximum(np.linalg.norm(axis, axis=1, keepdims=True), np.finfo(float).tiny)
    out = points[opposite] - low
    out = out - np.einsum("ij,ij->i", out, axis)[:, None] * axis
    x = out[reference]
    y = cross(axis, x)
    turn = np.arctan2(np.einsum("ij,ij->i", out, y), np.einsum("ij,ij->i", out, x))
    turn = np.where(turn < 0, turn + 2 * np.pi, turn)
    return np.where(turn > 2 * np.pi - _TURN, 0.0, turn)
