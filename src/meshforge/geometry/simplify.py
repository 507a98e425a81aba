"""Simpler convex hulls around a convex hull: fewer vertices and faces, and nothing of the old hull left outside."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import inf

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import minimax
from meshforge.geometry.arrays import Floats, nearest_on_triangles
from meshforge.geometry.convex import convex_hull, principal_extents
from meshforge.geometry.flat_faces import flatten_faces
from meshforge.geometry.shape import Polytope
from meshforge.geometry.surface import planes_of, polygon_sizes

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
    """Return a convex hull within a budget that holds all of another hull and sticks out little; None where none was
    found.

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
    """So many vertices of a hull: from a tetrahedron of its farthest ones on, again and again the one that lies highest
    over the hull of those that were chosen."""
    points = (hull.vertices - hull.vertices.mean(axis=0)) / float(np.ptp(hull.vertices, axis=0).max())
    _, axes, _ = principal_extents(points)
    chosen = list(dict.fromkeys(int(k) for side in (points @ axes.T).T for k in (side.argmin(), side.argmax())))
    return hull.vertices[_choose_outermost(points, chosen, count)]


def _choose_outermost(points: Floats, chosen: list[int], count: int) -> list[int]:
    """The numbers of so many points (n, 3): to some that are chosen already, again and again the one that lies highest
    over the hull of those."""
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
