"""Simpler convex hulls around a convex hull: fewer vertices and faces, and nothing of the old hull left outside."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from math import inf

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import minimax
from meshforge.geometry.arrays import Floats, Ints, nearest_on_triangles
from meshforge.geometry.convex import convex_hull, principal_extents
from meshforge.geometry.flat_faces import flatten_faces
from meshforge.geometry.shape import Polytope
from meshforge.geometry.surface import planes_of, polygon_sizes

_SAME = 1e-9  # corners and planes nearer than this, where the hull is one long, wide and high, are one
_CORNERS_TRIED = 12  # farthest corners that are tried before no further plane counts as fitting the budget
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
    """From a box around the hull, the farthest corner is cut off again and again by the plane that supports the hull
    below it, as long as the budget holds (a sandwich algorithm, see Kamenev, 1992); then all planes turn.
    """
    if budget.vertices < 8 or budget.polygons < 6 or budget.polygon_vertices < 4:
        return None  # a box has more
    middle, principal, extents = principal_extents(hull.vertices)
    found = []
    for axes, sides in ((principal, extents), (np.eye(3), np.ptp(hull.vertices, axis=0))):
        search = _PlaneSearch((hull.vertices - middle) @ axes.T, hull.faces, sides, budget)
        search.run()
        normals = search.normals @ axes
        turned = _check_improved(hull, partial(minimax.turn_planes, normals, hull), budget)
        found += [turned] if turned else []
    if found:
        return min(found, key=lambda made: made.error)
    while True:
        for growth in _GROWTH:
            if made := _check_enclosure(hull, search.corners(growth) @ axes + middle, budget):
                return made
        if not search.undo():
            return None


def _choose_vertices(hull: Polytope, count: int) -> Floats:
    """So many vertices of a hull: from a tetrahedron of its farthest ones on, again and again the one that lies highest
    over the hull of those that were chosen."""
    from scipy.spatial import ConvexHull  # lazy: slow to import, only simplifying needs it

    points = (hull.vertices - hull.vertices.mean(axis=0)) / float(np.ptp(hull.vertices, axis=0).max())
    _, axes, _ = principal_extents(points)
    chosen = list(dict.fromkeys(int(k) for side in (points @ axes.T).T for k in (side.argmin(), side.argmax())))
    while len(chosen) < count:
        planes = ConvexHull(points[chosen]).equations
        heights = (points @ planes[:, :3].T + planes[:, 3]).max(axis=1)
        chosen.append(int(heights.argmax()))
    return hull.vertices[chosen]


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


@dataclass(slots=True, eq=False)
class _PlaneSearch:
    """Planes around a hull, more and more of them; all in the principal frame of the hull.

    normals: (k, 3), of unit length; offsets: (k,); places: the nearest point of the hull to corners met so far.
    """

    old: Floats
    faces: Ints
    extents: Floats
    budget: HullBudget
    normals: Floats = field(init=False)
    offsets: Floats = field(init=False)
    places: dict[bytes, Floats] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.normals = np.concatenate([np.eye(3), -np.eye(3)])
        self.offsets = (self.old @ self.normals.T).max(axis=0)

    def run(self) -> None:
        """Add planes until the budget is used up, or nothing sticks out any more."""
        least = _SAME * float(self.extents.max())
        most = min(self.budget.polygons, 2 * self.budget.vertices - 4, _MOST)  # faces of any polytope, by Euler
        while len(self.normals) < most:
            corners = self.corners()
            away = corners - self._nearest_below(corners)
            gaps = np.linalg.norm(away, axis=1)
            order = [k for k in np.argsort(-gaps, kind="stable")[:_CORNERS_TRIED] if gaps[k] > least]
            if not any(self._cut(corners[k], away[k] / gaps[k]) for k in order):
                return

    def undo(self) -> bool:
        """Take the last plane away; False where only the box is left."""
        if len(self.normals) <= 6:
            return False
        self.normals, self.offsets = self.normals[:-1], self.offsets[:-1]
        return True

    def _cut(self, corner: Floats, normal: Floats) -> bool:
        """Add the plane that supports the hull in a direction, if it cuts a corner off, and the budget allows it.

        Where the nearest point is known to a few digits only, the plane may leave the corner as it is.
        """
        before, offset = (self.normals, self.offsets), float((self.old @ normal).max())
        if corner @ normal - offset <= _SAME * float(self.extents.max()) / 2:
            return False
        self.normals = np.vstack([self.normals, normal])
        self.offsets = np.append(self.offsets, offset)
        if self._fits_budget():
            return True
        self.normals, self.offsets = before
        return False

    def _fits_budget(self) -> bool:
        corners = self.corners() / self.extents
        if len(corners) > self.budget.vertices:
            return False
        slopes = self.normals * self.extents
        heights = corners @ slopes.T - self.offsets
        on = np.abs(heights) <= 1e-7 * np.linalg.norm(slopes, axis=1)
        return bool(on.sum(axis=0).max() <= self.budget.polygon_vertices)

    def corners(self, growth: float = 0.0) -> Floats:
        """The corners (n, 3) of what all planes enclose, these moved outwards by a share of the hull's extent."""
        from scipy.spatial import HalfspaceIntersection  # lazy: slow to import, only simplifying needs it

        slopes = self.normals * self.extents
        lengths = np.linalg.norm(slopes, axis=1)
        inner = self.old.mean(axis=0) / self.extents
        rows = np.column_stack([slopes / lengths[:, None], -self.offsets / lengths - growth])
        corners = HalfspaceIntersection(rows, inner).intersections
        _, first = np.unique(np.round(corners / _SAME), axis=0, return_index=True)
        return np.asarray(corners[np.sort(first)] * self.extents)

    def _nearest_below(self, corners: Floats) -> Floats:
        keys = [key.tobytes() for key in np.round(corners / self.extents / _SAME)]
        new = [k for k, key in enumerate(keys) if key not in self.places]
        for k, place in zip(new, _nearest_on_surface(corners[new], self.old[self.faces]), strict=True):
            self.places[keys[k]] = place
        return np.array([self.places[key] for key in keys])
