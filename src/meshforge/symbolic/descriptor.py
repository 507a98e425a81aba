"""Descriptors of hulls: numbers that neither the size of the mesh nor a turn about the upright axis changes."""

from collections.abc import Sequence
from itertools import product

import numpy as np

from meshforge.geometry import Box, Floats, Ints, Shape
from meshforge.symbolic.mesh import SymbolicMesh

DESCRIPTOR_NAMES = (
    "share of the volume",
    "length",
    "width",
    "thickness",
    "fullness",
    "upright extent",
    "height",
    "distance from the upright axis",
    "contacts",
)
"""What the columns of `descriptors` measure."""

_LEAST = 1e-6  # of the mesh's diagonal; what is thinner counts as so thick
_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))


def descriptors(meshes: Sequence[SymbolicMesh]) -> Floats:
    """Return a row for each hull of each mesh, in order: (hulls, len(DESCRIPTOR_NAMES)).

    Lengths are in diagonals of the mesh, in logarithms where they are sizes; height runs from 0 at the foot of the
    mesh to 1 at its top, along Z.
    """
    hulls = [hull for mesh in meshes for hull in mesh.hulls]
    if not hulls:
        return np.zeros((0, len(DESCRIPTOR_NAMES)))
    owner = np.repeat(np.arange(len(meshes)), [len(mesh.hulls) for mesh in meshes])
    low, high = (np.concatenate([mesh.corners[end] for mesh in meshes]) for end in (0, 1))
    foot, top = _boxes_around(low, high, owner, len(meshes))
    size = np.maximum(np.linalg.norm(top - foot, axis=1), 1e-300)[owner]
    spread = np.maximum(_spreads([_points_of(hull.shape) for hull in hulls]), _LEAST * size[:, None])
    volume = np.maximum([hull.volume for hull in hulls], 1e-9 * spread.prod(axis=1))
    middle, centre = (low + high) / 2, ((foot + top) / 2)[owner]
    tall = np.maximum((top - foot)[owner, 2], _LEAST * size)
    columns = [
        np.log(volume / size**3) / 3,
        *np.log(spread / size[:, None]).T,
        np.log(volume / spread.prod(axis=1)) / 3,
        np.log(np.maximum(high[:, 2] - low[:, 2], _LEAST * size) / size),
        (middle[:, 2] - foot[owner, 2]) / tall,
        np.linalg.norm((middle - centre)[:, :2], axis=1) / size,
        np.log1p([row.bit_count() for mesh in meshes for row in mesh.adjacency]),
    ]
    return np.stack(columns, axis=1)


def _boxes_around(low: Floats, high: Floats, owner: Ints, count: int) -> tuple[Floats, Floats]:
    """The corners (count, 3) of the box around the hulls of each mesh; of a mesh without hulls, the origin."""
    foot, top = np.zeros((count, 3)), np.zeros((count, 3))
    firsts = np.flatnonzero(np.diff(owner, prepend=-1))
    foot[owner[firsts]] = np.minimum.reduceat(low, firsts)
    top[owner[firsts]] = np.maximum.reduceat(high, firsts)
    return foot, top


def _points_of(shape: Shape) -> Floats:
    """Its vertices (n, 3); those of a box without the faces that come with a tessellation, which take most time."""
    return shape.pose.apply(_CORNERS * shape.half) if isinstance(shape, Box) else shape.vertices


def _spreads(pieces: Sequence[Floats]) -> Floats:
    """Twice the standard deviation of the points of each piece along its principal axes, widest first: (n, 3)."""
    starts = np.cumsum([0, *(len(piece) for piece in pieces)])[:-1]
    counts = np.array([len(piece) for piece in pieces])
    points = np.concatenate(pieces)
    points = points - np.repeat(np.add.reduceat(points, starts) / counts[:, None], counts, axis=0)
    products = (points[:, :, None] * points[:, None, :]).reshape(-1, 9)
    scatter = np.add.reduceat(products, starts).reshape(-1, 3, 3) / counts[:, None, None]
    return 2 * np.sqrt(np.maximum(np.linalg.eigvalsh(scatter)[:, ::-1], 0.0))
