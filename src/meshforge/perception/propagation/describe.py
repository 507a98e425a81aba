"""Hulls described so that the same part of another asset is described alike: a row of numbers for each."""

from __future__ import annotations

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats
from meshforge.perception.propagation import shape, surroundings
from meshforge.perception.propagation.shape import shapes
from meshforge.perception.propagation.surroundings import whole_of
from meshforge.perception.propagation.ties import EQUAL, shared_ranks
from meshforge.perception.propagation.upright import standing
from meshforge.symbolic import SymbolicMesh

_LOOK = slice(0, 6)  # of the columns of `shapes`, those by which hulls of one mesh look alike
_ALIKE = 0.4  # how far apart these are where two hulls look half alike
COUNTED = 6
WIDTH = surroundings.WIDTH + 3 * shape.WIDTH + COUNTED
"""Columns of `described`."""
SHAPES = slice(surroundings.WIDTH, surroundings.WIDTH + shape.WIDTH)
"""Those of them that tell what a hull is itself."""


class Describer:
    """A mesh that has hulls, to be described with one direction or another as the one that points up."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._volumes = np.array([hull.volume for hull in mesh.hulls])
        triangles = tuple(hull.vertices[hull.faces] for hull in mesh.hulls)
        self._whole = whole_of(tuple(hull.vertices for hull in mesh.hulls), triangles)
        self._touching = _touching(mesh)

    def describe_shapes(self, up: Floats) -> Floats:
        """What each hull is itself, and how it lies: `SHAPES` of its row, which is quick. up: (3,)."""
        return shapes(self._whole.rotate(standing(up)), self._volumes)

    def describe(self, up: Floats) -> Floats:
        """A row for each hull (n, WIDTH). up: (3,).

        What is around it, what it is itself, how the hulls that it touches differ from it (the mean, and the largest),
        and how many there are of what. Neither place nor size nor yaw of the mesh changes it, and a tilt hardly.
        """
        whole = self._whole.rotate(standing(up))
        own = shapes(whole, self._volumes)
        touching = self._touching
        around = touching * np.sqrt(np.maximum(self._volumes, 0.0))
        total = around.sum(axis=1, keepdims=True)
        mean = np.divide(around @ own, total, out=own.copy(), where=total > 0)
        most = around >= around.max(axis=1, keepdims=True) * (1 - EQUAL)
        largest = np.where(total > 0, most / most.sum(axis=1, keepdims=True) @ own, own)
        counts = _counts(own, touching, self._volumes)
        return np.concatenate([surroundings.surroundings(whole), own, mean - own, largest - own, counts], axis=1)


def _touching(mesh: SymbolicMesh) -> Floats:
    """Which hulls touch, as a symmetric matrix of 0 and 1 (n, n)."""
    touching = np.zeros((len(mesh.hulls), len(mesh.hulls)))
    for a, b in mesh.contacts:
        touching[a, b] = touching[b, a] = 1.0
    return touching


def _counts(own: Floats, touching: Floats, volumes: Floats) -> Floats:
    """How many hulls look alike, touch, and are there; the share of the volume, of the largest, and the rank."""
    count = len(own)
    look = own[:, _LOOK]
    alike = np.exp(-cdist(look, look, "sqeuclidean") / _ALIKE**2).sum(axis=1) - 1
    shares = np.maximum(volumes, 1e-12 * volumes.max() + 1e-300)
    rank = shared_ranks(volumes) / max(1, count - 1)
    columns = [
        np.log1p(alike),
        np.log1p(touching.sum(axis=1)),
        np.full(count, np.log(count)),
        np.log(shares / shares.max()),
        np.log(shares / shares.sum()),
        rank,
    ]
    return np.stack(columns, axis=1)
