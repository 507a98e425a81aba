"""What the leaves of extractors select on many meshes at once, by arrays over all hulls side by side."""

from __future__ import annotations

from collections.abc import Sequence
from math import dist

import numpy as np
import numpy.typing as npt

from meshforge.language import DIRECTIONS, SLACK, All, Attach, Base, Geo, Is, length
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.search.leaves import Leaf

Bools = npt.NDArray[np.bool_]


class Hulls:
    """The hulls of several meshes in one row: labels, boxes, contacts; counts: hulls of each mesh.

    Everything is selected exactly as the language does, which tests hold against it.
    """

    __slots__ = ("_contacts", "_high", "_labels", "_low", "_owner", "_slack", "counts", "starts")

    def __init__(self, meshes: Sequence[SymbolicMesh]) -> None:
        self.counts = np.array([len(mesh.hulls) for mesh in meshes], dtype=np.int64)
        self.starts = np.concatenate([[0], np.cumsum(self.counts)]).astype(np.int64)
        self._owner = np.repeat(np.arange(len(meshes)), self.counts)
        none = np.zeros((0, 3))
        self._low = np.concatenate([none, *(mesh.corners[0] for mesh in meshes)])
        self._high = np.concatenate([none, *(mesh.corners[1] for mesh in meshes)])
        self._labels = [hull.label for mesh in meshes for hull in mesh.hulls]
        self._slack = np.array([SLACK * length(mesh) for mesh in meshes])
        pairs = [
            np.array(list(mesh.contacts), dtype=np.int64) + start
            for mesh, start in zip(meshes, self.starts, strict=False)
            if mesh.contacts
        ]
        self._contacts = np.concatenate(pairs) if pairs else np.zeros((0, 2), dtype=np.int64)

    def table(self, leaves: Sequence[Leaf], extremity: float) -> Bools:
        """Whether each leaf selects each hull: (leaves, hulls)."""
        bases = self._base_masks([leaf for leaf in leaves if isinstance(leaf, All | Is)])
        touching: dict[Base, Bools] = {}
        extreme: dict[Base, Bools] = {}
        table = np.zeros((len(leaves), len(self._labels)), dtype=np.bool_)
        for row, leaf in enumerate(leaves):
            match leaf:
                case All() | Is():
                    table[row] = bases[leaf]
                case Attach(selected, anchor):
                    if anchor not in touching:
                        touching[anchor] = self._contact_mask(bases[anchor])
                    table[row] = bases[selected] & touching[anchor]
                case Geo(base, direction):
                    if base not in extreme:
                        extreme[base] = self._extreme_masks(bases[base], extremity)
                    table[row] = extreme[base][DIRECTIONS.index(direction)]
        return table

    def _base_masks(self, asked: Sequence[Base]) -> dict[Base, Bools]:
        places: dict[str | None, list[int]] = {}
        for place, label in enumerate(self._labels):
            places.setdefault(label, []).append(place)
        found: dict[Base, Bools] = {}
        for base in asked:
            found[base] = np.full(len(self._labels), isinstance(base, All))
            if isinstance(base, Is):
                found[base][places.get(base.label, [])] = True
        return found

    def _contact_mask(self, anchor: Bools) -> Bools:
        """The hulls in contact with one of the anchor."""
        found = np.zeros_like(anchor)
        for here, there in ((0, 1), (1, 0)):
            found[self._contacts[anchor[self._contacts[:, there]], here]] = True
        return found

    def _extreme_masks(self, base: Bools, extremity: float) -> Bools:
        """For each direction, the hulls of a base that reach farthest along it on their mesh: (6, hulls)."""
        found = np.zeros((len(DIRECTIONS), len(base)), dtype=np.bool_)
        chosen = np.flatnonzero(base)
        if not len(chosen):
            return found
        owner = self._owner[chosen]
        fresh = np.concatenate([[True], owner[1:] != owner[:-1]])
        firsts, part = np.flatnonzero(fresh), np.cumsum(fresh) - 1
        low, high = self._low[chosen], self._high[chosen]
        lowest, highest = np.minimum.reduceat(low, firsts), np.maximum.reduceat(high, firsts)
        diagonals = np.array([dist(a, b) for a, b in zip(lowest.tolist(), highest.tolist(), strict=True)])
        slack = self._slack[owner[firsts]]
        for row, direction in enumerate(DIRECTIONS):
            axis = "XYZ".index(direction[1])
            reach, most = (high, highest) if direction[0] == "+" else (-low, -lowest)
            nearest = most[:, axis] - extremity * diagonals - slack
            found[row, chosen[reach[:, axis] >= nearest[part]]] = True
        return found
