"""The smallest extractor that selects on every example what was shown (paper, algorithm SynthesizeExtractor)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from meshforge.language import EXTREMITY, Extractor
from meshforge.symbolic import SymbolicMesh, mask_of
from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Options
from meshforge.synthesis.search.bank import Bank
from meshforge.synthesis.search.columns import positions
from meshforge.synthesis.search.completion import Completion, Goal
from meshforge.synthesis.search.field import Field
from meshforge.synthesis.search.miss import Errors, NearMiss, lookalikes, near_miss
from meshforge.synthesis.search.term import Term
from meshforge.synthesis.watch import OutOfTime, Watch

NEAR_SIZE = 5
"""Where nothing matches, the nearest miss is looked for among all selections of extractors up to this size."""

_HASTY = 4
"""The same where the time ran out."""

_REFUTING = 16  # groups that join the search when its answer is wrong on them


@dataclass(frozen=True, slots=True)
class Tried:
    """How far a search went: all sizes up to `size`, selections kept, goals of missing operands followed."""

    size: int
    selections: int
    goals: int


@dataclass(frozen=True, slots=True)
class Hit:
    """The smallest extractor, of those the most believable in the order."""

    extractor: Extractor
    tried: Tried


@dataclass(frozen=True, slots=True)
class Miss:
    """No extractor within the limits; why: one sentence for the user."""

    why: str
    nearest: NearMiss
    tried: Tried


@dataclass(frozen=True, slots=True)
class Unfinished:
    """The time ran out; nearest: the nearest miss so far."""

    nearest: NearMiss | None
    tried: Tried


Answer = Hit | Miss | Unfinished


class Search:
    """One rule's examples, prepared: the selections of all of them as one bit set over groups of like hulls.

    vocabulary: the labels to ask for, in the order in which they are preferred; batch: further meshes in the field,
    about which nothing is said.
    """

    def __init__(
        self,
        examples: Sequence[Example],
        vocabulary: Sequence[str],
        watch: Watch,
        options: Options,
        extremity: float = EXTREMITY,
        batch: Sequence[SymbolicMesh] = (),
    ) -> None:
        self.examples, self.options, self.watch = tuple(examples), options, watch
        self.selections = tuple(example.selection for example in examples)
        meshes = [*(example.mesh for example in examples), *batch]
        self.field = Field(meshes, vocabulary, options.layers, extremity, options.shortcuts.group)
        self.width = self.field.width_of(len(examples))
        self.need = self.field.groups_in(self.selections)
        self._exhausted = self._kept = self._goals = 0

    def run(self) -> Answer:
        """The answer, within the limits of the options and the watch."""
        try:
            return self._find_hit() or self._report_miss()
        except OutOfTime:
            return Unfinished(self._find_nearest(min(self._exhausted, _HASTY), Watch(math.inf)), self.tried)

    @property
    def tried(self) -> Tried:
        return Tried(self._exhausted, self._kept, self._goals)

    @cached_property
    def decisive(self) -> tuple[int, ...]:
        """The groups of demonstrated hulls that the search begins with: as many selected as not, if there are many."""
        few, every = self.options.shortcuts.few, range(self.width)
        if not few or self.width <= few:
            return tuple(every)
        shown = [group for group in every if self.need >> group & 1][: few // 2]
        return tuple(sorted([*shown, *[g for g in every if not self.need >> g & 1][: few - len(shown)]]))

    def _find_hit(self) -> Hit | None:
        if self.options.shortcuts.group and self.field.find_conflict(self.selections):
            return None
        while True:
            extractor = self._find_smallest()
            if extractor is None:
                return None
            wrong = (self.field.bits(extractor) ^ self.need) & ((1 << self.width) - 1)
            if not wrong:
                return Hit(extractor, self.tried)
            refuting = list(positions(wrong))[:_REFUTING]
            self.decisive = tuple(sorted({*self.decisive, *refuting}))

    def _find_smallest(self) -> Extractor | None:
        """The first extractor that is right on the decisive groups."""
        groups, shortcuts = self.decisive, self.options.shortcuts
        whole = groups == tuple(range(self.width))
        terms = [Term(_packed(t.bits, groups, whole), t.key, t.form) for t in self.field.terms]
        bank = Bank(terms, len(groups), self.watch, shortcuts.merge)
        completion = Completion(bank, self.watch, shortcuts)
        need = _packed(self.need, groups, whole)
        goal = Goal(need, ((1 << len(groups)) - 1) & ~need)
        try:
            for size in range(1 + self._exhausted, self.options.max_size + 1):
                term = completion.find_first(goal, size)
                if term:
                    return term.extractor
                self._exhausted = size
            return None
        finally:
            self._kept += sum(len(level.terms) for level in bank.levels)
            self._goals += completion.goals

    def _report_miss(self) -> Miss:
        why = lookalikes(self.field, self.selections, self.examples)
        nearest = self._find_nearest(NEAR_SIZE, self.watch)
        assert nearest, "a bank with a target has terms: All selects something"
        return Miss(why or f"no extractor of up to {self.options.max_size} nodes matches", nearest, self.tried)

    def _find_nearest(self, size: int, watch: Watch) -> NearMiss | None:
        """The nearest miss among extractors of up to some size."""
        terms = [Term(t.bits & ((1 << self.width) - 1), t.key, t.form) for t in self.field.terms]
        bank = Bank(terms, self.width, watch)
        levels = [bank.level(k) for k in range(1, size + 1)]
        errors = Errors(self.field, self.selections, self.width)
        made = (term for level in levels for term in level.terms)
        term = min(made, key=lambda term: (errors.count(term.bits), term.key), default=None)
        return near_miss(term.extractor, self.field, self.examples) if term else None


def _packed(bits: int, groups: Sequence[int], whole: bool) -> int:
    """The bits of some groups, moved together."""
    if whole:
        return bits & ((1 << len(groups)) - 1)
    return mask_of(place for place, group in enumerate(groups) if bits >> group & 1)
