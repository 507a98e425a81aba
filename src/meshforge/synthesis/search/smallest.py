"""The smallest extractor that selects on every example what was shown (paper, algorithm SynthesizeExtractor); where
none does, the nearest one and how it differs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from meshforge.language import Extractor
from meshforge.symbolic import SymbolicMesh, mask_of
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, OutOfTime, TimeBudget
from meshforge.synthesis.search.bank import Bank, Completion, SearchTarget, positions
from meshforge.synthesis.search.observation_table import ObservationTable
from meshforge.synthesis.search.terms import Term

NEAREST_SIZE = 5
"""Where nothing matches, the nearest miss is looked for among all selections of extractors up to this size."""

_NEAREST_SIZE_LATE = 4
"""Where the time ran out, only up to this size."""

_MAX_COUNTEREXAMPLES = 16  # groups that join the search when its answer is wrong on them


@dataclass(frozen=True, slots=True)
class SearchEffort:
    """How far a search went: all sizes up to `size`, selections kept, goals of missing operands followed."""

    size: int
    selections: int
    goals: int


@dataclass(frozen=True, slots=True)
class Hit:
    """The smallest extractor, of those the most believable in the order."""

    extractor: Extractor
    tried: SearchEffort


@dataclass(frozen=True, slots=True)
class Miss:
    """No extractor within the limits; why: one sentence for the user."""

    why: str
    nearest: "NearestExtractor"
    tried: SearchEffort


@dataclass(frozen=True, slots=True)
class Unfinished:
    """The time ran out; nearest: the nearest miss so far."""

    nearest: "NearestExtractor | None"
    tried: SearchEffort


SearchResult = Hit | Miss | Unfinished


class Search:
    """One rule's examples, prepared: the selections of all of them as one bit set over groups of like hulls.

    vocabulary: the labels to ask for, in the order in which they are preferred; batch: further meshes in the field,
    about which nothing is said.
    """

    def __init__(
        self,
        examples: Sequence[Example],
        vocabulary: Sequence[str],
        budget: TimeBudget,
        options: Options,
        batch: Sequence[SymbolicMesh] = (),
    ) -> None:
        self.examples, self.options, self.budget = tuple(examples), options, budget
        self.selections = tuple(example.selection for example in examples)
        meshes = [*(example.mesh for example in examples), *batch]
        self.field = ObservationTable(meshes, vocabulary, options.layers, options.geo_extremity, options.leaves)
        self.width = self.field.width_of(len(examples))
        self.need = self.field.groups_in(self.selections)
        self._exhausted = self._kept = self._goals = 0

    def run(self) -> SearchResult:
        """Return the answer, within the limits of the options and the budget."""
        try:
            return self.find_hit() or self._report_miss()
        except OutOfTime:
            return Unfinished(
                self._find_nearest(min(self._exhausted, _NEAREST_SIZE_LATE), TimeBudget(math.inf)), self.tried
            )

    @property
    def tried(self) -> SearchEffort:
        return SearchEffort(self._exhausted, self._kept, self._goals)

    @cached_property
    def decisive(self) -> tuple[int, ...]:
        """The groups of demonstrated hulls that the search begins with: as many selected as not, if there are many."""
        few, every = self.options.few, range(self.width)
        if not few or self.width <= few:
            return tuple(every)
        shown = [group for group in every if self.need >> group & 1][: few // 2]
        return tuple(sorted([*shown, *[g for g in every if not self.need >> g & 1][: few - len(shown)]]))

    def find_hit(self) -> Hit | None:
        """Return the smallest extractor, None where there is none within the limits: what comes nearest is not looked
        for.

        Raises OutOfTime.
        """
        if self.field.find_conflict(self.selections):
            return None
        while True:
            extractor = self._find_smallest()
            if extractor is None:
                return None
            wrong = (self.field.bits(extractor) ^ self.need) & ((1 << self.width) - 1)
            if not wrong:
                return Hit(extractor, self.tried)
            self.decisive = tuple(sorted({*self.decisive, *list(positions(wrong))[:_MAX_COUNTEREXAMPLES]}))

    def _find_smallest(self) -> Extractor | None:
        groups = self.decisive
        whole = groups == tuple(range(self.width))
        terms = [Term(_pack(t.bits, groups, whole), t.key, t.form) for t in self.field.terms]
        bank = Bank(terms, len(groups), self.budget)
        completion = Completion(bank, self.budget, self.options.stored)
        need = _pack(self.need, groups, whole)
        target = SearchTarget(need, ((1 << len(groups)) - 1) & ~need)
        try:
            for size in range(1 + self._exhausted, self.options.max_size + 1):
                term = completion.find_first(target, size)
                if term:
                    return term.extractor
                self._exhausted = size
            return None
        finally:
            self._kept += sum(len(level.terms) for level in bank.levels)
            self._goals += completion.goals

    def _report_miss(self) -> Miss:
        why = describe_conflict(self.field, self.selections, self.examples)
        nearest = self._find_nearest(NEAREST_SIZE, self.budget)
        assert nearest, "a bank with a target has terms: All selects something"
        return Miss(why or f"no extractor of up to {self.options.max_size} nodes matches", nearest, self.tried)

    def _find_nearest(self, size: int, budget: TimeBudget) -> "NearestExtractor | None":
        terms = [Term(t.bits & ((1 << self.width) - 1), t.key, t.form) for t in self.field.terms]
        bank = Bank(terms, self.width, budget)
        levels = [bank.level(k) for k in range(1, size + 1)]
        errors = ErrorCounter(self.selections, self.field.groups, self.width)
        made = (term for level in levels for term in level.terms)
        term = min(made, key=lambda term: (errors.count(term.bits), term.key), default=None)
        return compare_nearest(term.extractor, self.field, self.examples) if term else None


def _pack(bits: int, groups: Sequence[int], whole: bool) -> int:
    if whole:
        return bits & ((1 << len(groups)) - 1)
    return mask_of(place for place, group in enumerate(groups) if bits >> group & 1)


@dataclass(frozen=True, slots=True)
class NearestExtractor:
    """An extractor that nearly matches, and how it differs on the mesh where it differs most.

    extra: names of hulls it selects though they were not shown; missing: names of those it leaves out.
    """

    extractor: Extractor
    asset: str
    extra: tuple[str, ...]
    missing: tuple[str, ...]


class ErrorCounter:
    """Counts the demonstrated hulls on which a selection of groups is wrong.

    The weights of all groups are kept as planes of binary digits, so that a count takes a few operations on bit sets.
    """

    def __init__(self, selections: Sequence[int], groups_of: Sequence[Sequence[int]], width: int) -> None:
        shown, others = [0] * width, [0] * width
        for mask, groups in zip(selections, groups_of, strict=False):
            for hull, group in enumerate(groups):
                (shown if mask >> hull & 1 else others)[group] += 1
        self._missed, self._extra = _to_planes(shown), _to_planes(others)

    def count(self, chosen: int) -> int:
        """Return how many hulls a selection of groups has too many or too few."""
        extra = sum((chosen & plane).bit_count() << k for k, plane in enumerate(self._extra))
        return extra + sum((~chosen & plane).bit_count() << k for k, plane in enumerate(self._missed))


def compare_nearest(extractor: Extractor, field: ObservationTable, examples: Sequence[Example]) -> NearestExtractor:
    """Return where and how an extractor's selection differs from what was shown, on the mesh where it differs most."""
    found = field.bits(extractor)
    wrong = [(field.on(found, k) ^ one.selection).bit_count() for k, one in enumerate(examples)]
    return compare_selection(extractor, field, examples, wrong.index(max(wrong)))


def compare_selection(
    extractor: Extractor, field: ObservationTable, examples: Sequence[Example], place: int
) -> NearestExtractor:
    """Return how an extractor's selection differs from what was shown on one mesh."""
    example, found = examples[place], field.on(field.bits(extractor), place)
    extra, missing = found & ~example.selection, example.selection & ~found
    names_of = example.mesh.names_of
    return NearestExtractor(extractor, example.name, names_of(extra), names_of(missing))


def describe_conflict(field: ObservationTable, selections: Sequence[int], examples: Sequence[Example]) -> str | None:
    """Return a sentence on two hulls that no extractor tells apart though only one of them was selected."""
    found = field.find_conflict(selections)
    if not found:
        return None
    shown, other = (f"{examples[mesh].mesh.hulls[hull].name!r} of {examples[mesh].name}" for mesh, hull in found)
    return (
        f"{shown} was selected and {other} was not, yet every extractor treats them alike; "
        "a label of its own for one of them would tell them apart"
    )


def _to_planes(weights: Sequence[int]) -> list[int]:
    """Bit set k holds the positions whose weight has binary digit k."""
    return [
        sum(1 << place for place, weight in enumerate(weights) if weight >> k & 1)
        for k in range(max(weights, default=0).bit_length())
    ]
