"""Hulls described so that the same part of another asset is described alike: a row of numbers for each, that neither
size nor a turn about Z changes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats, Ints
from meshforge.label_model import EQUAL, share_ranks
from meshforge.labels.propagation import surroundings
from meshforge.labels.propagation.surroundings import WholeShape, axes_along, whole_of
from meshforge.labels.propagation.upright import find_other_sides, find_up, rotation_to_z
from meshforge.symbolic import SymbolicMesh

_LEAST = 1e-6  # of the whole's size; what is thinner counts as so thick
SHAPE_WIDTH = 20
"""Columns of `describe_shapes`."""

_LOOK_COLUMNS = slice(0, 6)  # of the columns of `describe_shapes`, those by which hulls of one mesh look alike
_ALIKE = 0.4  # how far apart these are where two hulls look half alike
COUNT_WIDTH = 6
ROW_WIDTH = surroundings.SURROUNDINGS_WIDTH + 3 * SHAPE_WIDTH + COUNT_WIDTH
"""Columns of `described`."""
SHAPE_COLUMNS = slice(surroundings.SURROUNDINGS_WIDTH, surroundings.SURROUNDINGS_WIDTH + SHAPE_WIDTH)
"""Those of them that tell what a hull is itself."""

_SIDES = 5  # on which a mesh may lie, besides the one it seems to lie on


def describe_shapes(whole: WholeShape, volumes: Floats) -> Floats:
    """A row for each hull (n, WIDTH): sizes in logarithms of shares of the whole's, how long, flat and full it is,
    how its axes lie, from where to where it reaches in height and from the upright axis.
    """
    size, corners, counts = whole.size, np.concatenate(whole.pieces), np.array([len(piece) for piece in whole.pieces])
    starts = np.cumsum(counts) - counts
    middle = np.add.reduceat(corners, starts) / counts[:, None]
    offsets = corners - np.repeat(middle, counts, axis=0)
    scatter = np.add.reduceat(offsets[:, :, None] * offsets[:, None, :], starts) / counts[:, None, None]
    values, axes = np.linalg.eigh(scatter)
    spread = np.maximum(2 * np.sqrt(np.maximum(values[:, ::-1], 0.0)), _LEAST * size)
    axes = axes[:, :, ::-1]
    box = spread.prod(axis=1)
    volumes = np.maximum(volumes, 1e-9 * box)
    low, high = np.minimum.reduceat(corners[:, 2], starts), np.maximum.reduceat(corners[:, 2], starts)
    out = np.linalg.norm(corners[:, :2] - whole.axis, axis=1)
    aside = middle[:, :2] - whole.axis
    away = np.linalg.norm(aside, axis=1)
    outward = aside / np.maximum(away, _LEAST * size)[:, None]
    outward = axes_along(np.pad(outward, ((0, 0), (0, 1))), spread, axes)
    upward = axes_along(np.broadcast_to([0.0, 0.0, 1.0], outward.shape), spread, axes)
    return np.column_stack(
        [
            np.log(volumes / size**3) / 3,
            np.log(spread / size),
            np.log(volumes / box) / 3,
            np.log(np.maximum(high - low, _LEAST * size) / size),
            ((low + high) / 2 - whole.foot) / whole.tall,
            away / size,
            upward,
            (spread[:, 0] - spread[:, 1]) / spread[:, 0],
            (spread[:, 1] - spread[:, 2]) / spread[:, 0],
            spread[:, 2] / spread[:, 0],
            (low - whole.foot) / whole.tall,
            (high - whole.foot) / whole.tall,
            np.minimum.reduceat(out, starts) / whole.wide,
            np.maximum.reduceat(out, starts) / whole.wide,
            outward[:, 0],
            outward[:, 2],
        ]
    )


class HullDescriber:
    """A mesh that has hulls, to be described with one direction or another as the one that points up."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._volumes = np.array([hull.volume for hull in mesh.hulls])
        triangles = tuple(hull.vertices[hull.faces] for hull in mesh.hulls)
        self._whole = whole_of(tuple(hull.vertices for hull in mesh.hulls), triangles)
        self._touching = _contact_matrix(mesh)

    def describe_shapes(self, up: Floats) -> Floats:
        """What each hull is itself, and how it lies: `SHAPE_COLUMNS` of its row, which is quick. up: (3,)."""
        return describe_shapes(self._whole.rotate(rotation_to_z(up)), self._volumes)

    def describe(self, up: Floats) -> Floats:
        """A row for each hull (n, WIDTH). up: (3,).

        What is around it, what it is itself, how the hulls that it touches differ from it (the mean, and the largest),
        and how many there are of what. Neither place nor size nor yaw of the mesh changes it, and a tilt hardly.
        """
        whole = self._whole.rotate(rotation_to_z(up))
        own = describe_shapes(whole, self._volumes)
        touching = self._touching
        around = touching * np.sqrt(np.maximum(self._volumes, 0.0))
        total = around.sum(axis=1, keepdims=True)
        mean = np.divide(around @ own, total, out=own.copy(), where=total > 0)
        most = around >= around.max(axis=1, keepdims=True) * (1 - EQUAL)
        largest = np.where(total > 0, most / most.sum(axis=1, keepdims=True) @ own, own)
        counts = _describe_counts(own, touching, self._volumes)
        return np.concatenate(
            [surroundings.describe_surroundings(whole), own, mean - own, largest - own, counts], axis=1
        )


