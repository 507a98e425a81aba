"""Polytopes around a hull of few vertices and few flat faces, where both numbers bind: vertices and planes move
together, each vertex on three planes or more."""

from __future__ import annotations

from typing import Self

import numpy as np

from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.convex import convex_hull
from meshforge.geometry.minimax import InnerHull, LinearProgram, State, descend, of_vectors
from meshforge.geometry.shape import Polytope
from meshforge.geometry.surface import neighbour_faces, normals_of

_WEIGHT = 10.0  # of how far a vertex is off its planes, against how far it is from the inner hull
_LEVEL = 1e-7  # of the size: four vertices no farther from one plane are on it
_SIZES = (2, 3, 4, np.inf)  # the most triangles of a face, in turn, until there are few faces


def flatten_faces(vertices: Floats, count: int, hull: Polytope) -> Floats:
    """Return the vertices (n, 3) of a polytope around a hull, of at most as many as there are to start from (m, 3) and
    of `count` flat faces, where joining neighbouring triangles leads to so few. Raises GeometryError, QhullError."""
    inner = InnerHull(hull)
    made = convex_hull((vertices - inner.middle) / inner.size)
    face = _join_triangles(made, count)
    on = np.unique(np.column_stack([made.faces.ravel(), np.repeat(face, 3)]), axis=0)
    on = on[np.bincount(on[:, 0])[on[:, 0]] >= 3]  # others are no corners any more
    kept, on[:, 0] = np.unique(on[:, 0], return_inverse=True)
    corners, normals, offsets = made.vertices[kept], np.zeros((face.max() + 1, 3)), np.zeros(face.max() + 1)
    np.add.at(normals, face, normals_of(made))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    np.add.at(offsets, on[:, 1], (corners[on[:, 0]] * normals[on[:, 1]]).sum(axis=1))
    start = _Incidences(inner, corners, normals, offsets / np.bincount(on[:, 1]), on)
    return inner.scale_back(descend(start, 0.04, rounds=30, gain=3e-3, least=1e-4).settle().corners)


def _join_triangles(hull: Polytope, count: int) -> Ints:
    """The number of the face of each triangle (m,): level neighbours are one face, and then the least bent ones, until
    there are `count` faces or each vertex has three."""
    pairs, faces = neighbour_faces(hull.faces), hull.faces
    first, second = faces[pairs[:, 0]], faces[pairs[:, 1]]
    shared, back = ((p[:, :, None] == q[:, None, :]).any(axis=2) for p, q in ((first, second), (second, first)))
    normals, edges = normals_of(hull)[pairs], hull.vertices[first[shared]].reshape(-1, 2, 3)
    ways = [(hull.vertices[far] - edges[:, 0]) for far in (second[~back], first[~shared])]
    depths = np.min([np.abs((way * normals[:, k]).sum(axis=1)) for k, way in enumerate(ways)], axis=0)
    face, sizes, degrees = np.arange(len(faces)), np.ones(len(faces)), np.bincount(faces.ravel())
    ends, order, left = first[shared].reshape(-1, 2), np.argsort(depths, kind="stable"), len(faces)
    for most in (0, *_SIZES):
        for k in order[depths[order] <= _LEVEL] if most == 0 else order:
            one, other = face[pairs[k]]
            bent = sizes[one] + sizes[other] > most or degrees[ends[k]].min() <= 3 or left <= count
            if one == other or (most and bent):
                continue
            face[face == other], left = one, left - 1
            sizes[one] += sizes[other] if most else 0
            degrees[ends[k]] -= 1
    return np.unique(face, return_inverse=True)[1]


