"""What limits of engines count or measure of a hull."""

from __future__ import annotations

import numpy as np

from meshforge.checks.extents import extents
from meshforge.geometry import LEVEL, Polytope, neighbours, normals_of, polygon_sizes


def vertices(hull: Polytope) -> float:
    """The number of vertices."""
    return len(hull.vertices)


def polygons(hull: Polytope) -> float:
    """The number of flat faces."""
    return len(polygon_sizes(hull))


def largest_polygon(hull: Polytope) -> float:
    """The number of vertices on the flat face that has most."""
    return max(polygon_sizes(hull))


def polygons_at_a_vertex(hull: Polytope) -> float:
    """The number of flat faces that meet at the vertex where most do."""
    pairs = neighbours(hull.faces)
    normals = normals_of(hull)
    bent = np.linalg.norm(np.cross(normals[pairs[:, 0]], normals[pairs[:, 1]]), axis=1) > LEVEL
    edges = [np.intersect1d(hull.faces[i], hull.faces[j]) for i, j in pairs[bent]]
    return int(np.bincount(np.concatenate(edges)).max()) if edges else 0


def thickness(hull: Polytope) -> float:
    """The shortest side of a small box around the hull [m]."""
    return float(extents(hull.vertices)[2])


def volume(hull: Polytope) -> float:
    """The volume [m^3]."""
    return hull.volume


def slenderness(hull: Polytope) -> float:
    """The largest extent, as a multiple of the diameter of the sphere about the centre of mass that fits into it."""
    normals = normals_of(hull)
    heights = np.einsum("ij,ij->i", hull.vertices[hull.faces[:, 0]] - hull.centroid, normals)
    inner = float(heights[np.linalg.norm(normals, axis=1) > 0.5].min())
    return float(extents(hull.vertices)[0]) / max(2 * inner, np.finfo(float).tiny)