def _contact_matrix(mesh: SymbolicMesh) -> Floats:
    """Which hulls touch, as a symmetric matrix of 0 and 1 (n, n)."""
    touching = np.zeros((len(mesh.hulls), len(mesh.hulls)))
    for a, b in mesh.contacts:
        touching[a, b] = touching[b, a] = 1.0
    return touching


def _describe_counts(own: Floats, touching: Floats, volumes: Floats) -> Floats:
    """How many hulls look alike, touch, and are there; the share of the volume, of the largest, and the rank."""
    count = len(own)
    look = own[:, _LOOK_COLUMNS]
    alike = np.exp(-cdist(look, look, "sqeuclidean") / _ALIKE**2).sum(axis=1) - 1
    shares = np.maximum(volumes, 1e-12 * volumes.max() + 1e-300)
    rank = share_ranks(volumes) / max(1, count - 1)
    columns = [
        np.log1p(alike),
        np.log1p(touching.sum(axis=1)),
        np.full(count, np.log(count)),
        np.log(shares / shares.max()),
        np.log(shares / shares.sum()),
        rank,
    ]
    return np.stack(columns, axis=1)


@dataclass(frozen=True, eq=False, slots=True)
class ShapeDescriptor:
    """A mesh as it is described.

    rows: (n, WIDTH), one a hull, with up what seems to be up; touching: pairs (m, 2) of hulls in contact, in order;
    sides: (k, n, columns), `SHAPE_COLUMNS` of the rows if it lay on another side than it seems to.
    """

    rows: Floats
    touching: Ints
    sides: Floats


class MeshDescriber:
    """A mesh to be described, as it seems to stand and on other sides."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._mesh = mesh
        if mesh.hulls:
            self._describer = HullDescriber(mesh)
            self._up = find_up(mesh)
            self._ups = find_other_sides(mesh, self._up, _SIDES)

    def describe(self) -> ShapeDescriptor:
        """The mesh as it seems to stand, and what is quickly told of its other sides."""
        count, columns = len(self._mesh.hulls), SHAPE_COLUMNS.stop - SHAPE_COLUMNS.start
        if not count:
            return ShapeDescriptor(np.zeros((0, ROW_WIDTH)), np.zeros((0, 2), np.int64), np.zeros((0, 0, columns)))
        touching = np.array(sorted(self._mesh.contacts), dtype=np.int64).reshape(-1, 2)
        sides = np.array([self._describer.describe_shapes(up) for up in self._ups]).reshape(-1, count, columns)
        return ShapeDescriptor(self._describer.describe(self._up), touching, sides)

    def describe_side(self, side: int) -> Floats:
        """The rows (n, WIDTH) on one of the sides of the sketch."""
        return self._describer.describe(self._ups[side])
