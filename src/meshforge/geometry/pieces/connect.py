"""Which triangles hang together by shared vertices, and whether they close a surface."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from meshforge.geometry.arrays import Floats, Ints

Bools = npt.NDArray[np.bool_]


def row_ids(*columns: Floats | Ints) -> tuple[Ints, Ints]:
    """A number (n,) for each row, equal for equal rows, and the first row of each number; in order of the values."""
    order = np.lexsort(columns[::-1])
    new = np.zeros(len(order), dtype=bool)
    for column in columns:
        ordered = column[order]
        new[1:] |= ordered[1:] != ordered[:-1]
    ids = np.empty(len(order), dtype=np.int64)
    ids[order] = np.cumsum(new)
    return ids, order[np.flatnonzero(new | (np.arange(len(order)) == 0))]


def welded(vertices: Floats) -> Ints:
    """A number (n,) for each vertex, the same for vertices at exactly one place."""
    return row_ids(*(vertices.T + 0.0))[0]  # adding zero makes -0.0 and 0.0 one


def nearly_welded(points: Floats, corners: Ints, reach: float) -> Ints | None:
    """For each point (n,) the lowest number of those within `reach` [m] of it, chains included.

    Only points that are corners take part; None where no two are that near.
    """
    from scipy.spatial import cKDTree  # a third of the time that all imports take, and seldom needed

    used = np.unique(corners)
    pairs = cKDTree(points[used]).query_pairs(reach, output_type="ndarray")
    if len(pairs) == 0:
        return None
    return linked(used[pairs[:, 0]], used[pairs[:, 1]], len(points))


def by_vertices(corners: Ints) -> Ints:
    """The component (m,) of each triangle of corners (m, 3), connected by shared vertices, numbered by first face."""
    count = int(corners.max(initial=-1)) + 1
    return numbered(linked(corners[:, [0, 1]].ravel(), corners[:, [1, 2]].ravel(), count)[corners[:, 0]])


def distinct_faces(corners: Ints, component: Ints) -> Ints:
    """Indices, ascending, of the triangles with three corners; of doubled ones in one component, the first."""
    proper = np.flatnonzero((corners != np.roll(corners, 1, axis=1)).all(axis=1))
    keys = np.sort(corners[proper], axis=1)
    _, first = row_ids(component[proper], *keys.T)
    return proper[np.sort(first)]


def closed_components(corners: Ints, component: Ints) -> Ints:
    """Numbers of the components in which every edge has an even number of triangles, doubled ones counted once."""
    total = int(component.max(initial=-1)) + 1
    distinct = distinct_faces(corners, component)
    edges, _ = edges_of(corners[distinct])
    part = np.tile(component[distinct], 3)
    ids, first = row_ids(part, *edges.T)
    odd = np.bincount(ids, minlength=len(first)) % 2 == 1
    closed = np.bincount(component[distinct], minlength=total) >= 4
    closed[part[first[odd]]] = False
    return np.flatnonzero(closed)


def edges_of(corners: Ints) -> tuple[Ints, Bools]:
    """The edges (3m, 2) of triangles, lower vertex first, and whether each triangle runs along it that way."""
    directed = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    return np.sort(directed, axis=1), directed[:, 0] < directed[:, 1]


def linked(a: Ints, b: Ints, count: int) -> Ints:
    """For each of `count` things, of which a[k] and b[k] are linked, the lowest one that it hangs together with.

    Each lowest one so far takes on the lowest of its neighbours, until there is nothing to take.
    """
    lowest = np.arange(count)
    while True:
        one, other = lowest[a], lowest[b]
        apart = one != other
        if not apart.any():
            return lowest
        one, other = one[apart], other[apart]
        a, b = a[apart], b[apart]
        np.minimum.at(lowest, np.maximum(one, other), np.minimum(one, other))
        while (lowest != (further := lowest[lowest])).any():
            lowest = further


def numbered(labels: Ints) -> Ints:
    """The same partition, numbered by first occurrence."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    rank: Ints = np.argsort(np.argsort(first))
    return rank[inverse.reshape(-1)]
