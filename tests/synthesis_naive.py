"""A search that tries everything, for tests: blind products that share nothing with the real one but the order."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from meshforge.language import (
    DIRECTIONS,
    All,
    Attach,
    BaseExtractor,
    Diff,
    Extractor,
    Geo,
    Intersect,
    Is,
    Union,
    select_mask,
)
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.search.terms import order_key

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
            return min(hits, key=lambda extractor: order_key(extractor, labels))
    return None


def _leaves(examples: Sequence[Example], vocabulary: Sequence[str], size: int) -> Sized:
    bases: list[BaseExtractor] = [All(), *map(Is, vocabulary)]
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


def naive_behaviours(
    batch: Sequence[SymbolicMesh], selections: Sequence[int], vocabulary: Sequence[str], max_size: int
) -> dict[tuple[int, ...], int]:
    """What each extractor of up to that size that agrees with the selections on the first meshes selects on all.

    With the size of the smallest extractor that does so. Of extractors that select the same on all meshes only one
    is built upon, so that it ends.
    """
    examples = [Example(str(k), mesh, 0) for k, mesh in enumerate(batch)]
    shown = sum(selection << _ROOM * k for k, selection in enumerate(selections))
    part = (1 << _ROOM * len(selections)) - 1
    sizes: list[Sized] = [[]]
    known: dict[int, int] = {}
    for size in range(1, max_size + 1):
        fresh: dict[int, Extractor] = {}
        for extractor, selection in _leaves(examples, vocabulary, size) + _compounds(sizes, size):
            if selection not in known:
                fresh.setdefault(selection, extractor)
        known.update(dict.fromkeys(fresh, size))
        sizes.append([(extractor, selection) for selection, extractor in fresh.items()])
    room = (1 << _ROOM) - 1
    return {
        tuple(selection >> _ROOM * k & room for k in range(len(batch))): size
        for selection, size in known.items()
        if selection & part == shown
    }
