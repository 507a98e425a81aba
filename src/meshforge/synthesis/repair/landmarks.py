"""Wrong labels of landmark hulls: they turn a demonstrated mesh into another frame than the rest, where rules that are
simple in truth become long, or have no extractor at all.

Corrections that change the frame are tried one by one and in pairs, each by learning the rules anew on the demonstrated
meshes; what is believed about a label and about a program is weighed as in `candidates.py`.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import exp, log

import numpy as np

from meshforge.common import MeshForgeError, pluralize
from meshforge.geometry import Floats
from meshforge.label_model import LabelBeliefs, LabelOdds, is_human
from meshforge.language import Extractor, Orient, find_rotation, size_of
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import LabelFix, Repair, name_demonstrations
from meshforge.synthesis.options import TimeBudget
from meshforge.synthesis.orientation.attempts import OrientationSearch
from meshforge.synthesis.repair import hypotheses
from meshforge.synthesis.repair.hypotheses import key_cost, list_evidence
from meshforge.synthesis.search.terms import order_key
from meshforge.synthesis.task import LearningTask, correct_demonstrations

MIN_TURN = float(np.radians(15))
"""A correction that turns the frame by less [rad] does nothing about it."""
MAX_TRIED = 24
"""So many corrections, and pairs of them, are tried at most, those first that are least improbable."""


@dataclass(frozen=True, slots=True)
class FrameChange:
    """A correction that turns a mesh; cost: to propose it [nats]; odds: of the label as it is; angle [rad]."""

    fix: LabelFix
    cost: float
    odds: LabelOdds
    angle: float


@dataclass(frozen=True, slots=True)
class _Hypothesis:
    """Corrections, and what learning finds with them; base: what its extractors cost [nats]."""

    changes: tuple[FrameChange, ...]
    sizes: tuple[int, ...]
    base: float

    @property
    def cost(self) -> float:
        return self.base + sum(one.cost for one in self.changes)

    @property
    def score(self) -> float:
        """What it costs that labels and program are so [nats]."""
        return self.base + sum(one.odds.odds[one.fix.to] for one in self.changes)


class LandmarkFixSearch:
    """The demonstrated meshes of a task that may lie in a wrong frame.

    learned: the extractors as the labels are; failed: whether the rule after them has none; spent: what was proposed
    for these rules instead, in the frame as it is [nats].
    """

    def __init__(
        self,
        task: LearningTask,
        labels: LabelBeliefs,
        budget: TimeBudget,
        learned: Sequence[Extractor],
        failed: bool,
        spent: float = 0.0,
    ) -> None:
        self._task, self._labels, self._budget = task, labels, budget
        self._rules = task.rules[: len(learned) + failed]
        self._places = {label: place for place, label in enumerate(task.frame.labels)}
        costs = [self._cost(one) for one in learned]
        self._sizes = (*map(size_of, learned), *([0] * failed))
        self._now = sum(costs) + failed * hypotheses.NO_EXTRACTOR_COST + spent
        plain = 2 * hypotheses.NODE_COST + hypotheses.UNCERTAINTY_COST
        self._least = sum(min(cost, plain) for cost in costs) + failed * hypotheses.NODE_COST
        self._failed = failed

    def run(self) -> tuple[Repair, ...]:
        """Return the corrections that make the rules clearly more believable, if any. Raises OutOfTime."""
        tried = [found for changes in self._combine(self._find_changes()) if (found := self._try(changes))]
        if not tried:
            return ()
        least = min([self._now, *(one.score for one in tried)])
        weights = [exp(least - one.score) for one in tried]
        total = exp(least - self._now) + sum(weights)
        best = min(tried, key=lambda one: (round(one.score, 9), len(one.changes)))
        beliefs = [
            sum(weight for one, weight in zip(tried, weights, strict=True) if change in one.changes) / total
            for change in best.changes
        ]
        wanted = hypotheses.MIN_BELIEF_WITHOUT_EXACT if self._failed else hypotheses.MIN_BELIEF
        if best.cost >= self._now or min(beliefs) < wanted:
            return ()
        return tuple(
            self._to_repair(change, belief, best)
            for change, belief in sorted(zip(best.changes, beliefs, strict=True), key=lambda row: row[0].fix)
        )

    def _cost(self, extractor: Extractor) -> float:
        return key_cost(order_key(extractor, self._places))

    def _find_changes(self) -> list[FrameChange]:
        """Single corrections that could pay, the least improbable first, as many as can be tried."""
        orient, within = self._task.frame.orient, self._now - self._least
        if not orient or within <= 0:
            return []
        meshes = {name: demo.mesh for name, demo in name_demonstrations(self._task.demos)}
        frames = {name: frame for name, mesh in meshes.items() if (frame := self._rotate(mesh)) is not None}
        suspects = [row for name in frames for row in self._list_suspects(name, meshes[name], orient, within)]
        found, tried = list[FrameChange](), 0
        for cost, fix in sorted(suspects):
            change = self._to_change(fix, meshes[fix.asset], frames[fix.asset], cost)
            if change:
                found.append(change)
                tried += self._is_allowed((change,))
            if tried == MAX_TRIED:  # a dearer one alone is never tried, nor in a pair
                break
        return found

    def _list_suspects(
        self, name: str, mesh: SymbolicMesh, orient: Orient, within: float
    ) -> Iterator[tuple[float, LabelFix]]:
        """What it costs to correct labels that may be wrong, where one before or after it is a landmark's."""
        bases = [base for pair in orient.pairs for base in (pair.start, pair.end)]
        landmarks = {label for base in bases for label in base.labels}
        rejected = {(one.hull, one.was) for one in self._task.rejected if one.asset == name}
        for hull in mesh.hulls:
            if (hull.name, hull.label) in rejected:
                continue
            for to in self._task.frame.labels:
                if (to in landmarks or hull.label in landmarks) and to != hull.label:
                    cost = self._labels.cost(name, hull, to)
                    if cost < within:
                        yield cost, LabelFix(name, hull.name, hull.label, to)

    def _to_change(self, fix: LabelFix, mesh: SymbolicMesh, now: Floats, cost: float) -> FrameChange | None:
        """None where the correction leaves the frame as it is, or leaves no frame. now: the rotation as labels are."""
        hull = mesh.hull_of(fix.hull)
        then = self._rotate(mesh, [fix.to if one is hull else one.label for one in mesh.hulls])
        if then is None:
            return None
        angle = float(np.arccos(np.clip((np.trace(now @ then.T) - 1) / 2, -1, 1)))
        odds = self._labels.odds_of(fix.asset, hull)
        return FrameChange(fix, cost, odds, angle) if odds and angle >= MIN_TURN else None

    def _rotate(self, mesh: SymbolicMesh, labels: Sequence[str | None] | None = None) -> Floats | None:
        assert self._task.frame.orient
        try:
            return find_rotation(mesh, self._task.frame.orient, labels)
        except MeshForgeError:
            return None

    def _combine(self, singles: Sequence[FrameChange]) -> list[tuple[FrameChange, ...]]:
        """Single corrections and pairs of different hulls, as many as are allowed, the least improbable first."""
        pairs = [pair for pair in combinations(singles[:MAX_TRIED], 2) if self._is_allowed(pair)]
        some = [*((one,) for one in singles if self._is_allowed((one,))), *pairs]
        able = [one for one in some if sum(change.cost for change in one) < self._now - self._least]
        return sorted(able, key=lambda one: sum(change.cost for change in one))[:MAX_TRIED]

    def _is_allowed(self, changes: Collection[FrameChange]) -> bool:
        hulls = [(one.fix.asset, one.fix.hull) for one in changes]
        assets = [asset for asset, _ in hulls] + [one.asset for one in self._task.confirmed]
        return len(set(hulls)) == len(hulls) and max(map(assets.count, assets)) <= self._task.options.eta

    def _try(self, changes: Sequence[FrameChange]) -> _Hypothesis | None:
        """What the rules cost on meshes with corrected labels; None where they are not found for less than now."""
        demos = correct_demonstrations(self._task.demos, [one.fix for one in changes])
        task = replace(self._task, demos=demos, rules=self._rules)
        most = int((self._now - sum(one.cost for one in changes)) / hypotheses.NODE_COST)
        assert task.frame.orient
        attempt = OrientationSearch(task, self._budget).attempt(task.frame.orient)
        if not attempt or not attempt.learn(most, min(most, task.options.max_size)):
            return None
        base = sum(self._cost(some[0]) for some in attempt.extractors)
        return _Hypothesis(tuple(changes), tuple(attempt.sizes), base)

    def _to_repair(self, change: FrameChange, belief: float, best: _Hypothesis) -> Repair:
        most = hypotheses.MAX_BELIEF_AGAINST_PERSON if is_human(change.odds.hull) else 1.0
        places = [k for k, (now, then) in enumerate(zip(self._sizes, best.sizes, strict=True)) if then < now or not now]
        rule = places[0] if places else 0
        now = "no extractor" if not self._sizes[rule] else f"one of {pluralize(self._sizes[rule], 'node')}"
        all_ = "it" if len(best.changes) == 1 else "all corrections"
        effect = (
            f"with {all_} the orientation turns {change.fix.asset} by {np.degrees(change.angle):.0f}° "
            f"otherwise, and rule {rule + 1} has an extractor of {pluralize(best.sizes[rule], 'node')}, now {now}"
        )
        why = "; ".join([*list_evidence(change.odds, change.fix.to), effect])
        return Repair(change.fix, rule + 1, min(belief, most), why[0].upper() + why[1:])


def proposal_cost(labels: LabelBeliefs, task: LearningTask, repairs: Sequence[Repair]) -> float:
    """Return what it costs to believe in corrections that were found otherwise [nats], where there are odds."""
    meshes = {name: demo.mesh for name, demo in name_demonstrations(task.demos)}
    known = [one.fix for one in repairs if one.fix.asset in meshes]
    costs = [labels.cost(one.asset, meshes[one.asset].hull_of(one.hull), one.to) for one in known]
    return sum(cost for cost in costs if cost < -log(1e-12))
