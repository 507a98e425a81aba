"""What every leaf extractor selects on many meshes side by side: hulls that no leaf tells apart are one group, one
bit."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise
from math import dist

import numpy as np
import numpy.typing as npt

from meshforge import language
from meshforge.symbolic import SymbolicMesh, mask_of
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.terms import Leaf, Term, combine, enumerate_leaves, leaf_key

Bools = npt.NDArray[np.bool_]


class ObservationTable:
    """All leaf extractors over a vocabulary, as terms over the groups of hulls of some meshes.

    Groups are numbered by their first hull, so those of the first meshes come first. An extractor selects a group
    wholly or not at all, whatever its size, on all meshes alike; so there are far fewer bits than hulls.
    vocabulary: labels in the order in which they are preferred; group: False makes every hull a group of its own.
    """

    def __init__(
        self,
        meshes: Sequence[SymbolicMesh],
        vocabulary: Sequence[str],
        layers: Layers = "S+T+G",
        extremity: float = language.EXTREMITY,
        group: bool = True,
    ) -> None:
        self.meshes = tuple(meshes)
        hulls = HullTable(meshes)
        self._groups = HullGroups(hulls, vocabulary, layers, extremity, group)
        spans = list(pairwise(hulls.starts.tolist()))
        self.groups = [self._groups.of[low:high] for low, high in spans]
        self._signatures = [self._groups.signatures[low:high] for low, high in spans]
        self.width, self.terms = self._groups.width, self._groups.terms

    def width_of(self, count: int) -> int:
        """How many groups the first `count` meshes have."""
        return 1 + max((group for groups in self.groups[:count] for group in groups), default=-1)

    @cached_property
    def present(self) -> tuple[int, ...]:
        """The groups that have hulls on each mesh, as bit sets."""
        return tuple(mask_of(groups) for groups in self.groups)

    def on(self, bits: int, mesh: int) -> int:
        """The hulls of one mesh that are in a set of groups, as a bit set."""
        return mask_of(hull for hull, group in enumerate(self.groups[mesh]) if bits >> group & 1)

    def groups_in(self, selections: Sequence[int]) -> int:
        """The groups that selections of hulls, one for each of the first meshes, touch."""
        rows = zip(selections, self.groups, strict=False)
        return mask_of(group for mask, groups in rows for hull, group in enumerate(groups) if mask >> hull & 1)

    def term(self, extractor: language.Extractor) -> Term:
        """An extractor over the leaves as a term, operands in the order that terms have."""
        return self._groups.term(extractor)

    def bits(self, extractor: language.Extractor) -> int:
        """The groups that an extractor over the leaves selects."""
        return self.term(extractor).bits

    def find_conflict(self, selections: Sequence[int]) -> tuple[tuple[int, int], tuple[int, int]] | None:
        """Two hulls, each as (mesh, hull), that no extractor tells apart though only the first is selected.

        selections: of the first meshes, one bit set of hulls each. None where there are no such hulls.
        """
        first: dict[tuple[bytes, bool], tuple[int, int]] = {}
        for mesh, mask in enumerate(selections):
            for hull, signature in enumerate(self._signatures[mesh]):
                first.setdefault((signature, bool(mask >> hull & 1)), (mesh, hull))
        for (signature, selected), place in first.items():
            if selected and (signature, False) in first:
                return place, first[signature, False]
        return None


class HullGroups:
    """The groups of the hulls in a row, numbered by their first hull.

    signatures: of each hull, which leaves select it; of: the group of each hull; width: how many groups there are.
    vocabulary: labels in the order in which they are preferred; group: False makes every hull a group of its own.
    """

    def __init__(
        self, hulls: HullTable, vocabulary: Sequence[str], layers: Layers, extremity: float, group: bool = True
    ) -> None:
        chosen = enumerate_leaves(vocabulary, layers)
        table = hulls.table(chosen, extremity)
        self.signatures = [column.tobytes() for column in np.packbits(table.T, axis=1)]
        numbers: dict[object, int] = {}
        firsts: list[int] = []
        keys: Sequence[object] = self.signatures if group else range(len(self.signatures))
        self.of: list[int] = []
        for place, key in enumerate(keys):
            if key not in numbers:
                numbers[key] = len(numbers)
                firsts.append(place)
            self.of.append(numbers[key])
        self.width = len(firsts)
        places = {label: place for place, label in enumerate(vocabulary)}
        self.terms = [
            Term(int.from_bytes(row.tobytes(), "little"), leaf_key(leaf, places), leaf)
            for leaf, row in zip(chosen, np.packbits(table[:, firsts], axis=1, bitorder="little"), strict=True)
        ]

    def term(self, extractor: language.Extractor) -> Term:
        """An extractor over the leaves as a term, operands in the order that terms have."""
        match extractor:
            case language.Union(left, right) | language.Intersect(left, right) | language.Diff(left, right):
                return combine(type(extractor), self.term(left), self.term(right))
            case leaf:
                return self._leaves[leaf]

    @cached_property
    def _leaves(self) -> dict[language.Extractor, Term]:
        return {term.extractor: term for term in self.terms}


class HullTable:
    """The hulls of several meshes in one row: labels, boxes, contacts.

    labels: of each hull, where they are not those of the meshes. A mesh may come several times, under other labels.
    Everything is selected exactly as the language does, which tests hold against it.
    """

    __slots__ = ("_contacts", "_high", "_labels", "_low", "_owner", "_slack", "starts")

    def __init__(self, meshes: Sequence[SymbolicMesh], labels: Sequence[str | None] | None = None) -> None:
        counts = [len(mesh.hulls) for mesh in meshes]
        self.starts = np.cumsum([0, *counts], dtype=np.int64)
        self._owner = np.repeat(np.arange(len(meshes)), counts)
        none = np.zeros((0, 3))
        self._low = np.concatenate([none, *(mesh.corners[0] for mesh in meshes)])
        self._high = np.concatenate([none, *(mesh.corners[1] for mesh in meshes)])
        self._labels = labels if labels is not None else [hull.label for mesh in meshes for hull in mesh.hulls]
        self._slack = np.array([language.SLACK * language.reference_length(mesh) for mesh in meshes])
        contacts = {id(mesh): np.array(list(mesh.contacts), dtype=np.int64).reshape(-1, 2) for mesh in meshes}
        pairs = [contacts[id(mesh)] + start for mesh, start in zip(meshes, self.starts, strict=False)]
        self._contacts = np.concatenate([np.zeros((0, 2), dtype=np.int64), *pairs])

    def table(self, leaves: Sequence[Leaf], extremity: float) -> Bools:
        """Whether each leaf selects each hull: (leaves, hulls)."""
        bases = self._base_masks([leaf for leaf in leaves if isinstance(leaf, language.All | language.Is)])
        touching: dict[language.BaseExtractor, Bools] = {}
        extreme: dict[language.BaseExtractor, Bools] = {}
        table = np.zeros((len(leaves), len(self._labels)), dtype=np.bool_)
        for row, leaf in enumerate(leaves):
            match leaf:
                case language.All() | language.Is():
                    table[row] = bases[leaf]
                case language.Attach(selected, anchor):
                    if anchor not in touching:
                        touching[anchor] = self._contact_mask(bases[anchor])
                    table[row] = bases[selected] & touching[anchor]
                case language.Geo(base, direction):
                    if base not in extreme:
                        extreme[base] = self._extreme_masks(bases[base], extremity)
                    table[row] = extreme[base][language.DIRECTIONS.index(direction)]
        return table

    def _base_masks(self, asked: Sequence[language.BaseExtractor]) -> dict[language.BaseExtractor, Bools]:
        places: dict[str | None, list[int]] = {}
        for place, label in enumerate(self._labels):
            places.setdefault(label, []).append(place)
        found: dict[language.BaseExtractor, Bools] = {}
        for base in asked:
            found[base] = np.full(len(self._labels), isinstance(base, language.All))
            if isinstance(base, language.Is):
                found[base][places.get(base.label, [])] = True
        return found

    def _contact_mask(self, anchor: Bools) -> Bools:
        found = np.zeros_like(anchor)
        for here, there in ((0, 1), (1, 0)):
            found[self._contacts[anchor[self._contacts[:, there]], here]] = True
        return found

    def _extreme_masks(self, base: Bools, extremity: float) -> Bools:
        """For each direction, the hulls of a base that reach farthest along it on their mesh: (6, hulls)."""
        found = np.zeros((len(language.DIRECTIONS), len(base)), dtype=np.bool_)
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
        for row, direction in enumerate(language.DIRECTIONS):
            axis = "XYZ".index(direction[1])
            reach, most = (high, highest) if direction[0] == "+" else (-low, -lowest)
            nearest = most[:, axis] - extremity * diagonals - slack
            found[row, chosen[reach[:, axis] >= nearest[part]]] = True
        return found
