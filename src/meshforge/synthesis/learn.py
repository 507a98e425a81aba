"""Learns a program from demonstrations (paper, stage III): one run after the other while labels get corrected."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

from meshforge.common import DemonstrationError, suggest_among
from meshforge.language import Orient, Program, Template
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import (
    Answer,
    Demonstration,
    LabelFix,
    Repair,
    collect_rule_specs,
    name_demonstrations,
)
from meshforge.synthesis.learning_run import LearningRun
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.outcome import LearningOutcome, NeedsRepair
from meshforge.synthesis.search.terms import enumerate_more_leaves
from meshforge.synthesis.task import Family, LearningTask, apply_fixes, name_family

DEFAULTS = Options()


def synthesize(
    demos: Sequence[Demonstration],
    family: Iterable[SymbolicMesh] | Family = (),
    orient: Orient | None = None,
    templates: Mapping[str, Template] | None = None,
    vocabulary: Sequence[str] | None = None,
    options: Options = DEFAULTS,
    confirm: Callable[[Repair], bool] | None = None,
    answers: Sequence[Answer] = (),
) -> LearningOutcome:
    """Return the program that does on every demonstration what was shown, and whatever else these leave open.

    family: the meshes it is meant for, by name or by their files' paths; vocabulary: labels it may ask for, by default
    all on the meshes. templates: by the paths that actions name.
    confirm: is asked about each label that is probably wrong; without it the outcome proposes the repairs.
    answers: what a person said to earlier questions.
    Raises DemonstrationError for demonstrations that contradict each other or name what is not there, ProgramError
    where the orientation fails on one of them, PluginError for a leaf extractor of a plug-in that fails.
    """
    meshes = name_family(family, demos)
    rules = collect_rule_specs(demos)
    labels = choose_vocabulary(demos, meshes.values(), orient, vocabulary)
    family = [*(demo.mesh for demo in demos), *meshes.values()]
    options = replace(options, leaves=enumerate_more_leaves(options.extractors, labels, options.layers, family))
    frame = Program(labels, orient, (), options.contact, options.extremity)
    budget = TimeBudget(options.budget, options.clock, options.stop)
    confirmer = _RepairConfirmer(confirm, options.rejected, budget)
    confirmed: tuple[LabelFix, ...] = ()
    while True:
        shown = tuple(
            Demonstration(apply_fixes(demo.mesh, name, confirmed), demo.steps, demo.name)
            for name, demo in name_demonstrations(demos)
        )
        family = {name: apply_fixes(mesh, name, confirmed) for name, mesh in meshes.items()}
        task = LearningTask(
            rules, shown, family, frame, templates or {}, tuple(answers), confirmer.rejected, options, confirmed
        )
        outcome = LearningRun(task, budget, confirmer.confirm if confirm else None).run()
        if not confirm or not isinstance(outcome, NeedsRepair):
            return outcome
        confirmed += confirmer.confirm_all(outcome.repairs)


class _RepairConfirmer:
    """Asks a person about each correction once; what was confirmed is not to be undone by another one."""

    def __init__(
        self, confirm: Callable[[Repair], bool] | None, rejected: Iterable[LabelFix], budget: TimeBudget
    ) -> None:
        self._confirm, self._budget = confirm, budget
        self._decisions = dict.fromkeys(rejected, False)

    @property
    def rejected(self) -> frozenset[LabelFix]:
        """What is not to be proposed: what was refused, and the reverse of what was confirmed."""
        refused = {fix for fix, right in self._decisions.items() if not right}
        return frozenset(refused.union(c.reverse for c, right in self._decisions.items() if right and c.reverse))

    def confirm_all(self, repairs: Iterable[Repair]) -> tuple[LabelFix, ...]:
        """Those that are confirmed; of a rule's repairs none is asked about after one that is refused.

        They explain the rule together, so without one the others may be pointless; if not, they are proposed again.
        """
        right, refused = list[LabelFix](), set[int]()
        for repair in repairs:
            if repair.rule in refused:
                continue
            if self.confirm(repair):
                right.append(repair.fix)
            else:
                refused.add(repair.rule)
        return tuple(right)

    def confirm(self, repair: Repair) -> bool:
        assert self._confirm
        if repair.fix not in self._decisions:
            with self._budget.pause():
                self._decisions[repair.fix] = self._confirm(repair)
        return self._decisions[repair.fix]


def choose_vocabulary(
    demos: Sequence[Demonstration],
    family: Iterable[SymbolicMesh],
    orient: Orient | None,
    vocabulary: Sequence[str] | None,
) -> tuple[str, ...]:
    """Return the given vocabulary, or else every label of the meshes, the steps and the orientation, sorted.

    Raises DemonstrationError for a demonstration with a label that a given vocabulary lacks.
    """
    landmarks = Program(orient=orient).labels_in_use
    if vocabulary is None:
        meshes = [*(demo.mesh for demo in demos), *family]
        on_hulls = {hull.label for mesh in meshes for hull in mesh.hulls if hull.label}
        return tuple(sorted({*on_hulls, *landmarks, *(label for demo in demos for label in _labels_in_steps(demo))}))
    for name, demo in name_demonstrations(demos):
        for hull in demo.mesh.hulls:
            if hull.label:
                _check_label(hull.label, vocabulary, f"{name}, hull {hull.name!r}")
        for label in _labels_in_steps(demo):
            _check_label(label, vocabulary, f"{name}, steps")
    return tuple(vocabulary)


def _labels_in_steps(demo: Demonstration) -> list[str]:
    return [step.label for step in demo.steps if step.label]


def _check_label(label: str, vocabulary: Sequence[str], where: str) -> None:
    if label not in vocabulary:
        remedy = suggest_among(label, vocabulary)
        raise DemonstrationError(f"the label {label!r} is not in the vocabulary", where=where, remedy=remedy)
