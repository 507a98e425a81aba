"""Larger extractors under the most believable relabelings: the exact search, run on the relabelled examples."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from heapq import heappop, heappush

from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Options
from meshforge.synthesis.repair import weights
from meshforge.synthesis.repair.matching import Candidate
from meshforge.synthesis.repair.relabelings import Relabeling, relabelled
from meshforge.synthesis.repair.variants import Variant, Variants
from meshforge.synthesis.search import Hit, Search
from meshforge.synthesis.search.order import Key, order
from meshforge.synthesis.watch import Watch

SEARCHES = 24
"""Relabelings of all examples together that are searched at most."""

_LOOKED_AT = 4000  # relabelings of all examples together that are looked at for that

_LARGEST = 9  # nodes; beyond, what a few examples show no longer speaks for a program


def larger(
    examples: Sequence[Example],
    variants: Variants,
    vocabulary: Sequence[str],
    options: Options,
    extremity: float,
    above: int,
    within: float,
    watch: Watch,
) -> Iterator[Candidate]:
    """Candidates of more than `above` nodes that cost no more than `within`, of cheap relabelings first."""
    places = {label: place for place, label in enumerate(vocabulary)}
    known: set[Key] = set()
    for searched, ways in enumerate(together(variants, watch)):
        room = within - sum(way.cost for way in ways)
        largest = min(options.max_size, _LARGEST, int(room / weights.NODE))
        if largest <= above or searched == SEARCHES:
            return
        shown = [relabelled(example, way.changes) for example, way in zip(examples, ways, strict=True)]
        answer = Search(shown, vocabulary, watch, replace(options, max_size=largest), extremity).run()
        watch.check()
        if isinstance(answer, Hit) and (key := order(answer.extractor, places)) not in known and key[0] > above:
            known.add(key)
            matched = variants.relabelings_for(answer.extractor)
            candidate = Candidate(answer.extractor, key, tuple(map(tuple, matched)))
            within = min(within, candidate.cost + weights.RIVAL)
            yield candidate


def together(variants: Variants, watch: Watch) -> Iterator[tuple[Relabeling, ...]]:
    """Relabelings of all examples with a correction at least, cheapest first, that some extractor may match."""
    lists = variants.by_example
    if not all(lists):
        return
    heap = [(sum(some[0].relabeling.cost for some in lists), (0,) * len(lists))]
    seen = {heap[0][1]}
    for _ in range(_LOOKED_AT):
        if not heap:
            return
        watch.check()
        _, at = heappop(heap)
        chosen = [some[k] for some, k in zip(lists, at, strict=True)]
        if _compatible(chosen) and any(one.relabeling.changes for one in chosen):
            yield tuple(one.relabeling for one in chosen)
        for place, some in enumerate(lists):
            step = (*at[:place], at[place] + 1, *at[place + 1 :])
            if step[place] < len(some) and step not in seen:
                seen.add(step)
                cost = sum(some[k].relabeling.cost for some, k in zip(lists, step, strict=True))
                heappush(heap, (cost, step))


def _compatible(chosen: Sequence[Variant]) -> bool:
    """Whether no two hulls that no extractor tells apart were treated differently."""
    need = avoid = 0
    for variant in chosen:
        need, avoid = need | variant.need, avoid | variant.avoid
    return not need & avoid
