"""The flat polygons that the triangles of a hull make up, which is how engines count its faces."""

from __future__ import annotations

import numpy as np

from meshforge.geometry.arrays import Floats
from meshforge.geometry.shapes import Polytope
from meshforge.geometry.surface import neighbours

LEVEL = 1e-5
"""Neighbouring triangles that are bent by no more than this [rad] lie in one plane."""


def polygon_sizes(hull: Polytope) -> tuple[int, ...]:
    """The number of vertices of each flat polygon of a hull."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    pairs = neighbours(hull.faces)
    normals = normals_of(hull)
    bend = np.linalg.norm(np.cross(normals[pairs[:, 0]], normals[pairs[:, 1]]), axis=1)
    level = pairs[bend <= LEVEL]
    links = coo_array((np.ones(len(level)), (level[:, 0], level[:, 1])), shape=(len(hull.faces),) * 2)
    count, polygon = connected_components(links, directed=False)
    corners = np.unique(np.column_stack([np.repeat(polygon, 3), hull.faces.ravel()]), axis=0)
    return tuple(np.bincount(corners[:, 0], minlength=count).tolist())


def normals_of(hull: Polytope) -> Floats:
    """The unit normals (m, 3) of a hull's triangles; of a needle, something shorter."""
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny))
