"""Which explanation is believed, and how far each of its corrections is."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from math import exp, prod

from meshforge.synthesis.repair.matching import Candidate, chance
from meshforge.synthesis.repair.relabelings import Change

Place = tuple[int, Change]
"""A change on one of the examples."""


def ranked(candidates: Iterable[Candidate]) -> list[Candidate]:
    """The candidates with corrections, the most believable first; of equally believable ones in their order."""
    return sorted((one for one in candidates if not one.exact), key=lambda one: (round(one.score, 9), one.key))


def changes(candidate: Candidate) -> tuple[Place, ...]:
    """The changes of a candidate's cheapest relabelings."""
    return tuple((place, change) for place, some in enumerate(candidate.ways) for change in some[0].changes)


def beliefs(candidates: Sequence[Candidate], instead: float) -> Mapping[Place, float]:
    """The probability of each change, among all candidates and what stands against them.

    instead: the cost [nats] of what else may be the case. An extractor's share is spread over its relabelings.
    """
    least = min([instead, *(one.score for one in candidates)])
    total, shares = exp(least - instead), defaultdict[Place, float](float)
    for candidate in candidates:
        weight = exp(least - candidate.base)
        sums = [chance(some) for some in candidate.ways]
        total += weight * prod(sums)
        for place, some in enumerate(candidate.ways):
            others = weight * prod(sums[:place]) * prod(sums[place + 1 :])
            for way in some:
                for change in way.changes:
                    shares[place, change] += others * way.chance
    return {place: share / total for place, share in shares.items()}
