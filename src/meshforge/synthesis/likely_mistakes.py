"""Hulls that a person probably left out of a demonstration, or selected, by mistake, and answers and verdicts that
probably are one: a much simpler extractor would select all the others (minimum description length, Rissanen 1978: the
size of a rule against the number of its errors).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from meshforge.language import Extractor, leaves_of, size_of
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.search.bank import Bank
from meshforge.synthesis.search.smallest import ErrorCounter, Search, compare_selection
from meshforge.synthesis.search.terms import Term

MOST_MISTAKES = 2
"""Slips in what is known of one rule."""
MISTAKE, NODE = 3.5, 1.0
"""What a mistake costs, and a node of an extractor [nats]: a person misses about one hull in thirty, and answers as
seldom wrongly; rules that people mean are short."""
_LEAST_NODES, _MOST_NODES = 2, 3  # of an extractor that may come from a slip, and of one that would be simpler


@dataclass(frozen=True, slots=True)
class LikelyMistake:
    """What a person may have meant on one asset, and did not select.

    asset: how messages call it; missing, extra: names of the hulls left out, and selected, by mistake; extractor: the
    simpler one; share: how probable it is.
    """

    asset: str
    missing: tuple[str, ...]
    extra: tuple[str, ...]
    extractor: Extractor
    share: float


def find_mistake(
    extractor: Extractor,
    examples: Sequence[Example],
    vocabulary: Sequence[str],
    options: Options,
    answered: Collection[str] = (),
) -> LikelyMistake | None:
    """Return the likeliest mistake in what was selected on some meshes, None where the extractor is simple enough.
    Where several are needed for a simpler one, the first of them.

    extractor: what was learned; options: with the extremity under which it was; answered: the examples that are answers
    or verdicts, by name, of which each is one mistake, whatever it selects.
    """
    if size_of(extractor) < _LEAST_NODES:
        return None
    used = tuple(leaf for leaf in leaves_of(extractor) if any(one.plugin for one in (leaf, *leaf.bases)))
    bases = tuple(base for leaf in used for base in leaf.bases if base.plugin)
    search = Search(
        examples, vocabulary, TimeBudget(math.inf), replace(options, leaves=tuple(dict.fromkeys((*bases, *used))))
    )
    field, shown = search.field, (1 << search.width) - 1
    bank = Bank([Term(one.bits & shown, one.key, one.form) for one in field.terms], search.width, search.budget)
    rows = zip(search.selections, field.groups, examples, strict=True)
    counters = [(ErrorCounter([mask], [groups], search.width), one.name in answered) for mask, groups, one in rows]

    def count_mistakes(bits: int) -> int:
        count = 0
        for errors, is_answered in counters:
            wrong = errors.count(bits)
            count += min(wrong, 1) if is_answered else wrong
            if count > MOST_MISTAKES:
                break
        return count

    levels = range(1, _MOST_NODES + 1)
    found = [
        (NODE * size + MISTAKE * mistakes, term)
        for size in levels
        for term in bank.level(size).terms
        if 0 < (mistakes := count_mistakes(term.bits)) <= MOST_MISTAKES
    ]
    if not found:
        return None
    nats, best = min(found, key=lambda row: (row[0], row[1].key))
    own = NODE * size_of(extractor) + MISTAKE * count_mistakes(field.term(extractor).bits & shown)
    share = 1 / (1 + math.exp(nats - own))
    place = next(place for place, (errors, _) in enumerate(counters) if errors.count(best.bits))
    differs = compare_selection(best.extractor, field, examples, place)
    return LikelyMistake(differs.asset, differs.extra, differs.missing, best.extractor, share)
