"""Hulls that a person probably left out of a demonstration, or selected, by mistake, and answers that probably are one:
a much simpler extractor would select all the others (minimum description length, Rissanen 1978: the size of a rule
against the number of its errors).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import or_

from meshforge.language import Extractor, size_of
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.readings.belief import count_nats
from meshforge.synthesis.search.bank import Bank
from meshforge.synthesis.search.observation_table import ObservationTable
from meshforge.synthesis.search.smallest import ErrorCounter, Search, compare_nearest
from meshforge.synthesis.search.terms import Term

MOST_HULLS = 2
"""Hulls that may be wrong in one selection."""
SLIP = 3.5
"""What each such hull costs [nats], and each wrong answer, whatever it selects: a person misses about one in thirty."""
_LEAST_NODES, _MOST_NODES = 4, 3  # of an extractor that may come from a slip, and of one that would be simpler


@dataclass(frozen=True, slots=True)
class Slip:
    """What a person may have meant on one asset, and did not select.

    asset: how messages call it; missing, extra: names of the hulls left out, and selected, by mistake; extractor: the
    simpler one; share: how probable it is.
    """

    asset: str
    missing: tuple[str, ...]
    extra: tuple[str, ...]
    extractor: Extractor
    share: float


def find_slip(
    extractor: Extractor,
    examples: Sequence[Example],
    vocabulary: Sequence[str],
    options: Options,
    answered: Collection[str] = (),
) -> Slip | None:
    """The likeliest slip in what was selected on some meshes, None where the extractor is simple enough.

    extractor: one that selects just that; options: with the extremity under which it does; answered: the examples that
    are answers to questions, by name, where all may be wrong at once.
    """
    if size_of(extractor) < _LEAST_NODES:
        return None
    search = Search(examples, vocabulary, TimeBudget(math.inf), options)
    field, shown = search.field, (1 << search.width) - 1
    bank = Bank([Term(one.bits & shown, one.key, one.form) for one in field.terms], search.width, search.budget)
    errors = ErrorCounter(field, search.selections, search.width)
    others = [_find_others(field, place) for place, one in enumerate(examples) if one.name in answered]

    def count_slips(term: Term) -> int:
        differs = (term.bits ^ search.need) & shown
        if differs and not all(differs & groups for groups in others):
            return 1  # one answer is wrong
        return errors.count(term.bits)

    levels = range(1, _MOST_NODES + 1)
    found = [
        (count_nats(term, shown) + SLIP * slips, term)
        for size in levels
        for term in bank.level(size).terms
        if 0 < (slips := count_slips(term)) <= MOST_HULLS
    ]
    if not found:
        return None
    nats, best = min(found, key=lambda row: (row[0], row[1].key))
    differs = compare_nearest(best.extractor, field, examples)
    if len(differs.extra) + len(differs.missing) < errors.count(best.bits):
        return None  # it is wrong on several meshes
    share = 1 / (1 + math.exp(nats - count_nats(field.term(extractor), shown)))
    return Slip(differs.asset, differs.extra, differs.missing, best.extractor, share)


def _find_others(field: ObservationTable, place: int) -> int:
    """The groups that have hulls on any mesh but one, as a bit set."""
    return reduce(or_, [*field.present[:place], *field.present[place + 1 :]], 0)
