"""Fewer vertices around a convex hull, by contracting its edges outwards."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.nearest import nearest_on_triangles

_TRIED = 8  # edges of which the contraction is worked out in each round, those that promise to add least


def contracted(vertices: Floats, goal: Floats, are_few: Callable[[Floats], bool]) -> Floats | None:
    """Few points (m, 3) whose hull holds that of vertices (n, 3); None where they never become few enough.

    Again and again one edge becomes one point outside of all faces that meet it, where that adds the least volume
    (progressive hulls, as of Sander et al., 2000); of the edges that which leads away least from the triangles of
    `goal` (k, 3, 3).
    """
    from scipy.spatial import ConvexHull, QhullError

    points = vertices
    try:
        while True:
            hull = ConvexHull(points)
            kept = np.asarray(hull.vertices)
            if are_few(points[kept]):
                return points[kept]
            places = _places(points, np.asarray(hull.simplices), hull.equations)
            found = [(_distance(place, goal), edge, place) for edge, place in places]
            if not found:
                return None
            _, edge, place = min(found, key=lambda one: one[0])
            points = np.vstack([points[np.setdiff1d(kept, edge)], place])
    except QhullError:
        return None


def _places(points: Floats, faces: Ints, planes: Floats) -> Iterator[tuple[Ints, Floats]]:
    """Some edges, with the point that each may become. planes: (m, 4), a face's outward normal and minus its offset."""
    from scipy.optimize import linprog

    edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
    corners = points[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    for edge in edges[np.argsort(_depths(points, faces, planes, edges), kind="stable")[:_TRIED]]:
        about = np.isin(faces, edge).any(axis=1)
        normals, offsets = planes[about, :3], -planes[about, 3]
        answer = linprog(areas[about] @ normals, A_ub=-normals, b_ub=-offsets, bounds=(None, None), method="highs")
        if answer.status == 0:
            yield edge, np.asarray(answer.x)


def _depths(points: Floats, faces: Ints, planes: Floats, edges: Ints) -> Floats:
    """How deep an end of each edge lies below some face that meets the other end; the less of both ends."""
    order = np.argsort(faces.ravel(), kind="stable")
    meeting, degrees = order // 3, np.bincount(faces.ravel(), minlength=len(points))
    starts = np.cumsum(degrees) - degrees
    found = []
    for end, other in (edges.T, edges[:, ::-1].T):
        counts = degrees[other]
        firsts = np.cumsum(counts) - counts
        near = meeting[np.arange(counts.sum()) + np.repeat(starts[other] - firsts, counts)]
        below = -(points[np.repeat(end, counts)] * planes[near, :3]).sum(axis=1) - planes[near, 3]
        found.append(np.maximum.reduceat(below, firsts))
    return np.minimum(*found)


def _distance(point: Floats, triangles: Floats) -> float:
    places = nearest_on_triangles(np.broadcast_to(point, (len(triangles), 3)), triangles)
    return float(np.linalg.norm(places - point, axis=1).min())
