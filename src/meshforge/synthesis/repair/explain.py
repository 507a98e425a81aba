"""Explains what was shown by a program and wrong labels, where that is more believable than a program alone; and the
repairs that a run proposes, joined over its rules."""

from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import exp, log, prod

from meshforge.label_model import LabelBeliefs, is_human
from meshforge.language import Extractor, size_of
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Example, LabelChange, LabelFix, Repair, name_demonstrations, to_fix
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.paper.search import HitWithFixes
from meshforge.synthesis.repair import hypotheses as candidate_search
from meshforge.synthesis.repair.hypotheses import (
    NO_EXTRACTOR_COST,
    Candidate,
    describe_effect,
    explain_fix,
    key_cost,
    total_chance,
)
from meshforge.synthesis.repair.landmarks import LandmarkFixSearch, proposal_cost
from meshforge.synthesis.repair.relabelings import Variants, enumerate_relabelings
from meshforge.synthesis.search.smallest import Hit, Miss
from meshforge.synthesis.search.terms import order_key
from meshforge.synthesis.task import LearningTask

DISTRUST_PER_ERROR = 3.0
"""How much less a mesh shows for each label that is expected to be wrong [nats]. Measured on the calibration set with
noisy labels (`script/bench tuning`): of 120 sessions 99 end right within three demonstrations and answers; 90 at 1.0,
74 where looks go by confidence, and questions by nothing."""


def make_confirmer(rule: int, confirm: Callable[[Repair], bool]) -> Callable[[LabelFix], bool]:
    """Ask about fixes of which nothing is known but that an extractor of the rule matches with them."""
    return lambda fix: confirm(Repair(fix, rule, 1.0, "an extractor selects what was shown with it"))


class RepairCollector:
    """Collects corrections rule by rule; each counts once, however many rules need it.

    meshes: all meshes by name, oriented, before the first rule.
    """

    def __init__(self, task: LearningTask, meshes: Mapping[str, SymbolicMesh], budget: TimeBudget) -> None:
        self._task, self._meshes, self._budget = task, meshes, budget
        self._found: dict[LabelFix, Repair] = {}

    @property
    def repairs(self) -> tuple[Repair, ...]:
        return tuple(repair for _, repair in sorted(self._found.items()))

    @property
    def counts(self) -> Mapping[str, int]:
        """How many corrections there are on each mesh, those included that a person confirmed before."""
        return Counter(fix.asset for fix in [*self._found, *self._task.confirmed])

    @cached_property
    def trust(self) -> Mapping[str, float]:
        """How much each mesh shows of the rules rather than of its labels, in 0..1: less for each that may be wrong."""
        errors = self._beliefs.errors  # of none that is demonstrated under another name
        return {name: exp(-DISTRUST_PER_ERROR * errors.get(name, 0.0)) for name in self._meshes}

    def find_fixes(self, rule: int, examples: Sequence[Example], found: Hit | Miss) -> tuple[LabelFix, ...]:
        """Return fixes that explain what was shown better than what was found does. Raises OutOfTime."""
        options, labels, rejected = self._task.options, self._task.frame.labels, self._task.rejected
        exact = found.extractor if isinstance(found, Hit) else None
        explanation = (
            options.repair
            and FixSearch(examples, labels, self._beliefs, options, self._budget, exact, self.counts, rejected).run()
        )
        if not explanation:
            return ()
        rows = zip(explanation.fixes, explanation.beliefs, explanation.whys, strict=True)
        self._found.update({fix: Repair(fix, rule, belief, why) for fix, belief, why in rows})
        return explanation.fixes

    def record_inferred(self, rule: int, explained: HitWithFixes) -> tuple[LabelFix, ...]:
        """Take over what the paper's algorithm infers, which says nothing about how believable it is."""
        why = describe_effect(explained.extractor, len(explained.fixes) == 1)
        self._found.update({fix: Repair(fix, rule, 1.0, why) for fix in explained.fixes})
        return explained.fixes

    def find_landmark_fixes(self, learned: Sequence[Extractor], failed: bool) -> bool:
        """Return whether landmarks' labels explain better what was shown; if so, their corrections take the place of
        all.

        learned: the extractors of the rules; failed: whether the rule after them has none. Raises OutOfTime.
        """
        if not self._task.options.repair or self._task.options.strategy == "paper" or not self._task.frame.orient:
            return False
        spent = proposal_cost(self._beliefs, self._task, self.repairs)
        search = LandmarkFixSearch(self._task, self._beliefs, self._budget, learned, failed, spent)
        repairs = search.run()
        if repairs:
            self._found = {repair.fix: repair for repair in repairs}
        return bool(repairs)

    @cached_property
    def _beliefs(self) -> LabelBeliefs:
        answered = {answer.asset for answer in self._task.answers}
        known = answered.union(name for name, _ in name_demonstrations(self._task.demos))
        return LabelBeliefs(
            {name: mesh for name, mesh in self._meshes.items() if name in known},
            {name: mesh for name, mesh in self._meshes.items() if name not in known},
            self._task.frame.labels,
        )


SMALL_SIZE = 5
"""Nodes up to which all extractors are looked at under all relabelings."""

MAX_RELABELINGS = 1500
"""Relabelings that are looked at, of all examples; single corrections always are."""

ChangeAt = tuple[int, LabelChange]
"""A change on one of the examples."""


@dataclass(frozen=True, slots=True)
class Explanation:
    """An extractor that selects what was shown once labels are corrected.

    corrections: sorted, at least one; beliefs: of each, the probability that it is right; whys: of each, one sentence
    for the user; cost: of extractor and corrections together [nats].
    """

    extractor: Extractor
    fixes: tuple[LabelFix, ...]
    beliefs: tuple[float, ...]
    whys: tuple[str, ...]
    cost: float


