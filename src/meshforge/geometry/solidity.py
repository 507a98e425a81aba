"""Whether a piece of surface counts as a hull: closed, not flat, and as full as its convex hull."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints, cross
from meshforge.geometry.connectivity import component_roots, edges_of, row_ids
from meshforge.geometry.convex import convex_hull
from meshforge.geometry.shape import Polytope
from meshforge.geometry.surface import is_closed

LEAST_FILL = 0.95
"""A piece is a hull when its volume is at least this share of its convex hull's."""
_MOST_FILL = 1.05  # a surface that encloses more than its hull runs through itself
_LEVEL = 1e-3  # a hole is planar when it is level within this share of the piece's size
_DEPTH = 0.01  # a face lies on the hull when it is no deeper in it than this share of the hull's thickness
_LARGE = 1_000_000  # pairs of faces; beyond, a surface is no careless triangulation of a hull
_FLAT = 1e-6  # a piece is flat when its hull is thinner than this share of its size


@dataclass(frozen=True, eq=False, slots=True)
class SolidityVerdict:
    """shape: the convex hull, None with a reason; volume [m^3]: of the piece, negative where it is inside out.

    closed: whether there was no hole to fill.
    """

    shape: Polytope | None
    reason: str | None
    volume: float = 0.0
    closed: bool = False


def judge_solidity(points: Floats, corners: Ints) -> SolidityVerdict:
    """What a piece of points (n, 3) and distinct triangles (m, 3) is; the winding may be inverted or mixed."""
    used, local = np.unique(corners, return_inverse=True)
    points, corners = points[used], local.reshape(-1, 3)
    hull = _hull_unless_flat(points)
    if hull is None:
        return SolidityVerdict(None, "flat")
    result = _judge_fill(points, corners, hull)
    if result.shape is None:
        aligned = _judge_fill(points, _align_windings(corners), hull)
        result = aligned if aligned.shape else result
    if result.shape is None and _covers(points, corners, hull):
        return SolidityVerdict(hull, None, hull.volume, True)
    return result


def _hull_unless_flat(points: Floats) -> Polytope | None:
    """The convex hull, None where it is flat."""
    size = float(np.ptp(points, axis=0).max(initial=0.0))
    try:
        hull = convex_hull(points)
    except GeometryError:
        return None
    x, y, z = hull.aabb.size.tolist()
    if hull.volume > 2 * _FLAT * size * (x * y + y * z + z * x):  # a convex surface in a box has no more area than it
        return hull
    return hull if _thickness(hull) > _FLAT * size else None


def _thickness(hull: Polytope) -> float:
    """The mean thickness [m]: volume by half the area."""
    return hull.volume / max(_area(hull.vertices, hull.faces) / 2, np.finfo(float).tiny)


def _area(points: Floats, corners: Ints) -> float:
    a, b, c = (points[corners[:, k]] for k in range(3))
    return float(np.linalg.norm(cross(b - a, c - a), axis=1).sum()) / 2


def _covers(points: Floats, corners: Ints, hull: Polytope) -> bool:
    """Whether triangles lie on the hull and cover it, however they overlap and are wound."""
    if len(hull.faces) * len(corners) > _LARGE or _area(points, corners) < LEAST_FILL * _area(
        hull.vertices, hull.faces
    ):
        return False
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    normals = cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    normals, a = normals[lengths > 0] / lengths[lengths > 0, None], a[lengths > 0]
    middles = [points[corners[:, list(ends)]].mean(axis=1) for ends in ((0, 1, 2), (0, 1), (1, 2), (2, 0))]
    heights = np.concatenate(middles) @ normals.T - np.einsum("ij,ij->i", normals, a)
    return float(-heights.max(axis=1).min()) <= _DEPTH * _thickness(hull)


def _judge_fill(points: Floats, corners: Ints, hull: Polytope) -> SolidityVerdict:
    """The verdict on triangles as they are wound."""
    size = float(np.ptp(points, axis=0).max())
    origin = hull.centroid
    a, b, c = (points[corners[:, k]] - origin for k in range(3))
    six_volumes = float(np.einsum("ij,ij->i", a, cross(b, c)).sum())
    rim, weight = _find_rim(corners)
    if len(rim):
        caps = _volume_of_caps(points, rim, weight, origin, _LEVEL * size)
        if caps is None:
            return SolidityVerdict(None, "open: it has a hole that is not planar")
        six_volumes += caps
    volume = six_volumes / 6
    share = abs(volume) / hull.volume
    if share < LEAST_FILL:
        return SolidityVerdict(
            None, f"not convex: fills {floor(100 * share)}% of its convex hull", volume, len(rim) == 0
        )
    if share > _MOST_FILL:
        return SolidityVerdict(None, "it overlaps itself", volume, len(rim) == 0)
    return SolidityVerdict(hull, None, volume, len(rim) == 0)


def _find_rim(corners: Ints) -> tuple[Ints, Ints]:
    """The edges (k, 2) that triangles leave open, as the triangles run along them, and how many times each."""
    if is_closed(corners):
        return corners[:0, :2], corners[:0, 0]
    edges, forward = edges_of(corners)
    ids, first = row_ids(*edges.T)
    net = np.zeros(len(first), dtype=np.int64)
    np.add.at(net, ids, np.where(forward, 1, -1))
    left = np.flatnonzero(net)
    rim = edges[first[left]]
    back = net[left] < 0
    rim[back] = rim[back][:, ::-1]
    return rim, np.abs(net[left])


def _volume_of_caps(points: Floats, rim: Ints, weight: Ints, origin: Floats, level: float) -> float | None:
    """Six times the volume that planar caps over the holes add; None where a hole is not planar."""
    used, local = np.unique(rim, return_inverse=True)
    local = local.reshape(-1, 2)
    hole = component_roots(local[:, 0], local[:, 1], len(used))
    total = 0.0
    for k in np.unique(hole):
        edges = local[hole[local[:, 0]] == k]
        around = points[used[np.unique(edges)]]
        middle = around.mean(axis=0)
        _, axes = np.linalg.eigh((around - middle).T @ (around - middle))
        if float(np.abs((around - middle) @ axes[:, 0]).max()) > level:
            return None
        a, b = (points[used[edges[:, end]]] - origin for end in (1, 0))
        turns = weight[hole[local[:, 0]] == k]
        total += float((turns * np.einsum("ij,ij->i", a, np.cross(b, middle - origin))).sum())
    return total


def _align_windings(corners: Ints) -> Ints:
    """The triangles wound as their neighbours are, as far as edges of two triangles tell."""
    edges, forward = edges_of(corners)
    face = np.tile(np.arange(len(corners)), 3)
    ids, _ = row_ids(*edges.T)
    shared = np.flatnonzero(np.bincount(ids)[ids] == 2)
    pairs = shared[np.argsort(ids[shared], kind="stable")].reshape(-1, 2)
    one, other = face[pairs[:, 0]], face[pairs[:, 1]]
    agree = (forward[pairs[:, 0]] != forward[pairs[:, 1]]).astype(np.int64)
    n = len(corners)  # node k is triangle k as it is wound, node n + k is it turned over
    rows = np.concatenate([one, one + n])
    side = component_roots(rows, np.concatenate([other + n * (1 - agree), other + n * agree]), 2 * n)
    turned = side[:n] > side[n:]  # equal sides: a surface with one side only, nothing to turn
    out = corners.copy()
    out[turned] = out[turned][:, ::-1]
    return out
