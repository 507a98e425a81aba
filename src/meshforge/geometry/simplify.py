"""Simpler convex hulls around a convex hull: of few vertices, triangles or flat faces, nothing of it outside."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import inf
from typing import Self

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import minimax
from meshforge.geometry.arrays import Floats, Ints, nearest_on_triangles
from meshforge.geometry.convex import convex_hull, principal_extents
from meshforge.geometry.minimax import InnerHull, LinearProgram, State, descend, of_vectors
from meshforge.geometry.shape import Polytope
from meshforge.geometry.surface import neighbour_faces, normals_of, planes_of, polygon_sizes

_SAME = 1e-9  # corners and planes nearer than this, where the hull is one long, wide and high, are one
_MOST = 2000  # planes, where a budget knows no end
_GROWTH = (0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5)  # of planes outwards, in turn, against rounding; shares of the size


@dataclass(frozen=True, slots=True)
class HullBudget:
    """The most that a hull may have: vertices, flat faces, and vertices on one flat face."""

    vertices: float = inf
    polygons: float = inf
    polygon_vertices: float = inf


@dataclass(frozen=True, eq=False, slots=True)
class Enclosure:
    """A hull around another; error: the Hausdorff distance [m], how far the new one sticks out of the old one."""

    hull: Polytope
    error: float


def enclose(hull: Polytope, budget: HullBudget) -> Enclosure | None:
    """Return a convex hull within a budget that holds all of another and sticks out little; None where none was found.

    Found in three ways, of which the closest counts: planes around the hull, more and more of them, then turned; the
    outermost vertices of the hull, so many that the triangles between them are within the budget, then moved; and,
    where vertices and faces both bind, all vertices that there may be, whose triangles are joined to flat faces.
    """
    if _is_within_budget(hull, budget):
        return Enclosure(hull, 0.0)
    found = [_enclose_by_planes(hull, budget)]
    flat = (budget.polygons + 4) / 2  # so many vertices have no more triangles; more need flat faces of four and more
    if 4 < min(budget.vertices, flat) < len(hull.vertices):
        start = _choose_vertices(hull, int(min(budget.vertices, flat)))
        found.append(_check_improved(hull, partial(minimax.move_vertices, start, hull), budget))
    if flat < budget.vertices < 2 * budget.polygons - 4:  # both numbers bind
        start = _choose_vertices(hull, min(int(budget.vertices), len(hull.vertices)))
        found.append(_check_improved(hull, partial(flatten_faces, start, int(budget.polygons), hull), budget))
    return min((made for made in found if made), key=lambda made: made.error, default=None)


def _check_improved(hull: Polytope, improve: Callable[[], Floats], budget: HullBudget) -> Enclosure | None:
    """What an improvement makes, where it comes to an end and is within the budget."""
    from scipy.spatial import QhullError  # lazy: slow to import, only simplifying needs it

    try:
        corners, middle = improve(), hull.vertices.mean(axis=0)
    except (QhullError, GeometryError, np.linalg.LinAlgError):
        return None
    # grown about the middle of the hull by as little as rounding asks for, to hold it
    tries = (_check_enclosure(hull, middle + (corners - middle) * (1 + growth), budget) for growth in _GROWTH)
    return next((made for made in tries if made), None)


def _enclose_by_planes(hull: Polytope, budget: HullBudget) -> Enclosure | None:
    """Planes of a box around the hull and of its faces, so many that the budget holds; then these, turned."""
    if budget.vertices < 8 or budget.polygons < 6 or budget.polygon_vertices < 4:
        return None  # a box has more
    most = int(min(budget.polygons, budget.vertices / 2 + 2, _MOST))  # so many planes have no more corners, by Euler
    found = list[Enclosure | None]()
    for axes in (principal_extents(hull.vertices)[1], np.eye(3)):
        normals = _choose_planes(hull, axes, most)
        for count in range(len(normals), 5, -1):
            own = normals[:count]
            tries = (_check_enclosure(hull, _cross_planes(hull, own, growth), budget) for growth in _GROWTH)
            if plain := next((made for made in tries if made), None):
                found += [plain, _check_improved(hull, partial(minimax.turn_planes, own, hull), budget)]
                break
    return min((made for made in found if made), key=lambda made: made.error, default=None)


def _choose_planes(hull: Polytope, axes: Floats, count: int) -> Floats:
    """The normals (k, 3) of at most so many planes: of the box along some axes, then of faces of the hull.

    As `_choose_vertices` chooses, of the polar polytope, whose vertices are the planes of the hull.
    """
    points = (hull.vertices - hull.vertices.mean(axis=0)) / float(np.ptp(hull.vertices, axis=0).max())
    normals = np.concatenate([axes, -axes, planes_of(hull.vertices, hull.faces).normals])
    polar = normals / (points @ normals.T).max(axis=0)[:, None]
    return normals[_choose_outermost(polar, list(range(6)), count)]


def _cross_planes(hull: Polytope, normals: Floats, growth: float) -> Floats:
    """The corners (n, 3) of what planes around a hull enclose, these moved outwards by a share of its extents."""
    from scipy.spatial import HalfspaceIntersection  # lazy: slow to import, only simplifying needs it

    middle, axes, extents = principal_extents(hull.vertices)
    slopes = normals @ axes.T * extents
    slopes /= np.linalg.norm(slopes, axis=1, keepdims=True)
    points = (hull.vertices - middle) @ axes.T / extents
    rows = np.column_stack([slopes, -(points @ slopes.T).max(axis=0) - growth])
    corners = HalfspaceIntersection(rows, points.mean(axis=0)).intersections
    _, first = np.unique(np.round(corners / _SAME), axis=0, return_index=True)
    return np.asarray(corners[np.sort(first)] * extents @ axes + middle)


def _choose_vertices(hull: Polytope, count: int) -> Floats:
    """So many vertices of a hull: a tetrahedron of the farthest, then again and again the highest over those chosen."""
    points = (hull.vertices - hull.vertices.mean(axis=0)) / float(np.ptp(hull.vertices, axis=0).max())
    _, axes, _ = principal_extents(points)
    chosen = list(dict.fromkeys(int(k) for side in (points @ axes.T).T for k in (side.argmin(), side.argmax())))
    return hull.vertices[_choose_outermost(points, chosen, count)]


def _choose_outermost(points: Floats, chosen: list[int], count: int) -> list[int]:
    """The numbers of so many points (n, 3): to those chosen, again and again the one highest over their hull."""
    from scipy.spatial import ConvexHull  # lazy: slow to import, only simplifying needs it

    while len(chosen) < count:
        planes = ConvexHull(points[chosen]).equations
        heights = (points @ planes[:, :3].T + planes[:, 3]).max(axis=1)
        if heights.max() <= _SAME:
            break
        chosen.append(int(heights.argmax()))
    return chosen


def _check_enclosure(hull: Polytope, corners: Floats, budget: HullBudget) -> Enclosure | None:
    """The hull of corners, where it holds another hull and is within the budget."""
    try:
        made = convex_hull(corners, name="a simpler hull")
    except GeometryError:
        return None
    planes = planes_of(made.vertices, made.faces)
    rounding = 16 * np.finfo(float).eps * float(np.abs(made.vertices).max())
    holds = ((hull.vertices - planes.middle) @ planes.normals.T <= planes.offsets + rounding).all()
    if not holds or not _is_within_budget(made, budget):
        return None
    away = made.vertices - _nearest_on_surface(made.vertices, hull.vertices[hull.faces])
    return Enclosure(made, float(np.linalg.norm(away, axis=1).max()))


def _is_within_budget(hull: Polytope, budget: HullBudget) -> bool:
    """Whether the hull keeps to the budget, as counted on it: rounding may break a flat face in two."""
    sizes = polygon_sizes(hull)
    few = len(hull.vertices) <= budget.vertices and len(sizes) <= budget.polygons
    return few and max(sizes) <= budget.polygon_vertices


def _nearest_on_surface(points: Floats, triangles: Floats) -> Floats:
    """The nearest point (n, 3) on a convex surface to each of points (n, 3) outside; triangles: (m, 3, 3)."""
    found = np.empty_like(points)
    for k, point in enumerate(points):
        places = nearest_on_triangles(np.broadcast_to(point, (len(triangles), 3)), triangles)
        found[k] = places[np.linalg.norm(places - point, axis=1).argmin()]
    return found


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
