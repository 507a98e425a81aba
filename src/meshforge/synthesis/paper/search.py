"""The search for one rule's extractor by filling holes, simplest first (paper, algorithm SynthesizeExtractor)."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass

from meshforge.language import EXTREMITY, Extractor
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Options
from meshforge.synthesis.paper.abduction import Abduction
from meshforge.synthesis.paper.asking import Asking
from meshforge.synthesis.paper.bounds import feasible
from meshforge.synthesis.paper.demo import Demo
from meshforge.synthesis.paper.nearest import Nearest
from meshforge.synthesis.paper.partial import Grammar, Hole, Open
from meshforge.synthesis.paper.worklist import Worklist
from meshforge.synthesis.search.smallest import Answer, Hit, Miss, Tried, Unfinished
from meshforge.synthesis.watch import OutOfTime, Watch


@dataclass(frozen=True, slots=True)
class Explained:
    """An extractor that matches once some labels are corrected: confirmed, or proposed where nobody was asked."""

    extractor: Extractor
    corrections: tuple[Correction, ...]
    tried: Tried


def paper_search(
    examples: Sequence[Example],
    vocabulary: Sequence[str],
    watch: Watch,
    options: Options,
    extremity: float = EXTREMITY,
    confirm: Callable[[Correction], bool] | None = None,
    rejected: Container[Correction] = (),
    spent: Mapping[str, int] | None = None,
) -> Answer | Explained:
    """The first extractor by size that selects what was shown, as it stands or after corrections of labels.

    vocabulary: the labels to ask for and to correct to; confirm: is asked about corrections one by one, without it
    the first repair is proposed; rejected: corrections not to propose; spent: how many were made before, by mesh.
    In the counts, selections are complete programs that were checked, goals partial ones whose hole was filled.
    """
    demos = [Demo(example, extremity) for example in examples]
    left = {demo.name: max(0, options.eta - (spent or {}).get(demo.name, 0)) for demo in demos}
    abduction = Abduction(demos, vocabulary, left, watch) if options.repair else None
    grammar, asking = Grammar(vocabulary, options.layers), Asking(confirm, rejected)
    search = _Search(demos, grammar, watch, options.max_size, abduction, asking)
    try:
        return search.run()
    except OutOfTime:
        return Unfinished(search.nearest.miss(), search.tried)


class _Search:
    """The worklist on its way; without `abduction` labels are taken as they are."""

    def __init__(
        self,
        demos: Sequence[Demo],
        grammar: Grammar,
        watch: Watch,
        max_size: int,
        abduction: Abduction | None,
        asking: Asking,
    ) -> None:
        self._demos, self._grammar, self._watch, self._max_size = demos, grammar, watch, max_size
        self._abduction, self._confirmations = abduction, asking
        self._size = self._complete = self._filled = 0
        self.nearest = Nearest(demos)

    @property
    def tried(self) -> Tried:
        return Tried(self._size, self._complete, self._filled)

    def run(self) -> Hit | Explained | Miss:
        worklist = Worklist(self._max_size)
        worklist.put(Hole())
        while popped := worklist.pop():
            self._watch.check()
            size, partial = popped
            self._size = size - 1
            if isinstance(partial, Open):
                self._fill(partial, worklist)
            elif answer := self._check_complete(partial):
                return answer
        self._size = self._max_size
        return self._report_miss()

    def _fill(self, partial: Open, worklist: Worklist) -> None:
        """EnumerateCandidates: bounds judge what still has holes; what is complete may be a near miss to explain."""
        self._filled += 1
        for candidate in self._grammar.fill(partial):
            if not isinstance(candidate, Open) or all(feasible(candidate, demo) for demo in self._demos):
                worklist.put(candidate)

    def _check_complete(self, extractor: Extractor) -> Hit | Explained | None:
        self._complete += 1
        if self.nearest.offer(extractor) == 0:
            return Hit(extractor, self.tried)
        corrections = self._abduction.infer(extractor) if self._abduction else None
        if corrections is None or not self._confirmations.are_confirmed(corrections):
            return None
        return Explained(extractor, corrections, self.tried)

    def _report_miss(self) -> Miss:
        nearest = self.nearest.miss()
        assert nearest, "All is complete and of one node"
        corrected = ", even after corrections of labels" if self._abduction else ""
        return Miss(f"no extractor of up to {self._max_size} nodes matches{corrected}", nearest, self.tried)
