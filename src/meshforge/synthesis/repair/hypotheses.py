"""Extractors that select what was shown on some relabeling of each mesh: all small ones, and larger ones by the
search; and why a label is proposed to be corrected, in words.

What believing costs is in nats, in one place. Tuned on families of box furniture; judged by `script/bench
repairs` on families that nothing was tuned on, with their figures in `benchmark/results/learning.md`: nearly all
proposals are right, and hardly any is made on right labels. Without a batch around the demonstrations some 90% of
the proposals are right.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from heapq import heappop, heappush
from math import fsum, log
from operator import or_

from meshforge.label_model import LabelOdds, is_human
from meshforge.language import Extractor, show
from meshforge.symbolic import Hull
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.repair.relabelings import Relabeling, Variant, Variants, relabel
from meshforge.synthesis.search.bank import Bank, Level, positions
from meshforge.synthesis.search.smallest import Search
from meshforge.synthesis.search.terms import Key, order_key

RelabelingRows = list[tuple[Relabeling, int]]
"""Relabelings of one example, the cheapest first, and the rows of a level's terms that match on each."""

MAX_SEARCHES = 24
"""Relabelings of all examples together that are searched at most."""

_MAX_COMBINATIONS = 4000  # relabelings of all examples together that are looked at for that

_MAX_SIZE = 9  # nodes; beyond, what a few examples show no longer speaks for a program

NODE_COST = 1.8
"""A syntax node of an extractor: with five labels, the number of extractors grows so fast with their size."""

UNCERTAINTY_COST = 1.0
"""A doubt of the search's order (`All`, a direction, an unusual contact)."""

NO_EXTRACTOR_COST = 22.0
"""No extractor at all: what must not be exceeded to be proposed then."""

RIVAL_MARGIN = 4.0
"""Explanations that cost so much more than the best still take part when beliefs are shared out."""

NEGLIGIBLE_MARGIN = 8.0
"""Explanations that cost so much more than another are not even looked at."""

MIN_BELIEF = 0.75
"""A proposal is made when each of its corrections is so probable."""

MIN_BELIEF_WITHOUT_EXACT = 0.3
"""Where there is no exact extractor, nothing else is left, so less is enough."""

_LOW_CONFIDENCE = 0.8  # a confidence below is worth mentioning

MAX_BELIEF_AGAINST_PERSON = 0.5
"""A correction of a person's label is never believed more."""


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
        return self.base + sum(-log(total_chance(some)) for some in self.ways)

    @property
    def exact(self) -> bool:
        """Whether it matches with all labels as they are."""
        return not any(some[0].changes for some in self.ways)


def total_chance(ways: Iterable[Relabeling]) -> float:
    """Return how probable relabelings are together, compared with the mesh as it is."""
    return fsum(way.chance for way in ways)


def key_cost(key: Key) -> float:
    """Return what it costs to believe an extractor, by its place in the search's order."""
    size, uncertainty = float(key[0]), float(key[1])
    return NODE_COST * size + UNCERTAINTY_COST * uncertainty


def search_small(variants: Variants, largest: int, within: float, budget: TimeBudget) -> Iterator[Candidate]:
    """Yield the candidates of up to `largest` nodes that cost no more than `within`, smaller ones first.

    Those that are much less believable than one before are passed over.
    """
    bank = Bank(variants.terms, variants.width, budget)
    for size in range(1, largest + 1):
        if NODE_COST * size > within:
            return
        for candidate in _candidates_on_level(bank.level(size), variants.by_example, within, budget):
            within = min(within, candidate.cost + NEGLIGIBLE_MARGIN)
            yield candidate


def _candidates_on_level(
    level: Level, by_example: Sequence[Sequence[Variant]], within: float, budget: TimeBudget
) -> Iterator[Candidate]:
    rows, found = level.columns.every, list[RelabelingRows]()
    for variants in by_example:
        budget.check()
        hits = [
            (one.relabeling, level.columns.rows_without(one.avoid, level.columns.rows_with(one.need, rows)))
            for one in variants
        ]
        rows &= reduce(or_, (hit for _, hit in hits), 0)
        found.append([(relabeling, hit) for relabeling, hit in hits if hit])
    costs = {row: key_cost(level.terms[row].key) for row in positions(rows)}
    for hits in found:
        left = rows
        for relabeling, hit in hits:  # the cheapest first
            for row in positions(hit & left):
                costs[row] += relabeling.cost
            left &= ~hit
    for row in sorted(row for row, cost in costs.items() if cost <= within):
        term = level.terms[row]
        ways = tuple(tuple(relabeling for relabeling, hit in hits if hit >> row & 1) for hits in found)
        yield Candidate(term.extractor, term.key, ways)


