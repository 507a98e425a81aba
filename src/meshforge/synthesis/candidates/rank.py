"""The readings of one rule: every extractor up to some size that selects what was shown, ranked; which one the program
takes, where the others differ, and the question that tells them apart."""

import math
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshforge.geometry import Floats
from meshforge.language import Extractor
from meshforge.symbolic import mask_of
from meshforge.synthesis.candidates.belief import choose_candidate, compute_beliefs, count_idle, measure_evidence
from meshforge.synthesis.options import OutOfTime
from meshforge.synthesis.search.bank import Bank, HalfTerm, SearchTarget, half_terms_for, rows_for, satisfies
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
    """Return all consistent terms over the field of a search, from those as small as its `answer` to `above` nodes
    more.

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
    """Puts consistent terms together: one operand from the bank, the other by the target that is left for it."""

    def __init__(self, search: Search) -> None:
        self._need, self._shown = search.need, (1 << search.width) - 1
        decisive = mask_of(search.decisive)
        self._target = SearchTarget(search.need & decisive, decisive & ~search.need)
        self._budget, self._left = search.budget, search.options.effort
        self._stored = max(search.options.stored, 1)
        self._bank = Bank(search.field.terms, search.field.width, search.budget)
        self._known: dict[tuple[SearchTarget, int], tuple[Term, ...]] = {}

    def terms_of_size(self, size: int, known: Container[int]) -> dict[int, Term]:
        drafts = (d for d in self._drafts(self._target, size) if d[0] & self._shown == self._need and d[0] not in known)
        return {term.bits: term for term in _keep_firsts(drafts)}

    def _drafts(self, target: SearchTarget, size: int) -> Iterator[TermDraft]:
        for leaf in self._bank.leaves(size):
            if satisfies(leaf.bits, target):
                yield leaf.bits, leaf.key, None, leaf
        for small in range(1, (size - 1) // 2 + 1):
            self._budget.check()
            for half in half_terms_for(self._bank.level(small), target, helpful=False):
                for other in self._operands(half.rest, size - 1 - small):
                    yield half.bits(other.bits), half.key(other.key), half, other

    def _operands(self, target: SearchTarget, size: int) -> Iterable[Term]:
        found: Iterable[Term]
        if size > self._stored:
            if (target, size) not in self._known:
                self._known[target, size] = _keep_firsts(self._drafts(target, size))
            found = self._known[target, size]
            count = len(found)
        else:
            level = self._bank.level(size)
            rows = rows_for(level, target)
            found, count = level.select_rows(rows) if rows else (), rows.bit_count()
        self._left -= LOOKUP_COST + count
        if count and self._left < 0:
            raise _EffortSpent
        return found


def _keep_firsts(drafts: Iterable[TermDraft]) -> tuple[Term, ...]:
    best: dict[int, tuple[Key, HalfTerm | None, Term]] = {}
    for bits, key, half, term in drafts:
        if bits not in best or key < best[bits][0]:
            best[bits] = (key, half, term)
    return tuple(half.complete(term) if half else term for _, half, term in best.values())


BELIEVABLE = 0.005
"""Readings below this belief are listed, but neither asked about nor able to unsettle a result."""
MAX_COMPARED = 64
"""At most so many readings are compared with each other."""

SAMPLE_SEEN = 12
"""So many results a person looks at before accepting a program (paper, protocol): what differs on many assets is seen,
what differs on few is likely not."""
UNSEEN_COST = 1.0
"""What a wrong program that is accepted costs above one that is seen, in demonstrations; that one costs one. Little,
since the results that are looked at are chosen so that they show it."""
QUESTION_PRICE = 0.4
"""What a question must spare to be asked, in demonstrations. Measured on the calibration set of the benchmark
(`script/bench tuning`), where demonstrators look at the results that are proposed: all of 120 sessions end right with
any price; demonstrations plus answers are 2.2 a task, 1.9 at a price of 0.5, 2.9 at 0.25, a person's time as modelled
61, 63 and 51 s."""
MAX_CHOICES = 3
"""A person compares so many pictures at once; "neither" stands for all other readings."""


class Preference(NamedTuple):
    """What a person said of a selection on a mesh, which no reading has to keep to.

    mesh: its place; mask: the hulls, as a bit set; price: of a reading that does otherwise [nats]; is_meant: whether
    that selection is meant, or is not.
    """

    mesh: int
    mask: int
    price: float
    is_meant: bool


class RankedCandidates:
    """Consistent terms over the field of a search: first the one that the rule takes, then the more believable.

    preferences: what else a person said.
    """

    def __init__(self, search: Search, consistent: ConsistentTerms, preferences: Sequence[Preference] = ()) -> None:
        terms, field = consistent.terms, search.field
        many = len(terms) > 1
        found = measure_evidence(field, search.selections, [term.bits for term in terms]) if many else ()
        assets = len(field.meshes) - len(search.examples)
        against = [
            math.fsum(one.price for one in preferences if (field.on(term.bits, one.mesh) == one.mask) != one.is_meant)
            for term in terms
        ]
        shown = (1 << search.width) - 1
        idle = [count_idle(term, shown, field) for term in terms]
        shares = compute_beliefs(terms, found, shown, assets, against, idle) if many else (1.0,)
        head = choose_candidate(terms, shares)
        order = sorted(range(len(terms)), key=lambda k: (k != head, -shares[k], k))
        self.field, self.consistent, self.examples = field, consistent, search.examples
        self.terms: tuple[Term, ...] = tuple(terms[k] for k in order)
        self.beliefs = tuple(shares[k] for k in order)

    @staticmethod
    def of_single(search: Search, extractor: Extractor) -> "RankedCandidates":
        """Return one extractor, whatever else is consistent."""
        term = search.field.term(extractor)
        return RankedCandidates(search, ConsistentTerms((term,), term.size, False))

    @property
    def extractor(self) -> Extractor:
        return self.terms[0].extractor

    @property
    def believable(self) -> Sequence[int]:
        """Places of the readings that are to be reckoned with."""
        return range(1 + sum(belief >= BELIEVABLE for belief in self.beliefs[1:MAX_COMPARED]))

    @property
    def unambiguous(self) -> bool:
        """Whether all believable readings do the same on the whole batch; never where not all are known."""
        return self.consistent.complete and len(self.believable) == 1

    def differences(self, candidate: int) -> tuple[int, ...]:
        """Return places of the meshes on which a reading selects something else than the one that is taken."""
        other = self.terms[candidate].bits ^ self.terms[0].bits
        return tuple(k for k, present in enumerate(self.field.present) if other & present)

    def best_question(self, trust: Mapping[int, float]) -> "QuestionSplit | None":
        """Return the best question about an asset of the batch.

        trust: places of the meshes that it may be about, with how much an answer about each is worth.
        """
        rows = [[self.terms[k].bits & present for present in self.field.present] for k in self.believable]
        value = QuestionValue(rows, [self.beliefs[k] for k in self.believable])
        return value.best_question({place: worth for place, worth in trust.items() if place >= len(self.examples)})


@dataclass(frozen=True, slots=True)
class QuestionSplit:
    """An asset on which readings differ.

    asset: its place; choices: places of the most believed reading of each choice, the most believed choice first; what
    the program does is one of them.
    spared: what the answer is worth, in demonstrations.
    """

    asset: int
    choices: tuple[int, ...]
    spared: float

    @property
    def is_worth_asking(self) -> bool:
        return self.spared > QUESTION_PRICE


class QuestionValue:
    """Some readings of one rule over the assets of a batch, of which the first is the one that the program has.

    selections: for each reading, what it selects on each asset, in any form that can be compared; beliefs: of each.
    """

    def __init__(self, selections: Sequence[Sequence[object]], beliefs: Sequence[float]) -> None:
        columns = [_number(column) for column in zip(*selections, strict=True)]
        self._kinds = np.array(columns, dtype=np.int64).reshape(-1, len(beliefs)).T
        self._beliefs = np.array(beliefs)
        self._costs: Floats | None = None  # of having one reading where another is meant, in demonstrations
        if columns:
            differs = (self._kinds[:, None] != self._kinds[None]).mean(axis=2)
            self._costs = np.where(differs > 0, 1 + UNSEEN_COST * (1 - differs) ** SAMPLE_SEEN, 0.0)

    def best_question(self, trust: Mapping[int, float]) -> QuestionSplit | None:
        """Return the question that spares most; of equals, the first.

        trust: the assets that can be asked about, with how much an answer there is worth: where labels are wrong, what
        is right to say is what no reading does.
        """
        splits = (split for asset in trust if (split := self._split(asset)))
        return min(splits, key=lambda one: (-round(one.spared * trust[one.asset], 12), one.asset), default=None)

    def _split(self, asset: int) -> QuestionSplit | None:
        assert self._costs is not None
        kinds = self._kinds[:, asset]
        if not kinds.any():
            return None
        choices_by_belief, spared = [], float(self._beliefs @ self._costs[0])
        for kind in range(int(kinds.max()) + 1):
            part = np.flatnonzero(kinds == kind)
            heads = part[np.argmax(self._beliefs[part])] if kind else 0
            spared -= float(self._beliefs[part] @ self._costs[heads][part])
            choices_by_belief.append((-float(self._beliefs[part].sum()), int(heads)))
        ours, *others = choices_by_belief
        choices = sorted([ours, *sorted(others)[: MAX_CHOICES - 1]])
        return QuestionSplit(asset, tuple(head for _, head in choices), spared)


def _number(column: Sequence[object]) -> list[int]:
    """Equal entries get equal numbers, the first 0, the next new one 1."""
    numbers: dict[object, int] = {}
    return [numbers.setdefault(entry, len(numbers)) for entry in column]
