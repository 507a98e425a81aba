"""All small extractors that select what was shown on some relabeling of each mesh."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from math import fsum, log
from operator import or_

from meshforge.language import Extractor
from meshforge.synthesis.repair import weights
from meshforge.synthesis.repair.relabelings import Relabeling
from meshforge.synthesis.repair.variants import Variant, Variants
from meshforge.synthesis.search.bank import Bank, Level
from meshforge.synthesis.search.columns import positions
from meshforge.synthesis.search.order import Key
from meshforge.synthesis.watch import Watch


@dataclass(frozen=True, slots=True)
class Candidate:
    """An extractor, and for each mesh the relabelings on which it selects what was shown, the cheapest first."""

    extractor: Extractor
    key: Key
    ways: tuple[tuple[Relabeling, ...], ...]

    @property
    def base(self) -> float:
        """What the extractor alone costs."""
        return key_cost(self.key)

    @property
    def cost(self) -> float:
        """With the cheapest relabeling of each mesh."""
        return self.base + sum(some[0].cost for some in self.ways)

    @property
    def score(self) -> float:
        """What it costs that the extractor matches on any relabeling at all."""
        return self.base + sum(-log(chance(some)) for some in self.ways)

    @property
    def exact(self) -> bool:
        """Whether it matches with all labels as they are."""
        return not any(some[0].changes for some in self.ways)


def chance(ways: Iterable[Relabeling]) -> float:
    """How probable relabelings are together, compared with the mesh as it is."""
    return fsum(way.chance for way in ways)


def key_cost(key: Key) -> float:
    """What it costs to believe an extractor, by its place in the search's order."""
    size, doubts = float(key[0]), float(key[1])
    return weights.NODE * size + weights.DOUBT * doubts


def matching(variants: Variants, largest: int, within: float, watch: Watch) -> Iterator[Candidate]:
    """The candidates of up to `largest` nodes that cost no more than `within`, smaller ones first.

    Those that are much less believable than one before are passed over.
    """
    bank = Bank(variants.terms, variants.width, watch)
    for size in range(1, largest + 1):
        if weights.NODE * size > within:
            return
        for candidate in _on_level(bank.level(size), variants.by_example, within, watch):
            within = min(within, candidate.cost + weights.NEGLIGIBLE)
            yield candidate


Hits = list[tuple[Relabeling, int]]
"""Relabelings of one example, the cheapest first, and the rows of a level's terms that match on each."""


def _on_level(
    level: Level, by_example: Sequence[Sequence[Variant]], within: float, watch: Watch
) -> Iterator[Candidate]:
    """The candidates among the terms of one level."""
    rows, found = level.columns.every, list[Hits]()
    for variants in by_example:
        watch.check()
        hits = [(variant.relabeling, _matches(level, variant, rows)) for variant in variants]
        rows &= reduce(or_, (hit for _, hit in hits), 0)
        found.append([(relabeling, hit) for relabeling, hit in hits if hit])
    costs = {row: key_cost(level.terms[row].key) for row in positions(rows)}
    for hits in found:
        _add_cheapest(costs, hits, rows)
    for row in sorted(row for row, cost in costs.items() if cost <= within):
        term = level.terms[row]
        ways = tuple(tuple(relabeling for relabeling, hit in hits if hit >> row & 1) for hits in found)
        yield Candidate(term.extractor, term.key, ways)


def _add_cheapest(costs: dict[int, float], hits: Hits, rows: int) -> None:
    """Add to the cost of each row that of the first relabeling it matches on."""
    for relabeling, hit in hits:
        for row in positions(hit & rows):
            costs[row] += relabeling.cost
        rows &= ~hit


def _matches(level: Level, variant: Variant, among: int) -> int:
    """The rows of a level's terms that select on a variant exactly what was shown."""
    return level.columns.rows_without(variant.avoid, level.columns.rows_with(variant.need, among))
