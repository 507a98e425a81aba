"""Explains what was shown by a program and wrong labels, where that is more believable than a program alone."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import log
from types import MappingProxyType

from meshforge.language import EXTREMITY, Extractor, size
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Options
from meshforge.synthesis.repair import weights
from meshforge.synthesis.repair.choice import Place, beliefs, changes, ranked
from meshforge.synthesis.repair.explanation import Explanation
from meshforge.synthesis.repair.larger import larger
from meshforge.synthesis.repair.matching import Candidate, chance, key_cost, matching
from meshforge.synthesis.repair.relabelings import correction, relabelings
from meshforge.synthesis.repair.standing import Labels, is_human
from meshforge.synthesis.repair.variants import Variants
from meshforge.synthesis.repair.whys import why
from meshforge.synthesis.search.order import order
from meshforge.synthesis.watch import Watch

SMALL = 5
"""Nodes up to which all extractors are looked at under all relabelings."""

RELABELINGS = 1500
"""Relabelings that are looked at, of all examples; single corrections always are."""

_NOTHING: Mapping[str, int] = MappingProxyType({})


def explain(
    examples: Sequence[Example],
    vocabulary: Sequence[str],
    labels: Labels,
    options: Options,
    watch: Watch,
    extremity: float = EXTREMITY,
    exact: Extractor | None = None,
    spent: Mapping[str, int] = _NOTHING,
    rejected: Collection[Correction] = (),
) -> Explanation | None:
    """The most believable extractor with corrections of labels, None where what is exact is as believable.

    vocabulary: the labels to ask for and to correct to; exact: the smallest extractor that needs no correction, None
    where there is none; spent: corrections made before for other rules, by the name of the mesh; rejected:
    corrections not to propose. Raises OutOfTime.
    """
    some = tuple(example for example in examples if example.mesh.hulls)
    return _Case(some, vocabulary, labels, options, watch, extremity, exact, spent, rejected).explain()


@dataclass(frozen=True, eq=False)
class _Case:
    """One rule that may have been shown on wrong labels."""

    examples: Sequence[Example]
    vocabulary: Sequence[str]
    labels: Labels
    options: Options
    watch: Watch
    extremity: float
    exact: Extractor | None
    spent: Mapping[str, int]
    rejected: Collection[Correction]

    def explain(self) -> Explanation | None:
        variants = self._build_variants()
        if variants is None or not all(variants.by_example):
            return None
        candidates = self._find_candidates(variants)
        sure = beliefs(candidates, self._rival_cost(variants))
        chosen = self._choose(ranked(candidates), sure)
        return self._to_explanation(chosen, sure) if chosen else None

    @cached_property
    def _exact_cost(self) -> float:
        """What it costs to believe in the exact extractor, or in none at all [nats]."""
        places = {label: place for place, label in enumerate(self.vocabulary)}
        return key_cost(order(self.exact, places)) if self.exact else weights.NOTHING

    @property
    def _limit(self) -> int:
        """Nodes that an explanation may have."""
        return min(self.options.max_size, size(self.exact) - 1 if self.exact else self.options.max_size)

    def _build_variants(self) -> Variants | None:
        """None where no label can be corrected."""
        within = self._exact_cost - weights.NODE
        room = RELABELINGS // max(1, len(self.examples))
        ways = [
            relabelings(example, self.vocabulary, self.labels, self._count_allowed(example), self.rejected, within, room)
            for example in self.examples
        ]
        if not any(len(some) > 1 for some in ways):
            return None
        return Variants(self.examples, ways, self.vocabulary, self.options.layers, self.extremity)

    def _count_allowed(self, example: Example) -> int:
        """Corrections that the mesh has left; none where it has no label at all, as any would do as well."""
        if not any(hull.label for hull in example.mesh.hulls):
            return 0
        return self.options.eta - self.spent.get(example.name, 0)

    def _find_candidates(self, variants: Variants) -> list[Candidate]:
        above = min(SMALL, self._limit)
        found = list(matching(variants, above, self._exact_cost, self.watch))
        within = min([self._exact_cost, *(one.cost + weights.RIVAL for one in found)])
        options = replace(self.options, max_size=self._limit)
        found += larger(self.examples, variants, self.vocabulary, options, self.extremity, above, within, self.watch)
        return found

    def _rival_cost(self, variants: Variants) -> float:
        """What it costs that the exact extractor, or none at all, is right, on whichever relabelings it matches."""
        return self._exact_cost - sum(log(chance(some)) for some in variants.relabelings_for(self.exact))

    def _choose(self, candidates: Sequence[Candidate], sure: Mapping[Place, float]) -> Candidate | None:
        """The first candidate, of those about as good as the best, whose corrections are all believed."""
        least = weights.BELIEVED if self.exact else weights.BELIEVED_WITHOUT
        for candidate in candidates:
            if candidate.score > candidates[0].score + weights.RIVAL:
                break
            if all(sure[place] >= least for place in changes(candidate)):
                return candidate
        return None

    def _to_explanation(self, chosen: Candidate, sure: Mapping[Place, float]) -> Explanation:
        places = changes(chosen)
        rows = []
        for at, change in places:
            example = self.examples[at]
            hull = example.mesh.hulls[change[0]]
            standing = self.labels.odds_of(example.name, hull)
            assert standing, "only hulls with a standing are relabelled"
            most = weights.HUMAN_MOST if is_human(hull) else 1.0
            said = why(standing, change[1], chosen.extractor, len(places) == 1)
            rows.append((correction(example, change), min(sure[at, change], most), said))
        rows.sort(key=lambda row: (row[0].asset, row[0].hull))
        corrections, believed, whys = zip(*rows, strict=True)
        return Explanation(chosen.extractor, corrections, believed, whys, chosen.cost)
