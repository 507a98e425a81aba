"""The smallest extractor that selects on every example what was shown (paper, algorithm SynthesizeExtractor)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from meshforge.language import EXTREMITY, Extractor
from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Options
from meshforge.synthesis.search.atoms import atoms, packed, singles, split_by
from meshforge.synthesis.search.bank import Bank
from meshforge.synthesis.search.completion import Completion, Goal
from meshforge.synthesis.search.leaves import Leaf, leaves, observed
from meshforge.synthesis.search.miss import NearMiss, lookalikes, near_miss, nearest_term
from meshforge.synthesis.search.order import leaf_key
from meshforge.synthesis.search.space import Space
from meshforge.synthesis.search.term import Term
from meshforge.synthesis.watch import OutOfTime, Watch

NEAR_SIZE = 5
"""Where nothing matches, the nearest miss is looked for among all selections of extractors up to this size."""


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
    """One rule's examples, prepared: selections of all of them as one bit set, over hulls or groups of like hulls.

    vocabulary: the labels to ask for, in the order in which they are preferred.
    """

    def __init__(
        self,
        examples: Sequence[Example],
        vocabulary: Sequence[str],
        watch: Watch,
        options: Options,
        extremity: float = EXTREMITY,
    ) -> None:
        self.examples = tuple(examples)
        self.space = Space([example.mesh for example in examples])
        self.target = self.space.join(example.selection for example in examples)
        self.options = options
        chosen = leaves(vocabulary, options.layers)
        by_mesh = [observed(chosen, mesh, extremity) for mesh in self.space.meshes]
        masks = [self.space.join(column) for column in zip(*by_mesh, strict=True)]
        every, shortcuts = self.space.everything, options.shortcuts
        self.alike = atoms(masks, every)
        self.groups = self.alike if shortcuts.group else singles(every)
        terms = _terms(chosen, [packed(mask, self.groups) for mask in masks], vocabulary)
        self.bank = Bank(terms, len(self.groups), watch, shortcuts.merge)
        self.completion = Completion(self.bank, watch, shortcuts)
        self._exhausted = 0

    def run(self) -> Answer:
        """The answer, within the limits of the options and the watch."""
        try:
            return self._hit() or self._miss()
        except OutOfTime:
            return Unfinished(self._nearest(), self.tried)

    @property
    def tried(self) -> Tried:
        kept = sum(len(level.terms) for level in self.bank.levels)
        return Tried(self._exhausted, kept, self.completion.goals)

    def _hit(self) -> Hit | None:
        if split_by(self.target, self.groups):
            return None
        need = packed(self.target, self.groups)
        goal = Goal(need, ((1 << len(self.groups)) - 1) & ~need)
        for size in range(1, self.options.max_size + 1):
            term = self.completion.first(goal, size)
            if term:
                return Hit(term.extractor, self.tried)
            self._exhausted = size
        return None

    def _miss(self) -> Miss:
        self.bank.level(NEAR_SIZE)
        why = lookalikes(self.alike, self.target, self.examples, self.space)
        nearest = self._nearest()
        assert nearest, "a bank with a target has terms: All selects something"
        return Miss(why or f"no extractor of up to {self.options.max_size} nodes matches", nearest, self.tried)

    def _nearest(self) -> NearMiss | None:
        terms = (term for level in self.bank.levels for term in level.terms)
        term = nearest_term(terms, self.groups, self.target)
        return near_miss(term, self.groups, self.target, self.examples, self.space) if term else None


def _terms(chosen: Sequence[Leaf], masks: Sequence[int], vocabulary: Sequence[str]) -> list[Term]:
    places = {label: place for place, label in enumerate(vocabulary)}
    return [Term(mask, leaf_key(leaf, places), leaf) for leaf, mask in zip(chosen, masks, strict=True)]