class _Incidences(State):
    """Vertices (n, 3) and planes, grown about the middle until they hold the inner hull; on: (k, 2), vertex and plane.

    error: how far the farthest corner is from the inner hull, and _WEIGHT times how far any is off its planes.
    """

    def __init__(self, inner: InnerHull, corners: Floats, normals: Floats, offsets: Floats, on: Ints) -> None:
        self.inner, self.on, lengths = inner, on, np.linalg.norm(normals, axis=1)
        self.normals, offsets = normals / lengths[:, None], offsets / lengths
        growth = max(1.0, float(((inner.points @ self.normals.T).max(axis=0) / np.maximum(offsets, 1e-3)).max()))
        self.corners, self.offsets = corners * growth, offsets * growth
        self.heights = self.corners @ self.normals.T - self.offsets
        off = max(float(np.abs(self.heights[on[:, 0], on[:, 1]]).max()), float(self.heights.max()))
        self.gaps, self.away = inner.measure_gaps(self.corners)
        self.error = float(self.gaps.max()) + _WEIGHT * off

    def move(self, step: float) -> Self | None:
        """Variables: moves of the vertices, changes of the normals and of the offsets, the most that any is off."""
        n, m = len(self.corners), len(self.normals)
        last = 3 * n + 4 * m + 1
        program, own = LinearProgram(last + 1), np.arange(n)[:, None]
        away = np.hstack([self.away, np.full((n, 2), [_WEIGHT, -1.0])])
        program.limit(np.hstack([of_vectors(own), np.full((n, 2), [last - 1, last])]), away, -self.gaps)
        near = self.inner.find_supports(self.normals)
        plane = np.repeat(np.arange(m), near.shape[1])[:, None]
        points, normals, offsets = self.inner.points[near.ravel()], self.normals[plane[:, 0]], self.offsets[plane[:, 0]]
        columns = np.hstack([3 * n + of_vectors(plane), 3 * n + 3 * m + plane])
        program.limit(
            columns, np.hstack([points, np.full(plane.shape, -1.0)]), offsets - (points * normals).sum(axis=1)
        )
        below = self.heights > -3 * step
        below[self.on[:, 0], self.on[:, 1]] = True
        for sign, pairs in ((1.0, np.argwhere(below)), (-1.0, self.on)):
            columns, entries = self._differentiate(pairs)
            slack = np.full((len(pairs), 1), last - 1)
            entries = np.hstack([sign * entries, np.full(slack.shape, -1.0)])
            program.limit(np.hstack([columns, slack]), entries, -sign * self.heights[pairs[:, 0], pairs[:, 1]])
        high = np.concatenate([np.full(3 * (n + m), step), np.full(m + 2, np.inf)])
        found = program.solve(
            np.append(-high[:-2], [0.0, 0.0]), high, "highs-ipm"
        )  # simplex takes ten times as long, or finds none
        return None if found is None else self._change(found[: last - 1])

    def settle(self) -> Self:
        """The vertices brought onto their planes by Newton's method, all changes as small as can be."""
        from scipy.sparse import csr_array  # lazy: slow to import, only simplifying needs it
        from scipy.sparse.linalg import lsmr  # lazy: as above

        state, most = self, 3 * len(self.corners) + 4 * len(self.normals)
        for _ in range(5):
            columns, entries = state._differentiate(self.on)
            rows = np.repeat(np.arange(len(columns)), columns.shape[1])
            slopes = csr_array((entries.ravel(), (rows, columns.ravel())), shape=(len(columns), most))
            off = state.heights[self.on[:, 0], self.on[:, 1]]
            state = state._change(lsmr(slopes, -off, atol=1e-14, btol=1e-14, maxiter=5 * most)[0])
        return state

    def _differentiate(self, pairs: Ints) -> tuple[Ints, Floats]:
        """Columns and entries (k, 7): how the height of a vertex over a plane changes with both."""
        vertex, plane, count = pairs[:, :1], pairs[:, 1:], 3 * len(self.corners)
        columns = [of_vectors(vertex), count + of_vectors(plane), count + 3 * len(self.normals) + plane]
        entries = [self.normals[pairs[:, 1]], self.corners[pairs[:, 0]], np.full(vertex.shape, -1.0)]
        return np.hstack(columns), np.hstack(entries)

    def _change(self, change: Floats) -> Self:
        n, m = 3 * len(self.corners), 3 * len(self.normals)
        corners, normals = self.corners + change[:n].reshape(-1, 3), self.normals + change[n : n + m].reshape(-1, 3)
        return type(self)(self.inner, corners, normals, self.offsets + change[n + m :], self.on)
