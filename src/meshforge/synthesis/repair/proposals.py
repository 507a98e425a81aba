"""The repairs of labels that a run of learning proposes, joined over its rules."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from math import exp

from meshforge.label_model import LabelBeliefs
from meshforge.language import show
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Example, name_demonstrations
from meshforge.synthesis.options import TimeBudget
from meshforge.synthesis.paper.search import HitWithCorrections
from meshforge.synthesis.questions import LabelCorrection, Repair
from meshforge.synthesis.repair.explain import CorrectionSearch
from meshforge.synthesis.search.smallest import Hit, Miss
from meshforge.synthesis.task import LearningTask

DISTRUST_PER_ERROR = 3.0
"""How much less a mesh shows for each label that is expected to be wrong [nats]. Measured on the calibration set with
noisy labels (`script/bench tuning`): of 120 sessions 99 end right within three demonstrations and answers; 90 at 1.0,
74 where looks go by confidence, and questions by nothing."""


def make_confirmer(rule: int, confirm: Callable[[Repair], bool]) -> Callable[[LabelCorrection], bool]:
    """Asks about corrections of which nothing is known but that an extractor of the rule matches with them."""
    return lambda correction: confirm(Repair(correction, rule, 1.0, "an extractor selects what was shown with it"))


class RepairCollector:
    """Collects corrections rule by rule; each counts once, however many rules need it.

    meshes: all meshes by name, oriented, before the first rule.
    """

    def __init__(self, task: LearningTask, meshes: Mapping[str, SymbolicMesh], budget: TimeBudget) -> None:
        self._task, self._meshes, self._budget = task, meshes, budget
        self._found: dict[LabelCorrection, Repair] = {}

    @property
    def repairs(self) -> tuple[Repair, ...]:
        return tuple(repair for _, repair in sorted(self._found.items()))

    @property
    def counts(self) -> Mapping[str, int]:
        """How many corrections there are on each mesh, those included that a person confirmed before."""
        return Counter(correction.asset for correction in [*self._found, *self._task.confirmed])

    @cached_property
    def trust(self) -> Mapping[str, float]:
        """How much each mesh shows of the rules rather than of its labels, in 0..1: less for each that may be wrong."""
        errors = self._beliefs.errors  # of none that is demonstrated under another name
        return {name: exp(-DISTRUST_PER_ERROR * errors.get(name, 0.0)) for name in self._meshes}

    def find_corrections(
        self, rule: int, examples: Sequence[Example], found: Hit | Miss
    ) -> tuple[LabelCorrection, ...]:
        """Corrections that explain what was shown better than what was found does. Raises OutOfTime."""
        task = self._task
        explanation = (
            task.options.repair
            and CorrectionSearch(
                examples,
                task.frame.labels,
                self._beliefs,
                task.options,
                self._budget,
                found.extractor if isinstance(found, Hit) else None,
                self.counts,
                task.rejected,
            ).run()
        )
        if not explanation:
            return ()
        rows = zip(explanation.corrections, explanation.beliefs, explanation.whys, strict=True)
        self._found.update({correction: Repair(correction, rule, belief, why) for correction, belief, why in rows})
        return explanation.corrections

    def record_inferred(self, rule: int, explained: HitWithCorrections) -> tuple[LabelCorrection, ...]:
        """Take over what the paper's algorithm infers, which says nothing about how believable it is."""
        alone = len(explained.corrections) == 1
        why = f"with {'it' if alone else 'all corrections'}, {show(explained.extractor)} selects what was shown"
        self._found.update({correction: Repair(correction, rule, 1.0, why) for correction in explained.corrections})
        return explained.corrections

    @cached_property
    def _beliefs(self) -> LabelBeliefs:
        answered = {answer.asset for answer in self._task.answers}
        known = answered.union(name for name, _ in name_demonstrations(self._task.demos))
        return LabelBeliefs(
            {name: mesh for name, mesh in self._meshes.items() if name in known},
            {name: mesh for name, mesh in self._meshes.items() if name not in known},
            self._task.frame.labels,
        )
