"""A search that tries everything, for tests: blind products that share nothing with the real one but the order."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from meshforge.language import DIRECTIONS, All, Attach, Base, Diff, Extractor, Geo, Intersect, Is, Union, select_mask
from meshforge.synthesis.example import Example
from meshforge.synthesis.search.order import order

_ROOM = 64  # bits kept for each mesh

Sized = list[tuple[Extractor, int]]
"""Extractors of one size, with what they select."""


def naive_search(examples: Sequence[Example], vocabulary: Sequence[str], max_size: int) -> Extractor | None:
    """The first in the order of all extractors of up to that size that select on every example what was shown."""
    target = sum(example.selection << _ROOM * k for k, example in enumerate(examples))
    labels = {label: place for place, label in enumerate(vocabulary)}
    sizes: list[Sized] = [[]]
    for size in range(1, max_size + 1):
        sizes.append(_leaves(examples, vocabulary, size) + _compounds(sizes, size))
        hits = [extractor for extractor, selection in sizes[size] if selection == target]
        if hits:
            return min(hits, key=lambda extractor: order(extractor, labels))
    return None


def _leaves(examples: Sequence[Example], vocabulary: Sequence[str], size: int) -> Sized:
    bases: list[Base] = [All(), *map(Is, vocabulary)]
    of_size: dict[int, list[Extractor]] = {
        1: [*bases],
        2: [Geo(base, direction) for base, direction in product(bases, DIRECTIONS)],
        3: [Attach(x, y) for x, y in product(bases, bases)],
    }
    return [
        (leaf, sum(select_mask(leaf, example.mesh) << _ROOM * k for k, example in enumerate(examples)))
        for leaf in of_size.get(size, [])
    ]


def _compounds(sizes: list[Sized], size: int) -> Sized:
    made: Sized = []
    for small in range(1, size - 1):
        for (x, a), (y, b) in product(sizes[small], sizes[size - 1 - small]):
            made += [(Union(x, y), a | b), (Intersect(x, y), a & b), (Diff(x, y), a & ~b)]
    return made
