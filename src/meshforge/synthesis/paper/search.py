"""The paper's search for one rule's extractor: holes filled, simplest first (algorithm SynthesizeExtractor), and the
fewest labels to correct for an extractor to match (algorithm AbductiveInference)."""

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from types import MappingProxyType

from meshforge.language import Extractor, labels_of
from meshforge.symbolic import bits_of
from meshforge.synthesis.demonstration import Example, LabelChange, LabelFix, to_fix
from meshforge.synthesis.options import Options, OutOfTime, TimeBudget
from meshforge.synthesis.paper import partial as partials
from meshforge.synthesis.paper.partial import ExampleMasks, Hole, HoleGrammar, Open, Worklist
from meshforge.synthesis.search.smallest import Hit, Miss, NearestExtractor, SearchEffort, SearchResult, Unfinished


@dataclass(frozen=True, slots=True)
class HitWithFixes:
    """An extractor that matches once some labels are corrected: confirmed, or proposed where nobody was asked."""

    extractor: Extractor
    fixes: tuple[LabelFix, ...]
    tried: SearchEffort


class PaperSearch:
    """The first extractor by size that selects what was shown, as it stands or after corrections of labels.

    vocabulary: the labels to ask for and to correct to; confirm: is asked about corrections one by one, without it
    the first repair is proposed; rejected: corrections not to propose; spent: how many were made before, by mesh.
    In the counts, selections are complete programs that were checked, goals partial ones whose hole was filled.
    """

    def __init__(
        self,
        examples: Sequence[Example],
        vocabulary: Sequence[str],
        budget: TimeBudget,
        options: Options,
        confirm: Callable[[LabelFix], bool] | None = None,
        rejected: Collection[LabelFix] = (),
        spent: Mapping[str, int] = MappingProxyType({}),
    ) -> None:
        self._demos = [ExampleMasks(example, options.geo_extremity) for example in examples]
        self._grammar, self._max_size, self._budget = HoleGrammar(vocabulary, options.layers), options.max_size, budget
        left = {demo.name: max(0, options.eta - spent.get(demo.name, 0)) for demo in self._demos}
        self._abduction = Abduction(self._demos, vocabulary, left, budget) if options.repair else None
        self._confirm, self._answers = confirm, dict.fromkeys(rejected, False)
        self._size = self._complete = self._filled = 0
        self._nearest: tuple[int, Extractor] | None = None

    def run(self) -> SearchResult | HitWithFixes:
        """Return the answer, within the limits of the options and the budget."""
        try:
            return self._find_hit()
        except OutOfTime:
            return Unfinished(self._find_nearest(), self._tried)

    @property
    def _tried(self) -> SearchEffort:
        return SearchEffort(self._size, self._complete, self._filled)

    def _find_hit(self) -> Hit | HitWithFixes | Miss:
        worklist = Worklist(self._max_size)
        worklist.put(Hole())
        while popped := worklist.pop():
            self._budget.check()
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
            if not isinstance(candidate, Open) or all(partials.is_feasible(candidate, demo) for demo in self._demos):
                worklist.put(candidate)

    def _check_complete(self, extractor: Extractor) -> Hit | HitWithFixes | None:
        self._complete += 1
        count = sum(demo.differences(extractor).bit_count() for demo in self._demos)
        if count == 0:
            return Hit(extractor, self._tried)
        if self._nearest is None or count < self._nearest[0]:
            self._nearest = count, extractor
        fixes = self._abduction.infer(extractor) if self._abduction else None
        if fixes is None or not self._are_confirmed(fixes):
            return None
        return HitWithFixes(extractor, fixes, self._tried)

    def _are_confirmed(self, fixes: Sequence[LabelFix]) -> bool:
        """Whether all are right, asked one by one; without a person those that were not rejected are."""
        if not all(self._answers.get(fix, True) for fix in fixes):
            return False
        for fix in fixes if self._confirm else ():
            assert self._confirm
            if fix not in self._answers:
                self._answers[fix] = self._confirm(fix)
            if not self._answers[fix]:
                return False
        return True

    def _find_nearest(self) -> NearestExtractor | None:
        """How the nearest differs on the mesh where it differs most, None when nothing was complete."""
        if self._nearest is None:
            return None
        extractor = self._nearest[1]
        worst = max(self._demos, key=lambda demo: demo.differences(extractor).bit_count())
        wrong, names_of = worst.differences(extractor), worst.example.mesh.names_of
        return NearestExtractor(extractor, worst.name, names_of(wrong & ~worst.target), names_of(wrong & worst.target))

    def _report_miss(self) -> Miss:
        nearest = self._find_nearest()
        assert nearest, "All is complete and of one node"
        corrected = ", even after corrections of labels" if self._abduction else ""
        return Miss(f"no extractor of up to {self._max_size} nodes matches{corrected}", nearest, self._tried)


class Abduction:
    """The demonstrations of a rule, prepared to be asked for corrections.

    vocabulary: labels to correct to; allowed: corrections at most, by the name of the mesh.
    """

    def __init__(
        self, demos: Sequence[ExampleMasks], vocabulary: Sequence[str], allowed: Mapping[str, int], budget: TimeBudget
    ) -> None:
        self._demos, self._allowed, self._budget = demos, allowed, budget
        counts: Counter[str] = Counter()
        for demo in demos:
            counts.update({label: mask.bit_count() for label, mask in demo.labels.items()})
        self._by_frequency = sorted(vocabulary, key=lambda label: -counts[label])

    def infer(self, extractor: Extractor) -> tuple[LabelFix, ...] | None:
        """Return the fewest corrections after which an extractor matches; None where no repair is within the allowance.

        A correction touches one mesh only and a match is a match on each, so the fewest corrections of all are the
        fewest of each mesh, and one mesh beyond repair decides. Of repairs as small the first is taken: hulls in
        the order of the mesh, labels in that of `_choices`.
        """
        found: list[LabelFix] = []
        for demo in self._demos:
            repair = self._repair(extractor, demo)
            if repair is None:
                return None
            found += [to_fix(demo.example, change) for change in repair]
        return tuple(found)

    def _repair(self, extractor: Extractor, demo: ExampleMasks) -> tuple[LabelChange, ...] | None:
        for changes in self._candidates(extractor, demo):
            self._budget.check()
            if demo.select(extractor, demo.relabel(changes)) == demo.target:
                return changes
        return None

    def _candidates(self, extractor: Extractor, demo: ExampleMasks) -> Iterator[tuple[LabelChange, ...]]:
        """The relabelings of suspects, those of fewer hulls first; the first of all changes none."""
        suspects = sorted(bits_of(demo.differences(extractor)))
        choices = {index: self._choices(extractor, demo.example.mesh.hulls[index].label) for index in suspects}
        for count in range(self._allowed[demo.name] + 1):
            for hulls in combinations(suspects, count):
                yield from product(*([(index, to) for to in choices[index]] for index in hulls))

    def _choices(self, extractor: Extractor, label: str | None) -> tuple[str, ...]:
        """The labels that a hull may get: those an extractor mentions, in order, or one to leave it by.

        Leaving is for hulls with a label that is mentioned: an extractor tells no others apart. The label is the
        most frequent one on the demonstrated meshes that is not mentioned; of several, the first of the vocabulary.
        """
        mentioned = labels_of(extractor)
        leaving = [other for other in self._by_frequency if other not in mentioned][:1] if label in mentioned else []
        return (*(other for other in mentioned if other != label), *leaving)
