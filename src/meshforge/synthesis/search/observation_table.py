"""What every leaf selects on many meshes; hulls that no leaf tells apart are one group, one bit."""

from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise
from typing import assert_never

import numpy as np

from meshforge import language
from meshforge.language import Bools, HullTable, Leaf, select_hulls
from meshforge.symbolic import SymbolicMesh, mask_of
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.terms import Term, combine, enumerate_leaves, leaf_key


class ObservationTable:
    """All leaf extractors over a vocabulary, as terms over the groups of hulls of some meshes.

    Groups are numbered by their first hull, so those of the first meshes come first. An extractor selects a group
    wholly or not at all, whatever its size, on all meshes alike; so there are far fewer bits than hulls.
    vocabulary: labels in the order in which they are preferred; more: leaves besides the built-in ones.
    """

    def __init__(
        self,
        meshes: Sequence[SymbolicMesh],
        vocabulary: Sequence[str],
        layers: Layers = "S+T+G",
        extremity: float = language.EXTREMITY,
        more: tuple[Leaf, ...] = (),
    ) -> None:
        self.meshes = tuple(meshes)
        hulls = HullTable(meshes, extremity=extremity)
        leaves = (*enumerate_leaves(tuple(vocabulary), layers), *more)
        self._groups = HullGroups(hulls, leaves, vocabulary)
        spans = list(pairwise(hulls.starts.tolist()))
        self.groups = [self._groups.of[low:high] for low, high in spans]
        self._signatures = [self._groups.signatures[low:high] for low, high in spans]
        self.width, self.terms = self._groups.width, self._groups.terms

    def width_of(self, count: int) -> int:
        """Return how many groups the first `count` meshes have."""
        return 1 + max((group for groups in self.groups[:count] for group in groups), default=-1)

    @cached_property
    def present(self) -> tuple[int, ...]:
        """The groups that have hulls on each mesh, as bit sets."""
        return tuple(mask_of(groups) for groups in self.groups)

    def on(self, bits: int, mesh: int) -> int:
        """Return the hulls of one mesh that are in a set of groups, as a bit set."""
        return mask_of(hull for hull, group in enumerate(self.groups[mesh]) if bits >> group & 1)

    def groups_in(self, selections: Sequence[int]) -> int:
        """Return the groups that selections of hulls, one for each of the first meshes, touch."""
        rows = zip(selections, self.groups, strict=False)
        return mask_of(group for mask, groups in rows for hull, group in enumerate(groups) if mask >> hull & 1)

    def term(self, extractor: language.Extractor) -> Term:
        """Return an extractor over the leaves as a term, operands in the order that terms have."""
        return self._groups.term(extractor)

    def bits(self, extractor: language.Extractor) -> int:
        """Return the groups that an extractor over the leaves selects."""
        return self.term(extractor).bits

    def find_conflict(self, selections: Sequence[int]) -> tuple[tuple[int, int], tuple[int, int]] | None:
        """Return two hulls, each as (mesh, hull), that no extractor tells apart though only the first is selected.

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
    vocabulary: labels in the order in which they are preferred.
    """

    def __init__(self, hulls: HullTable, leaves: Sequence[Leaf], vocabulary: Sequence[str]) -> None:
        table = select_all(leaves, hulls)
        self.signatures = [column.tobytes() for column in np.packbits(table.T, axis=1)]
        firsts = dict[bytes, int]()
        for place, signature in enumerate(self.signatures):
            firsts.setdefault(signature, place)
        numbers = {signature: number for number, signature in enumerate(firsts)}
        self.of = [numbers[signature] for signature in self.signatures]
        self.width = len(firsts)
        places = {label: place for place, label in enumerate(vocabulary)}
        self.terms = [
            Term(int.from_bytes(row.tobytes(), "little"), leaf_key(leaf, places), leaf)
            for leaf, row in zip(
                leaves, np.packbits(table[:, [*firsts.values()]], axis=1, bitorder="little"), strict=True
            )
        ]

    def term(self, extractor: language.Extractor) -> Term:
        """Return an extractor over the leaves as a term, operands in the order that terms have."""
        match extractor:
            case language.Union(left, right) | language.Intersect(left, right) | language.Diff(left, right):
                return combine(type(extractor), self.term(left), self.term(right))
            case Leaf():
                return self._leaves[extractor]
            case _:
                assert_never(extractor)

    @cached_property
    def _leaves(self) -> dict[language.Extractor, Term]:
        return {term.extractor: term for term in self.terms}


def select_all(leaves: Sequence[Leaf], hulls: HullTable) -> Bools:
    """Return whether each leaf selects each hull: (leaves, hulls)."""
    table = np.zeros((len(leaves), len(hulls)), dtype=np.bool_)
    for row, leaf in enumerate(leaves):
        table[row] = select_hulls(leaf, hulls)
    return table
