"""Hulls described so that the same part of another asset is described alike: a row of numbers for each."""

from __future__ import annotations

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats
from meshforge.perception.propagation import shape, surroundings
from meshforge.perception.propagation.shape import shapes
from meshforge.perception.propagation.surroundings import whole_of
from meshforge.perception.propagation.upright import standing, upright
from meshforge.symbolic import SymbolicMesh

_LOOK = slice(0, 6)  # of the columns of `shapes`, those by which hulls of one mesh look alike
_ALIKE = 0.4  # how far apart these are where two hulls look half alike
COUNTED = 6
WIDTH = surroundings.WIDTH + 3 * shape.WIDTH + COUNTED
"""Columns of `described`."""


def described(mesh: SymbolicMesh, up: Floats | None = None) -> Floats:
    """A row for each hull (n, WIDTH). up: the direction that points up, None for what seems to.

    What is around it, what it is itself, how the hulls that it touches differ from it (the mean, and the largest), and
    how many there are of what. Neither place nor size nor yaw of the mesh changes it, and a tilt hardly.
    """
    count = len(mesh.hulls)
    if not count:
        return np.zeros((0, WIDTH))
    turn = standing(upright(mesh) if up is None else up)
    pieces = tuple(hull.vertices @ turn.T for hull in mesh.hulls)
    triangles = tuple(piece[hull.faces] for piece, hull in zip(pieces, mesh.hulls, strict=True))
    volumes = np.array([hull.volume for hull in mesh.hulls])
    whole = whole_of(pieces, triangles)
    own = shapes(whole, volumes)
    touching = _touching(mesh)
    around = touching * np.sqrt(np.maximum(volumes, 0.0))
    total = around.sum(axis=1, keepdims=True)
    mean = np.divide(around @ own, total, out=own.copy(), where=total > 0)
    largest = own[np.where(total[:, 0] > 0, around.argmax(axis=1), np.arange(count))]
    return np.concatenate(
        [surroundings.surroundings(whole), own, mean - own, largest - own, _counts(own, touching, volumes)], axis=1
    )


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
    rank = np.argsort(np.argsort(-volumes, kind="stable"), kind="stable") / max(1, count - 1)
    columns = [
        np.log1p(alike),
        np.log1p(touching.sum(axis=1)),
        np.full(count, np.log(count)),
        np.log(shares / shares.max()),
        np.log(shares / shares.sum()),
        rank,
    ]
    return np.stack(columns, axis=1)
