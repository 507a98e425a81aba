"""The readings of one rule, weighed: which one the program takes, where the others differ, what to ask."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

from meshforge.language import Extractor
from meshforge.synthesis.readings.belief import beliefs, taken
from meshforge.synthesis.readings.doubt import Doubt, Split
from meshforge.synthesis.readings.every import Consistent
from meshforge.synthesis.readings.evidence import evidence, unneeded
from meshforge.synthesis.search.smallest import Search
from meshforge.synthesis.search.term import Term

BELIEVABLE = 0.005
"""Readings below this belief are listed, but neither asked about nor able to unsettle a result."""
COMPARED = 64
"""At most so many readings are compared with each other."""


class Weighed:
    """Consistent terms over the field of a search: first the one that the rule takes, then the more believable.

    refused: places of meshes, and hulls on them that a person said are not what is meant, as bit sets.
    """

    def __init__(self, search: Search, consistent: Consistent, refused: Sequence[tuple[int, int]] = ()) -> None:
        terms, field = consistent.terms, search.field
        many = len(terms) > 1
        found = evidence(field, search.selections, [term.bits for term in terms]) if many else ()
        assets = len(field.meshes) - len(search.examples)
        against = [sum(field.on(term.bits, mesh) == mask for mesh, mask in refused) for term in terms]
        shown = (1 << search.width) - 1
        idle = [unneeded(term, shown, field) for term in terms]
        shares = beliefs(terms, found, shown, assets, against, idle) if many else (1.0,)
        head = taken(terms, shares)
        order = sorted(range(len(terms)), key=lambda k: (k != head, -shares[k], k))
        self.field, self.consistent, self.examples = field, consistent, search.examples
        self.terms: tuple[Term, ...] = tuple(terms[k] for k in order)
        self.beliefs = tuple(shares[k] for k in order)

    @staticmethod
    def of_single(search: Search, extractor: Extractor) -> Weighed:
        """One extractor, whatever else is consistent."""
        term = search.field.term(extractor)
        return Weighed(search, Consistent((term,), term.size, False))

    @property
    def extractor(self) -> Extractor:
        return self.terms[0].extractor

    @property
    def believable(self) -> Sequence[int]:
        """Places of the readings that are to be reckoned with."""
        return range(1 + sum(belief >= BELIEVABLE for belief in self.beliefs[1:COMPARED]))

    @property
    def compared(self) -> Sequence[int]:
        """Places of the readings that are compared with the one that is taken."""
        return range(1, min(len(self.terms), COMPARED))

    @cached_property
    def question_value(self) -> Doubt:
        rows = [[self.terms[k].bits & present for present in self.field.present] for k in self.believable]
        return Doubt(rows, [self.beliefs[k] for k in self.believable])

    @property
    def settled(self) -> bool:
        """Whether all believable readings do the same on the whole batch; never where not all are known."""
        return self.consistent.complete and len(self.believable) == 1

    def differences(self, reading: int) -> tuple[int, ...]:
        """Places of the meshes on which a reading selects something else than the one that is taken."""
        other = self.terms[reading].bits ^ self.terms[0].bits
        return tuple(k for k, present in enumerate(self.field.present) if other & present)

    def best_question(self, trust: Mapping[int, float]) -> Split | None:
        """The best question about an asset of the batch.

        trust: places of the meshes that it may be about, with how much an answer about each is worth.
        """
        return self.question_value.best_question({place: worth for place, worth in trust.items() if place >= len(self.examples)})
