"""Problems that need a large extractor: two of a family's hidden extractors joined by a set operator.

One or three demonstrated meshes rarely force a large extractor, since a smaller one nearly always agrees by accident.
So these are shown on eight meshes, and what counts is the size of the smallest extractor that agrees.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, combinations, islice, permutations, zip_longest

from benchmark.learning.cases import Case, case, read_family
from benchmark.learning.families import FAMILIES, VOCABULARIES
from benchmark.learning.targets import extractors_of
from meshforge.language import Diff, Extractor, Intersect, Union, size_of
from meshforge.synthesis.search.smallest import Hit

SIZES = (5, 7, 9)
SHOWN = 8
"""Meshes on which each is demonstrated, of those where it selects something."""
_SEED = 100


@dataclass(slots=True)
class LargerCases:
    """So many problems of each size, the families by turns, drawn in an order that is fixed.

    What is drawn is kept if the smallest extractor that agrees has as many nodes as the drawn one, and no other
    problem of the family has the same. drawn: how many were looked at.
    """

    each: int = 12
    sizes: Sequence[int] = SIZES
    families: Sequence[str] = tuple(FAMILIES)
    drawn: int = 0

    def __iter__(self) -> Iterator[Case]:
        for size in self.sizes:
            rounds = zip_longest(*(self._of_family(name, size) for name in self.families))
            yield from islice(filter(None, chain.from_iterable(rounds)), self.each)

    def _of_family(self, name: str, size: int) -> Iterator[Case]:
        found = set[Extractor]()
        for hidden in _join_pairs(name, size):
            self.drawn += 1
            problem = case(name, hidden, VOCABULARIES[name], read_family(name, _SEED), SHOWN, _SEED)
            smallest = _smallest(problem) if problem else None
            if problem and smallest and size_of(smallest) == size and smallest not in found:
                found.add(smallest)
                yield problem


def _join_pairs(name: str, size: int) -> list[Extractor]:
    """Every set operator over two hidden extractors of a family that has so many nodes, shuffled."""
    few = extractors_of(name)
    every: list[Extractor] = [operator(*pair) for pair in combinations(few, 2) for operator in (Union, Intersect)]
    every += [Diff(*pair) for pair in permutations(few, 2)]
    right = [extractor for extractor in every if size_of(extractor) == size]
    random.Random(f"{name} {size}").shuffle(right)
    return right


def _smallest(problem: Case) -> Extractor | None:
    found = problem.search(batch=False).run()
    return found.extractor if isinstance(found, Hit) else None
