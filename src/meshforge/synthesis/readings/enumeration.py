"""Every extractor up to some size that selects what was shown, one for each way of selecting on the batch."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass

from meshforge.language import Extractor
from meshforge.symbolic import mask_of
from meshforge.synthesis.options import OutOfTime
from meshforge.synthesis.search.bank import Bank
from meshforge.synthesis.search.completion import Goal, HalfTerm, half_terms_for, satisfies, terms_for
from meshforge.synthesis.search.smallest import Search
from meshforge.synthesis.search.terms import Key, Term

LOOKUP_COST = 8
"""What it takes to look for operands, in operands."""
TermDraft = tuple[int, Key, HalfTerm | None, Term]
"""What a term selects, its place in the order, and the term; or a set operator over it, still to be put together."""


@dataclass(frozen=True, slots=True)
class ConsistentTerms:
    """Terms that agree with all demonstrations, no two selecting the same on the whole field, in their order.

    size: all of up to so many nodes are there; complete: whether that is as far as was asked for.
    """

    terms: tuple[Term, ...]
    size: int
    complete: bool


class _EffortSpent(Exception):  # noqa: N818 (not an error: the way out of an endless task)
    """So many operands were looked at that the rest is left."""


def enumerate_consistent(search: Search, answer: Extractor, above: int) -> ConsistentTerms:
    """All consistent terms over the field of a search, from those as small as its `answer` to `above` nodes more.

    None is larger than `options.max_size`: it could not be learned once a person says that it is meant. Sizes that
    take more than `options.effort` operands are left out, and those above them; so are all that the time does not
    suffice for.
    """
    first, collector = search.field.term(answer), _Collector(search)
    found, last = {first.bits: first}, min(first.size + above, search.options.max_size)
    for size in range(first.size, last + 1):
        try:
            found.update(collector.terms_of_size(size, found))
        except (_EffortSpent, OutOfTime):
            return ConsistentTerms(_sort_terms(found), size - 1, False)
    return ConsistentTerms(_sort_terms(found), last, True)


def _sort_terms(found: dict[int, Term]) -> tuple[Term, ...]:
    return tuple(sorted(found.values(), key=lambda term: term.key))


class _Collector:
    """Puts consistent terms together: one operand from the bank, the other by the goal that is left for it."""

    def __init__(self, search: Search) -> None:
        shortcuts = search.options.shortcuts
        self._need, self._shown = search.need, (1 << search.width) - 1
        decisive = mask_of(search.decisive)
        self._goal = Goal(search.need & decisive, decisive & ~search.need)
        self._budget, self._left = search.budget, search.options.effort
        self._stored = max(shortcuts.stored, 1)
        self._bank = Bank(search.field.terms, search.field.width, search.budget)
        self._known: dict[tuple[Goal, int], tuple[Term, ...]] = {}

    def terms_of_size(self, size: int, known: Container[int]) -> dict[int, Term]:
        """The consistent terms of that size which select something that no known one does, each the first to do so."""
        drafts = (d for d in self._drafts(self._goal, size) if d[0] & self._shown == self._need and d[0] not in known)
        return {term.bits: term for term in _keep_firsts(drafts)}

    def _drafts(self, goal: Goal, size: int) -> Iterator[TermDraft]:
        """Everything of that size that meets a goal."""
        for leaf in self._bank.leaves(size):
            if satisfies(leaf.bits, goal):
                yield leaf.bits, leaf.key, None, leaf
        for small in range(1, (size - 1) // 2 + 1):
            self._budget.check()
            for half in half_terms_for(self._bank.level(small), goal, helpful=False):
                for other in self._operands(half.rest, size - 1 - small):
                    yield half.bits(other.bits), half.key(other.key), half, other

    def _operands(self, goal: Goal, size: int) -> Iterable[Term]:
        """The terms of that size that meet a goal, one for each way of selecting."""
        if size > self._stored:
            if (goal, size) not in self._known:
                self._known[goal, size] = _keep_firsts(self._drafts(goal, size))
            found: Iterable[Term] = self._known[goal, size]
        else:
            found = terms_for(self._bank.level(size), goal)
        self._left -= LOOKUP_COST
        for term in found:
            self._left -= 1
            if self._left < 0:
                raise _EffortSpent
            yield term


def _keep_firsts(drafts: Iterable[TermDraft]) -> tuple[Term, ...]:
    """One term for each way of selecting, the first in the order."""
    best: dict[int, tuple[Key, HalfTerm | None, Term]] = {}
    for bits, key, half, term in drafts:
        if bits not in best or key < best[bits][0]:
            best[bits] = (key, half, term)
    return tuple(half.complete(term) if half else term for _, half, term in best.values())
