"""Several meshes side by side as the search sees them: hulls that no leaf tells apart are one group, one bit."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from meshforge.language import EXTREMITY, Diff, Extractor, Intersect, Union
from meshforge.symbolic import SymbolicMesh, mask_of
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.arrays import Hulls
from meshforge.synthesis.search.leaves import leaves
from meshforge.synthesis.search.order import leaf_key
from meshforge.synthesis.search.term import Term, joined


class Field:
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
        extremity: float = EXTREMITY,
        group: bool = True,
    ) -> None:
        self.meshes = tuple(meshes)
        chosen, hulls = leaves(vocabulary, layers), Hulls(meshes)
        table = hulls.table(chosen, extremity)
        signatures = [column.tobytes() for column in np.packbits(table.T, axis=1)]
        numbers: dict[object, int] = {}
        keys: Sequence[object] = signatures if group else range(len(signatures))
        groups = [numbers.setdefault(key, len(numbers)) for key in keys]
        starts: list[int] = hulls.starts.tolist()
        self.groups = [groups[low:high] for low, high in pairwise(starts)]
        self._signatures = [signatures[low:high] for low, high in pairwise(starts)]
        self.width = len(numbers)
        places = {label: place for place, label in enumerate(vocabulary)}
        packed = np.packbits(table[:, _firsts(groups)], axis=1, bitorder="little")
        self.terms = [
            Term(int.from_bytes(row.tobytes(), "little"), leaf_key(leaf, places), leaf)
            for leaf, row in zip(chosen, packed, strict=True)
        ]

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

    def touched(self, selections: Sequence[int]) -> int:
        """The groups that selections of hulls, one for each of the first meshes, touch."""
        rows = zip(selections, self.groups, strict=False)
        return mask_of(group for mask, groups in rows for hull, group in enumerate(groups) if mask >> hull & 1)

    def term(self, extractor: Extractor) -> Term:
        """An extractor over the leaves as a term, operands in the order that terms have."""
        match extractor:
            case Union(left, right) | Intersect(left, right) | Diff(left, right):
                return joined(type(extractor), self.term(left), self.term(right))
            case leaf:
                return self._leaves[leaf]

    def bits(self, extractor: Extractor) -> int:
        """The groups that an extractor over the leaves selects."""
        return self.term(extractor).bits

    @cached_property
    def _leaves(self) -> dict[Extractor, Term]:
        return {term.extractor: term for term in self.terms}

    def unlike(self, selections: Sequence[int]) -> tuple[tuple[int, int], tuple[int, int]] | None:
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


def _firsts(groups: Sequence[int]) -> list[int]:
    """The place of the first member of each group, in the order of the groups."""
    places: dict[int, int] = {}
    for place, group in enumerate(groups):
        places.setdefault(group, place)
    return list(places.values())
