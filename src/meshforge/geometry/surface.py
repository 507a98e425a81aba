"""Properties of triangle surfaces: closed, convex, facing outwards, planes of faces, flat polygons."""

from dataclasses import dataclass

import numpy as np

from meshforge.geometry.arrays import Floats, Ints, cross, distinct
from meshforge.geometry.connectivity import edges_of
from meshforge.geometry.shape import Polytope, Shape

_MOST_PAIRS_CHECKED = 50_000_000  # vertices times faces
_MOST_PAIRS_AT_ONCE = 1_000_000  # points times planes; beyond, most are ruled out by the boxes of groups of points
_GROUP = 128

LEVEL = 1e-5
"""Neighbouring triangles that are bent by no more than this [rad] lie in one plane."""


def is_closed(faces: Ints) -> bool:
    """Return whether every edge of faces (m, 3) lies in exactly two of them, once in each sense."""
    if len(faces) == 0:
        return False
    along, against = _number_edges(faces)
    return bool((along[1:] > along[:-1]).all() and (along == against).all())


def has_border(faces: Ints) -> bool:
    """Return whether an edge of faces (m, 3) lies in more of them in one sense than in the other."""
    return not np.array_equal(*_number_edges(faces))


def _number_edges(faces: Ints) -> tuple[Ints, Ints]:
    """A number for each edge of faces (m, 3) in its sense (3m,), and one in the other, each in order."""
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    count = int(faces.max(initial=0)) + 1
    return np.sort(start * count + end), np.sort(end * count + start)


def is_convex_hull(vertices: Floats, faces: Ints, tolerance: float) -> bool:
    """Return whether faces (m, 3) are closed, face outwards and are convex: `is_closed`, `is_outward`, `is_convex`."""
    if not is_closed(faces):
        return False
    planes = planes_of(vertices, faces)
    if not (planes.offsets > 0).all():
        return False
    if len(vertices) * len(faces) > _MOST_PAIRS_CHECKED:
        return is_convex(vertices, faces, tolerance)
    return not _rises_above_planes(vertices, planes, tolerance * _size(vertices))


def is_convex(vertices: Floats, faces: Ints, tolerance: float = 1e-9) -> bool:
    """Return whether no vertex lies outside any face plane by more than `tolerance` times the size.

    The plane of a needle, which is noise, is left out: its neighbours bound the shape there. Of a surface with very
    many faces each is compared with its neighbours only: a closed surface like a sphere that bends outward at every
    edge is convex (Tietze, Nakajima), and all pairs would take minutes.
    """
    if len(vertices) * len(faces) <= _MOST_PAIRS_CHECKED or not is_closed(faces):
        return not rises_above(vertices, vertices, faces, tolerance * _size(vertices))
    is_sphere = len(distinct(faces)) - len(faces) // 2 == 2
    return is_sphere and _highest_neighbour(vertices, faces) <= tolerance * _size(vertices)


def neighbour_faces(faces: Ints) -> Ints:
    """Return the pairs (k, 2) of faces (m, 3) that share an edge."""
    edges, _ = edges_of(faces)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    owners = np.tile(np.arange(len(faces)), 3)[order]
    same = (edges[order][1:] == edges[order][:-1]).all(axis=1)
    return np.column_stack([owners[:-1][same], owners[1:][same]])


def _highest_neighbour(vertices: Floats, faces: Ints) -> float:
    """How far [m] any corner lies above the plane of a face that shares an edge with its own."""
    planes = planes_of(vertices, faces)
    place = np.full(len(faces), -1)
    place[planes.face_indices] = np.arange(len(planes.face_indices))
    pairs = neighbour_faces(faces)
    pairs = np.concatenate([pairs, pairs[:, ::-1]])
    pairs = pairs[place[pairs[:, 0]] >= 0]
    plane = place[pairs[:, 0]]
    corners = vertices[faces[pairs[:, 1]]] - planes.middle
    heights = np.einsum("ij,ikj->ik", planes.normals[plane], corners) - planes.offsets[plane, None]
    return float(heights.max(initial=-np.inf))


def is_outward(vertices: Floats, faces: Ints) -> bool:
    """Return whether the faces (m, 3) of a convex surface all face outwards: none faces its middle."""
    return bool((planes_of(vertices, faces).offsets > 0).all())


def lowest_altitudes(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """Return the lowest altitude (m,) [m] of each triangle, and which corner (m,) it stands on."""
    corners = vertices[faces]
    sides = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]  # the side opposite to each corner
    lengths = np.linalg.norm(sides, axis=2)
    double_areas = np.linalg.norm(cross(sides[:, 0], sides[:, 1]), axis=1)
    apex = np.argmax(lengths, axis=1)
    return double_areas / np.maximum(lengths[np.arange(len(faces)), apex], np.finfo(float).tiny), apex


