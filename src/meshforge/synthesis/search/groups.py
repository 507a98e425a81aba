"""Hulls that no leaf extractor tells apart count as one group, one bit; the leaves are terms over these groups."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from meshforge.language import Diff, Extractor, Intersect, Union
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.arrays import Hulls
from meshforge.synthesis.search.leaves import leaves
from meshforge.synthesis.search.order import leaf_key
from meshforge.synthesis.search.term import Term, joined


class Groups:
    """The groups of the hulls in a row, numbered by their first hull.

    looks: of each hull, which leaves select it; of: the group of each hull; width: how many groups there are.
    vocabulary: labels in the order in which they are preferred; group: False makes every hull a group of its own.
    """

    def __init__(
        self, hulls: Hulls, vocabulary: Sequence[str], layers: Layers, extremity: float, group: bool = True
    ) -> None:
        chosen = leaves(vocabulary, layers)
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
        packed = np.packbits(table[:, firsts], axis=1, bitorder="little")
        self.terms = [
            Term(int.from_bytes(row.tobytes(), "little"), leaf_key(leaf, places), leaf)
            for leaf, row in zip(chosen, packed, strict=True)
        ]

    def term(self, extractor: Extractor) -> Term:
        """An extractor over the leaves as a term, operands in the order that terms have."""
        match extractor:
            case Union(left, right) | Intersect(left, right) | Diff(left, right):
                return joined(type(extractor), self.term(left), self.term(right))
            case leaf:
                return self._leaves[leaf]

    @cached_property
    def _leaves(self) -> dict[Extractor, Term]:
        return {term.extractor: term for term in self.terms}