def search_larger(
    examples: Sequence[Example],
    variants: Variants,
    vocabulary: Sequence[str],
    options: Options,
    above: int,
    within: float,
    budget: TimeBudget,
) -> Iterator[Candidate]:
    """Yield candidates of more than `above` nodes that cost no more than `within`, of cheap relabelings first."""
    places = {label: place for place, label in enumerate(vocabulary)}
    known: set[Key] = set()
    for searched, ways in enumerate(combine_relabelings(variants, budget)):
        room = within - sum(way.cost for way in ways)
        largest = min(options.max_size, _MAX_SIZE, int(room / NODE_COST))
        if largest <= above or searched == MAX_SEARCHES:
            return
        shown = [relabel(example, way.changes) for example, way in zip(examples, ways, strict=True)]
        hit = Search(shown, vocabulary, budget, replace(options, max_size=largest)).find_hit()
        if hit and (key := order_key(hit.extractor, places)) not in known and key[0] > above:
            known.add(key)
            candidate = Candidate(hit.extractor, key, tuple(map(tuple, variants.relabelings_for(hit.extractor))))
            within = min(within, candidate.cost + RIVAL_MARGIN)
            yield candidate


def combine_relabelings(variants: Variants, budget: TimeBudget) -> Iterator[tuple[Relabeling, ...]]:
    """Yield relabelings of all examples with a correction at least, cheapest first, that some extractor may match."""
    lists = variants.by_example
    if not all(lists):
        return
    heap = [(sum(some[0].relabeling.cost for some in lists), (0,) * len(lists))]
    seen = {heap[0][1]}
    for _ in range(_MAX_COMBINATIONS):
        if not heap:
            return
        budget.check()
        _, at = heappop(heap)
        chosen = [some[k] for some, k in zip(lists, at, strict=True)]
        if _is_compatible(chosen) and any(one.relabeling.changes for one in chosen):
            yield tuple(one.relabeling for one in chosen)
        for place, some in enumerate(lists):
            step = (*at[:place], at[place] + 1, *at[place + 1 :])
            if step[place] < len(some) and step not in seen:
                seen.add(step)
                heappush(heap, (sum(some[k].relabeling.cost for some, k in zip(lists, step, strict=True)), step))


def _is_compatible(chosen: Sequence[Variant]) -> bool:
    """Whether no two hulls that no extractor tells apart were treated differently."""
    need = avoid = 0
    for variant in chosen:
        need, avoid = need | variant.need, avoid | variant.avoid
    return not need & avoid


def explain_fix(odds: LabelOdds, to: str, extractor: Extractor, alone: bool) -> str:
    """Return one sentence on the label itself, and what its correction makes possible.

    alone: whether it is the only correction.
    """
    evidence = "; ".join([*list_evidence(odds, to), describe_effect(extractor, alone)])
    return evidence[0].upper() + evidence[1:]


def list_evidence(odds: LabelOdds, to: str) -> list[str]:
    """Return what speaks against a label and for another one."""
    similar, hull = odds.similar, odds.hull
    agreeing, of = similar.count(to), len(similar)
    reasons = []
    if agreeing > similar.count(hull.label or ""):
        reasons.append(f"{agreeing} of the {of} most similar hulls are labelled {to}")
    return [*reasons, *_label_reasons(hull)]


def _label_reasons(hull: Hull) -> list[str]:
    if hull.annotation is None:
        return ["it has no label"]
    if is_human(hull):
        return [f"a person labelled it {hull.annotation.name}"]
    if hull.annotation.confidence < _LOW_CONFIDENCE:
        return [f"{hull.annotation.name} has a confidence of {hull.annotation.confidence:.2f} only"]
    return []


def describe_effect(extractor: Extractor, alone: bool) -> str:
    """Return what corrections make possible. alone: whether there is only one."""
    return f"with {'it' if alone else 'all corrections'}, {show(extractor)} selects what was shown"