def _size(vertices: Floats) -> float:
    return float(np.ptp(vertices, axis=0).max())


@dataclass(frozen=True, eq=False, slots=True)
class Planes:
    """Planes of faces: unit normals (k, 3), offsets (k,) from the middle (3,), and the numbers (k,) of the faces."""

    normals: Floats
    offsets: Floats
    middle: Floats
    face_indices: Ints


def planes_of(vertices: Floats, faces: Ints) -> Planes:
    """Return the planes of the faces (m, 3) that are no needles: of these the plane is noise."""
    middle = vertices.mean(axis=0)
    around = vertices - middle
    a, b, c = (around[faces[:, k]] for k in range(3))
    normals = cross(b - a, c - a)
    lengths = np.sqrt(np.einsum("ij,ij->i", normals, normals))
    kept = np.flatnonzero(lengths > 1e-10 * _size(vertices) ** 2)
    normals = normals[kept] / lengths[kept, None]
    return Planes(normals, np.einsum("ij,ij->i", normals, a[kept]), middle, kept)


def rises_above(points: Floats, vertices: Floats, faces: Ints, height: float) -> bool:
    """Return whether any of points (n, 3) lies more than `height` [m] above a face plane of a convex surface."""
    return _rises_above_planes(points, planes_of(vertices, faces), height)


def _rises_above_planes(points: Floats, planes: Planes, height: float) -> bool:
    points = points - planes.middle
    limits = planes.offsets + height
    if len(points) * len(limits) > _MOST_PAIRS_AT_ONCE:
        return _some_group_rises(points, planes.normals, limits)
    return bool((points @ planes.normals.T > limits).any())


def _some_group_rises(points: Floats, normals: Floats, limits: Floats) -> bool:
    """Whether any of many points rises above a plane: by groups that lie together, whose box bounds the reach."""
    from scipy.spatial import cKDTree  # lazy: slow to import, only very large surfaces need it

    slopes = np.abs(normals)
    for group in np.array_split(points[cKDTree(points).indices], len(points) // _GROUP + 1):
        low, high = group.min(axis=0), group.max(axis=0)
        reach = normals @ ((low + high) / 2) + slopes @ ((high - low) / 2)
        near = np.flatnonzero(reach * (1 + 1e-12) > limits)
        if len(near) and (group @ normals[near].T > limits[near]).any():
            return True
    return False


def polygon_sizes(hull: Polytope) -> tuple[int, ...]:
    """Return the number of vertices of each flat polygon of a hull."""
    from scipy.sparse import coo_array  # lazy: slow to import, only engine limits and simplifying need it
    from scipy.sparse.csgraph import connected_components  # lazy: as coo_array

    pairs = neighbour_faces(hull.faces)
    normals = normals_of(hull)
    level = pairs[np.linalg.norm(np.cross(normals[pairs[:, 0]], normals[pairs[:, 1]]), axis=1) <= LEVEL]
    links = coo_array((np.ones(len(level)), (level[:, 0], level[:, 1])), shape=(len(hull.faces),) * 2)
    count, polygon = connected_components(links, directed=False)
    corners = np.unique(np.column_stack([np.repeat(polygon, 3), hull.faces.ravel()]), axis=0)
    return tuple(np.bincount(corners[:, 0], minlength=count).tolist())


def normals_of(hull: Polytope) -> Floats:
    """Return the unit normals (m, 3) of a hull's triangles; of a needle, something shorter."""
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny))


def heights_above(points: Floats, hull: Shape) -> Floats:
    """Return how far (n,) [m] points (n, 3) are above the face of a hull that they are highest above."""
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    normals, a = normals[lengths > 0] / lengths[lengths > 0, None], a[lengths > 0]
    heights: Floats = (points @ normals.T - np.einsum("ij,ij->i", normals, a)).max(axis=1, initial=-np.inf)
    return heights


def sample_surface(vertices: Floats, faces: Ints, count: int) -> tuple[Floats, Ints]:
    """Return points (count, 3) that lie evenly on a surface of faces (m, 3), the same every time, and the face of each.

    Of a surface without area they are the first corners of all faces.
    """
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    if not areas.sum() > 0:
        return a, np.arange(len(a))
    chosen = np.searchsorted(np.cumsum(areas) / areas.sum(), (np.arange(count) + 0.5) / count)
    chosen = np.minimum(chosen, len(areas) - 1)
    u, v = np.random.default_rng(0).random((2, count, 1))
    folded = u + v > 1
    u, v = np.where(folded, 1 - u, u), np.where(folded, 1 - v, v)
    points: Floats = a[chosen] + u * (b[chosen] - a[chosen]) + v * (c[chosen] - a[chosen])
    return points, chosen
