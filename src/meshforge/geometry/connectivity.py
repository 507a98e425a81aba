"""Which triangles of a soup hang together: by shared vertices, across edges, or by the order they are written in."""

import numpy as np

from meshforge.geometry.arrays import Bools, Floats, Ints, cross

_TURN = 1e-7  # [rad] triangles around an edge closer than this lie on each other


def row_ids(*columns: Floats | Ints) -> tuple[Ints, Ints]:
    """Return a number (n,) for each row, equal for equal rows, and the first row of each; in order of the values."""
    key = np.zeros(len(columns[0]), dtype=np.int64)
    for column in columns:
        values = column - column.min(initial=0) if column.dtype.kind == "i" else _rank_values(column)[0]
        size = int(values.max(initial=0)) + 1
        key = (key if size * (int(key.max(initial=0)) + 1) < 2**63 else _rank_values(key)[0]) * size + values
    ids, order, new = _rank_values(key)
    return ids, np.minimum.reduceat(order, np.flatnonzero(new)) if len(order) else order


def _rank_values(values: Floats | Ints) -> tuple[Ints, Ints, Bools]:
    """A number (n,) for each value in their order, equal for equal ones; the order; and where in it a number begins."""
    order = np.argsort(values)
    ordered = values[order]
    new = np.ones(len(order), dtype=bool)
    new[1:] = ordered[1:] != ordered[:-1]
    ids = np.empty(len(order), dtype=np.int64)
    ids[order] = np.cumsum(new) - 1
    return ids, order, new


def compact(corners: Ints) -> tuple[Ints, Ints]:
    """Return the numbers that occur in corners, ascending, and the corners by their places among these."""
    occurs = np.zeros(int(corners.max(initial=-1)) + 1, dtype=bool)
    occurs[corners.ravel()] = True
    return np.flatnonzero(occurs), (np.cumsum(occurs) - 1)[corners]


def weld(vertices: Floats) -> Ints:
    """Return a number (n,) for each vertex, the same for vertices at exactly one place."""
    return row_ids(*(vertices.T + 0.0))[0]  # adding zero makes -0.0 and 0.0 one


def weld_nearly(points: Floats, corners: Ints, reach: float) -> Ints | None:
    """Return for each point (n,) the lowest number of those within `reach` [m] of it, chains included.

    Only points that are corners take part; None where no two are that near.
    """
    from scipy.spatial import cKDTree  # lazy: a third of the time that all imports take, and seldom needed

    used = np.unique(corners)
    pairs = cKDTree(points[used]).query_pairs(reach, output_type="ndarray")
    if len(pairs) == 0:
        return None
    return component_roots(used[pairs[:, 0]], used[pairs[:, 1]], len(points))


def components_by_vertices(corners: Ints) -> Ints:
    """Return the component (m,) of each triangle of corners (m, 3), by shared vertices, numbered by first face."""
    count = int(corners.max(initial=-1)) + 1
    return number_by_occurrence(
        component_roots(corners[:, [0, 1]].ravel(), corners[:, [1, 2]].ravel(), count)[corners[:, 0]]
    )


def distinct_faces(corners: Ints, component: Ints) -> Ints:
    """Return indices, ascending, of the triangles with three corners; of doubled ones in one component, the first."""
    proper = np.flatnonzero((corners != corners[:, [2, 0, 1]]).all(axis=1))
    _, first = row_ids(component[proper], *np.sort(corners[proper], axis=1).T)
    return proper[np.sort(first)]


def find_closed_components(corners: Ints, component: Ints) -> Ints:
    """Return numbers of the components whose edges each have an even number of triangles, doubled ones counted once."""
    total = int(component.max(initial=-1)) + 1
    large = np.flatnonzero((np.bincount(component, minlength=total) >= 4)[component])  # of a raw STL none
    corners, component = corners[large], component[large]
    distinct = distinct_faces(corners, component)
    edges, _ = edges_of(corners[distinct])
    part = np.tile(component[distinct], 3)
    ids, first = row_ids(part, *edges.T)
    unpaired = np.bincount(ids, minlength=len(first)) % 2 == 1
    closed = np.bincount(component[distinct], minlength=total) >= 4
    closed[part[first[unpaired]]] = False
    return np.flatnonzero(closed)


def edges_of(corners: Ints) -> tuple[Ints, Bools]:
    """Return the edges (3m, 2) of triangles, lower vertex first, and whether each triangle runs along it that way."""
    directed = np.concatenate([corners[:, :2], corners[:, 1:], corners[:, ::-2]])
    return np.sort(directed, axis=1), directed[:, 0] < directed[:, 1]


def component_roots(a: Ints, b: Ints, count: int) -> Ints:
    """Return for each of `count` things, of which a[k] and b[k] are linked, the lowest one that it hangs together with.

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


def number_by_occurrence(labels: Ints) -> Ints:
    """Return labels (n,) of a partition, numbered by their first occurrence."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    rank: Ints = np.argsort(np.argsort(first))
    return rank[inverse.reshape(-1)]


def find_closed_runs(corners: Ints) -> Ints:
    """Return the run (m,) of each triangle: consecutive ones, cut where all edges so far have an even number.

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
    """Return whether no edge has more than two triangles."""
    edges, _ = edges_of(corners)
    keys = np.sort(edges[:, 0] * (int(corners.max(initial=0)) + 1) + edges[:, 1])
    return not (keys[2:] == keys[:-2]).any()


def components_by_edges(points: Floats, corners: Ints, inward: bool) -> Ints:
    """Return the component (m,) of each triangle, connected across edges only.

    Where more than two triangles meet in an edge, each goes with the next one around the edge through the solid,
    so that solids which touch in an edge or a wall come apart. inward: the windings are turned inside out.
    """
    edges, forward = edges_of(corners)
    face = np.tile(np.arange(len(corners)), 3)
    ids, first = row_ids(*edges.T)
    if np.bincount(ids).max(initial=0) <= 2:  # then angles decide nothing
        return number_by_occurrence(component_roots(face[first][ids], face, len(corners)))
    angle = _angles_around_edges(points, corners, edges, first[ids])
    begins = forward == inward  # going around the edge, the solid begins at this triangle
    order = np.lexsort((begins, np.round(angle / _TURN), ids))
    starts = np.searchsorted(ids[order], np.arange(len(first)))
    following = np.append(order[1:], order[0])
    following[np.append(starts[1:], len(order)) - 1] = order[starts]
    joined = (np.bincount(ids)[ids[order]] == 2) | (begins[order] & ~begins[following])
    return number_by_occurrence(component_roots(face[order[joined]], face[following[joined]], len(corners)))


def _angles_around_edges(points: Floats, corners: Ints, edges: Ints, reference: Ints) -> Floats:
    """The angle (3m,) of each triangle around each of its edges, from that of another triangle there, in 0..2 pi."""
    opposite = np.concatenate([corners[:, 2], corners[:, 0], corners[:, 1]])
    low, high = points[edges[:, 0]], points[edges[:, 1]]
    axis = high - low
    axis = axis / np.maximum(np.linalg.norm(axis, axis=1, keepdims=True), np.finfo(float).tiny)
    out = points[opposite] - low
    out = out - np.einsum("ij,ij->i", out, axis)[:, None] * axis
    x = out[reference]
    turn = np.arctan2(np.einsum("ij,ij->i", out, cross(axis, x)), np.einsum("ij,ij->i", out, x))
    turn = np.where(turn < 0, turn + 2 * np.pi, turn)
    return np.where(turn > 2 * np.pi - _TURN, 0.0, turn)