class FixSearch:
    """One rule that may have been shown on wrong labels.

    vocabulary: the labels to ask for and to correct to; exact: the smallest extractor that needs no correction, None
    where there is none; spent: corrections made before for other rules, by the name of the mesh; rejected:
    corrections not to propose.
    """

    def __init__(
        self,
        examples: Sequence[Example],
        vocabulary: Sequence[str],
        labels: LabelBeliefs,
        options: Options,
        budget: TimeBudget,
        exact: Extractor | None,
        spent: Mapping[str, int],
        rejected: Collection[LabelFix],
    ) -> None:
        self._examples = tuple(example for example in examples if example.mesh.hulls)
        self._vocabulary, self._labels, self._options, self._budget = vocabulary, labels, options, budget
        self._exact, self._spent, self._rejected = exact, spent, rejected

    def run(self) -> Explanation | None:
        """Return the most believable extractor with corrections of labels, None where what is exact is as believable.

        Raises OutOfTime.
        """
        variants = self._build_variants()
        if variants is None or not all(variants.by_example):
            return None
        found = self._find_candidates(variants)
        # what it costs that the exact extractor, or none at all, is right, on whichever relabelings it matches
        rival = self._exact_cost - sum(log(total_chance(some)) for some in variants.relabelings_for(self._exact))
        beliefs = compute_change_beliefs(found, rival)
        ranked = sorted((one for one in found if not one.exact), key=lambda one: (round(one.score, 9), one.key))
        chosen = self._choose(ranked, beliefs)
        return self._to_explanation(chosen, beliefs) if chosen else None

    @cached_property
    def _exact_cost(self) -> float:
        """What it costs to believe in the exact extractor, or in none at all [nats]."""
        places = {label: place for place, label in enumerate(self._vocabulary)}
        return key_cost(order_key(self._exact, places)) if self._exact else NO_EXTRACTOR_COST

    def _build_variants(self) -> Variants | None:
        within = self._exact_cost - candidate_search.NODE_COST
        room = MAX_RELABELINGS // max(1, len(self._examples))
        ways = [
            enumerate_relabelings(example, self._vocabulary, self._labels, allowed, self._rejected, within, room)
            for example in self._examples
            for allowed in [  # of a mesh without labels none is corrected: any would do as well
                self._options.eta - self._spent.get(example.name, 0) if any(h.label for h in example.mesh.hulls) else 0
            ]
        ]
        if not any(len(some) > 1 for some in ways):
            return None
        return Variants(self._examples, ways, self._vocabulary, self._options)

    def _find_candidates(self, variants: Variants) -> list[Candidate]:
        limit = min(self._options.max_size, size_of(self._exact) - 1) if self._exact else self._options.max_size
        above = min(SMALL_SIZE, limit)
        found = list(candidate_search.search_small(variants, above, self._exact_cost, self._budget))
        within = min([self._exact_cost, *(one.cost + candidate_search.RIVAL_MARGIN for one in found)])
        options = replace(self._options, max_size=limit)
        found += candidate_search.search_larger(
            self._examples, variants, self._vocabulary, options, above, within, self._budget
        )
        return found

    def _choose(self, hypotheses: Sequence[Candidate], beliefs: Mapping[ChangeAt, float]) -> Candidate | None:
        """The first candidate, of those about as good as the best, whose corrections are all believed; hypotheses:
        those with corrections, the most believable first."""
        least = candidate_search.MIN_BELIEF if self._exact else candidate_search.MIN_BELIEF_WITHOUT_EXACT
        for candidate in hypotheses:
            if candidate.score > hypotheses[0].score + candidate_search.RIVAL_MARGIN:
                break
            if all(beliefs[place] >= least for place in changes_of(candidate)):
                return candidate
        return None

    def _to_explanation(self, chosen: Candidate, beliefs: Mapping[ChangeAt, float]) -> Explanation:
        places = changes_of(chosen)
        rows = []
        for at, change in places:
            example = self._examples[at]
            hull = example.mesh.hulls[change[0]]
            odds = self._labels.odds_of(example.name, hull)
            assert odds, "only hulls with odds are relabelled"
            most = candidate_search.MAX_BELIEF_AGAINST_PERSON if is_human(hull) else 1.0
            why = explain_fix(odds, change[1], chosen.extractor, len(places) == 1)
            rows.append((to_fix(example, change), min(beliefs[at, change], most), why))
        rows.sort(key=lambda row: (row[0].asset, row[0].hull))
        fixes, believed, whys = zip(*rows, strict=True)
        return Explanation(chosen.extractor, fixes, believed, whys, chosen.cost)


def changes_of(candidate: Candidate) -> tuple[ChangeAt, ...]:
    """Return the changes of a candidate's cheapest relabelings."""
    return tuple((place, change) for place, some in enumerate(candidate.ways) for change in some[0].changes)


def compute_change_beliefs(hypotheses: Sequence[Candidate], instead: float) -> Mapping[ChangeAt, float]:
    """Return the probability of each change, among all candidates and what stands against them.

    instead: the cost [nats] of what else may be the case. An extractor's share is spread over its relabelings.
    """
    least = min([instead, *(one.score for one in hypotheses)])
    total, shares = exp(least - instead), defaultdict[ChangeAt, float](float)
    for candidate in hypotheses:
        weight = exp(least - candidate.base)
        sums = [total_chance(some) for some in candidate.ways]
        total += weight * prod(sums)
        for place, some in enumerate(candidate.ways):
            others = weight * prod(sums[:place]) * prod(sums[place + 1 :])
            for way in some:
                for change in way.changes:
                    shares[place, change] += others * way.chance
    return {place: share / total for place, share in shares.items()}
