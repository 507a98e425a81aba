"""The fewest labels to correct for an extractor to match (paper, algorithm AbductiveInference)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, product

from meshforge.language import Extractor, labels_used
from meshforge.symbolic import bits
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.paper.demo import Change, Demo
from meshforge.synthesis.watch import Watch


class Abduction:
    """The demonstrations of a rule, prepared to be asked for corrections.

    vocabulary: labels to correct to; allowed: corrections at most, by the name of the mesh.
    """

    def __init__(
        self, demos: Sequence[Demo], vocabulary: Sequence[str], allowed: Mapping[str, int], watch: Watch
    ) -> None:
        self._demos, self._allowed, self._watch = demos, allowed, watch
        counts: Counter[str] = Counter()
        for demo in demos:
            counts.update({label: mask.bit_count() for label, mask in demo.labels.items()})
        self._by_frequency = sorted(vocabulary, key=lambda label: -counts[label])

    def infer(self, extractor: Extractor) -> tuple[Correction, ...] | None:
        """The fewest corrections after which an extractor matches; None where no repair is within the allowance.

        A correction touches one mesh only and a match is a match on each, so the fewest corrections of all are the
        fewest of each mesh, and one mesh beyond repair decides. Of repairs as small the first is taken: hulls in
        the order of the mesh, labels in that of `_choices`.
        """
        found: list[Correction] = []
        for demo in self._demos:
            repair = self._repair(extractor, demo)
            if repair is None:
                return None
            found += [_correction(demo, change) for change in repair]
        return tuple(found)

    def _repair(self, extractor: Extractor, demo: Demo) -> tuple[Change, ...] | None:
        for changes in self._candidates(extractor, demo):
            self._watch.check()
            if demo.select(extractor, demo.relabel(changes)) == demo.target:
                return changes
        return None

    def _candidates(self, extractor: Extractor, demo: Demo) -> Iterator[tuple[Change, ...]]:
        """The relabelings of suspects, those of fewer hulls first; the first of all changes none."""
        suspects = sorted(bits(demo.differences(extractor)))
        choices = {index: self._choices(extractor, demo.mesh.hulls[index].label) for index in suspects}
        for count in range(self._allowed[demo.name] + 1):
            for hulls in combinations(suspects, count):
                yield from product(*([(index, to) for to in choices[index]] for index in hulls))

    def _choices(self, extractor: Extractor, label: str | None) -> tuple[str, ...]:
        """The labels that a hull may get: those an extractor mentions, in order, or one to leave it by.

        Leaving is for hulls with a label that is mentioned: an extractor tells no others apart. The label is the
        most frequent one on the demonstrated meshes that is not mentioned; of several, the first of the vocabulary.
        """
        mentioned = labels_used(extractor)
        leaving = [other for other in self._by_frequency if other not in mentioned][:1] if label in mentioned else []
        return (*(other for other in mentioned if other != label), *leaving)


def _correction(demo: Demo, change: Change) -> Correction:
    hull = demo.mesh.hulls[change[0]]
    return Correction(demo.name, hull.name, hull.label, change[1])
