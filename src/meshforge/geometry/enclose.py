"""Simpler convex hulls around a convex hull: fewer vertices, nothing of the old one left outside."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.contract import contracted
from meshforge.geometry.convex import convex_hull, principal_extents
from meshforge.geometry.heights import planes_of
from meshforge.geometry.nearest import nearest_on_triangles
from meshforge.geometry.polygons import polygon_sizes
from meshforge.geometry.shapes import Polytope

_SAME = 1e-9  # corners and planes nearer than this, where the hull is one long, wide and high, are one
_TRIES = 12  # farthest corners that are tried before no further plane counts as fitting the budget
_MOST = 2000  # planes, where a budget knows no end
_ROUNDS = 150  # vertices that contracting takes away, at 10 to 25 ms each; from twice the budget at most
_GROWTH = (0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5)  # of planes outwards, in turn, against rounding; shares of the size


@dataclass(frozen=True, slots=True)
class Budget:
    """The most that a hull may have: vertices, flat faces, and vertices on one flat face."""

    vertices: float = inf
    polygons: float = inf
    polygon_vertices: float = inf


@dataclass(frozen=True, eq=False, slots=True)
class Enclosure:
    """A hull around another; error: the Hausdorff distance [m], how far the new one sticks out of the old one."""

    hull: Polytope
    error: float


def enclosing(hull: Polytope, budget: Budget) -> Enclosure | None:
    """A convex hull within a budget that holds all of another hull and sticks out little; None where none was found.

    Found in two ways, of which the better one counts: planes around the hull, more and more of them; and edges
    contracted outwards, fewer and fewer of them, of the hull itself or, where that has very many, of planes around it.
    """
    found = [made for made in (_within_planes(hull, budget), _of_fewer_edges(hull, budget)) if made]
    return min(found, key=lambda made: made.error, default=None)


def _within_planes(hull: Polytope, budget: Budget) -> Enclosure | None:
    """From a box around the hull, the farthest corner is cut off again and again by the plane that supports the hull
    below it, as long as the budget holds (a sandwich algorithm, as of Kamenev, 1992): the error falls about as one
    over the number of planes, which no other placement beats by more than a factor.
    """
    if budget.vertices < 8 or budget.polygons < 6 or budget.polygon_vertices < 4:
        return None  # a box has more
    middle, axes, extents = principal_extents(hull.vertices)
    old = (hull.vertices - middle) @ axes.T
    search = _Search(old, hull.faces, extents, budget)
    search.run()
    while True:
        for growth in _GROWTH:
            if made := _around(hull, search.corners(growth) @ axes + middle, budget):
                return made
        if not search.undo():
            return None


def _of_fewer_edges(hull: Polytope, budget: Budget) -> Enclosure | None:
    """Edges contracted outwards until the budget is kept to; in the hull's own size, against rounding."""
    most = min(budget.vertices, budget.polygons)  # more can be, where many edges meet in few vertices
    start: Polytope | None = hull
    if len(hull.vertices) > most + min(most, _ROUNDS):
        nearer = _within_planes(hull, Budget(most + min(most, _ROUNDS)))
        start = nearer.hull if nearer else None
    if start is None:
        return None
    middle, size = hull.vertices.mean(axis=0), float(np.ptp(hull.vertices, axis=0).max())
    goal = ((hull.vertices - middle) / size)[hull.faces]

    def are_few(points: Floats) -> bool:
        made = _made(points) if len(points) <= budget.vertices else None
        return made is not None and _fits(made, budget)

    corners = contracted((start.vertices - middle) / size, goal, are_few)
    if corners is None:
        return None
    tries = (_around(hull, corners * (1 + growth) * size + middle, budget) for growth in _GROWTH)
    return next((made for made in tries if made), None)


def _around(hull: Polytope, corners: Floats, budget: Budget) -> Enclosure | None:
    """The hull of corners, where it holds another one and keeps to a budget."""
    made = _made(corners)
    if made is None or not _holds(made, hull.vertices) or not _fits(made, budget):
        return None
    return Enclosure(made, float(_gaps(made.vertices, hull.vertices[hull.faces]).max()))


def _made(corners: Floats) -> Polytope | None:
    try:
        return convex_hull(corners, name="a simpler hull")
    except GeometryError:
        return None


def _fits(hull: Polytope, budget: Budget) -> bool:
    """Whether the hull keeps to the budget, as counted on it: rounding may break a flat face in two."""
    sizes = polygon_sizes(hull)
    few = len(hull.vertices) <= budget.vertices and len(sizes) <= budget.polygons
    return few and max(sizes) <= budget.polygon_vertices


def _holds(hull: Polytope, points: Floats) -> bool:
    """Whether a hull holds all points (n, 3), but for the rounding of its own planes."""
    planes = planes_of(hull.vertices, hull.faces)
    rounding = 16 * np.finfo(float).eps * float(np.abs(hull.vertices).max())
    return bool(((points - planes.middle) @ planes.normals.T <= planes.offsets + rounding).all())


def _nearest(points: Floats, triangles: Floats) -> Floats:
    """The nearest point (n, 3) on a convex surface to each of points (n, 3) outside; triangles: (m, 3, 3)."""
    found = np.empty_like(points)
    for k, point in enumerate(points):
        places = nearest_on_triangles(np.broadcast_to(point, (len(triangles), 3)), triangles)
        found[k] = places[np.linalg.norm(places - point, axis=1).argmin()]
    return found


def _gaps(points: Floats, triangles: Floats) -> Floats:
    gaps: Floats = np.linalg.norm(points - _nearest(points, triangles), axis=1)
    return gaps


@dataclass(slots=True, eq=False)
class _Search:
    """Planes around a hull, more and more of them; all in the principal frame of the hull.

    normals: (k, 3), of unit length; offsets: (k,); places: the nearest point of the hull to corners met so far.
    """

    old: Floats
    faces: Ints
    extents: Floats
    budget: Budget
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
            order = [k for k in np.argsort(-gaps, kind="stable")[:_TRIES] if gaps[k] > least]
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
        from scipy.spatial import HalfspaceIntersection

        slopes = self.normals * self.extents
        lengths = np.linalg.norm(slopes, axis=1)
        inner = self.old.mean(axis=0) / self.extents
        rows = np.column_stack([slopes / lengths[:, None], -self.offsets / lengths - growth])
        met = HalfspaceIntersection(rows, inner).intersections
        _, first = np.unique(np.round(met / _SAME), axis=0, return_index=True)
        return np.asarray(met[np.sort(first)] * self.extents)

    def _nearest_below(self, corners: Floats) -> Floats:
        """The nearest point (n, 3) of the hull to each corner."""
        keys = [key.tobytes() for key in np.round(corners / self.extents / _SAME)]
        new = [k for k, key in enumerate(keys) if key not in self.places]
        for k, place in zip(new, _nearest(corners[new], self.old[self.faces]), strict=True):
            self.places[keys[k]] = place
        return np.array([self.places[key] for key in keys])
