"""The hulls of a family that look like one that a person split, split likewise: the plane or the parts are carried over
by the boxes around both hulls."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations, product

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import Floats, Polytope, Shape, convex_hull, cut
from meshforge.geometry.solids import intersect
from meshforge.label_model import FamilyTable, ShapeDescriptor
from meshforge.label_model.describe import describe_mesh
from meshforge.symbolic import SymbolicMesh

_WEIGHTS = np.array([-0.053, -2.073, -1.599])
"""Of one, and of the logarithms below; fitted on the calibration assets of the benchmark, see decision 0042."""
_LEAST_MISFIT = 0.02  # differences below count as none
_MOST = 16.0  # the distance of a look-alike, at most
_KEEPS_SIDES = 0.02  # how much better a turned or mirrored box must fit
_SIZES = 0.25  # what a difference in proportions counts beside one in shape
_LEAST = 0.01  # of the hull's volume, a part has at least
_SIDES = np.array([side for side in product((-1.0, 0.0, 1.0), repeat=3) if any(side)])
_SIDES /= np.linalg.norm(_SIDES, axis=1)[:, None]
_TURNS = np.array(
    [np.eye(3)[list(order)] * signs for order in permutations(range(3)) for signs in product((1.0, -1.0), repeat=3)]
)
"""The ways (48, 3, 3) in which a box can be turned and mirrored onto itself, first as it is."""


@dataclass(frozen=True, eq=False, slots=True)
class SplitExample:
    """A split that a person made. asset, hull: names; mesh: the asset before it; parts: what was made of the hull;
    plane: a point and a normal (2, 3) where it was cut along one, None for another split. In the frame of the file.
    """

    asset: str
    hull: str
    mesh: SymbolicMesh
    parts: tuple[Polytope, ...]
    plane: Floats | None = None


@dataclass(frozen=True, eq=False, slots=True)
class SplitProposal:
    """A look-alike split likewise. chance: that it is to be split so; parts: in the order of those that were shown."""

    asset: str
    hull: str
    chance: float
    parts: tuple[Polytope, ...]


class SplitLookalikes:
    """Finds look-alikes of hulls that were split among the meshes of a family, by name."""

    def __init__(self, meshes: Mapping[str, SymbolicMesh]) -> None:
        self._meshes = {name: mesh for name, mesh in meshes.items() if mesh.hulls}

    @cached_property
    def _described(self) -> dict[str, ShapeDescriptor]:
        return {name: describe_mesh(mesh) for name, mesh in self._meshes.items()}

    def find(self, example: SplitExample) -> Iterator[SplitProposal]:
        """The hulls of other assets that look more like the hull than like others of its asset, split likewise."""
        for asset, place, evidence, parts in self.compare(example):
            chance = float(1 / (1 + np.exp(-(evidence @ _WEIGHTS))))
            yield SplitProposal(asset, self._meshes[asset].hulls[place].name, chance, parts)

    def compare(self, example: SplitExample) -> Iterator[tuple[str, int, Floats, tuple[Polytope, ...]]]:
        """Asset, place of the hull, what its chance is made from (3,), and parts."""
        from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

        home = describe_mesh(example.mesh)
        others = {name: own for name, own in self._described.items() if name != example.asset}
        table = FamilyTable.of([(one.rows, one.touching) for one in (home, *others.values())])
        rows = table.rows * table.metric
        own = rows[: len(home.rows)]
        hull = example.mesh.index[example.hull]
        start = len(home.rows)
        for asset, one in others.items():
            gaps = cdist(rows[start : start + len(one.rows)], own, "cityblock")
            start += len(one.rows)
            for place in np.flatnonzero((gaps.argmin(axis=1) == hull) & (gaps[:, hull] <= _MOST)).tolist():
                made = split_likewise(example, self._meshes[asset].hulls[place].shape)
                if made:
                    parts, misfit = made
                    evidence = np.array([1.0, np.log1p(gaps[place, hull]), np.log(misfit + _LEAST_MISFIT)])
                    yield asset, place, evidence, parts


def split_likewise(example: SplitExample, shape: Shape) -> tuple[tuple[Polytope, ...], float] | None:
    """The parts of a shape that is split as a hull was, and how differently both fill their boxes, from 0 on.

    None where it cannot be split so.
    """
    whole, other = example.mesh.hull_of(example.hull).shape.tessellate(), shape.tessellate()
    box, there = _box_of(whole), _box_of(other)
    turn, misfit = _choose_turn(whole, other)
    # there_T_here, an affinity
    linear = there[1][:, None] * turn / box[1][None, :]
    offset = there[0] - linear @ box[0]
    try:
        if example.plane is not None:
            point, normal = example.plane
            parts: tuple[Polytope | None, ...] = cut(shape, linear @ point + offset, np.linalg.inv(linear).T @ normal)
        else:
            moved = [convex_hull(part.vertices @ linear.T + offset) for part in example.parts]
            parts = tuple(intersect(shape, one) for one in moved)
    except GeometryError:
        return None
    found = [part for part in parts if part is not None and part.volume >= _LEAST * other.volume]
    return (tuple(found), misfit) if len(found) == len(example.parts) else None


def _box_of(shape: Polytope) -> tuple[Floats, Floats]:
    """The middle (3,) [m] and half the sizes (3,) [m] of the box around a shape; a flat one has a thin box."""
    box = shape.aabb
    half = (box.max - box.min) / 2
    return (box.min + box.max) / 2, np.maximum(half, 1e-6 * max(float(half.max()), 1e-300))


def _choose_turn(whole: Polytope, other: Polytope) -> tuple[Floats, float]:
    """How the box around a shape lies best on that around another, and how far the shapes differ then."""
    (middle, half), (there, size) = _box_of(whole), _box_of(other)
    points, wanted = (whole.vertices - middle) / half, (other.vertices - there) / size
    reach = (wanted @ _SIDES.T).max(axis=0)
    turned = (np.einsum("tij,nj->tni", _TURNS, points) @ _SIDES.T).max(axis=1)
    shape = np.abs(turned - reach).mean(axis=1)
    ratios = np.log(size)[None, :] - np.abs(_TURNS) @ np.log(half)
    sizes = np.abs(ratios - ratios.mean(axis=1, keepdims=True)).mean(axis=1)
    misfit = shape + _SIZES * sizes
    best = int(np.round(misfit + np.where(np.arange(len(_TURNS)) == 0, 0.0, _KEEPS_SIDES), 9).argmin())
    return _TURNS[best], float(misfit[best])
