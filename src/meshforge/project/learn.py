"""Learning the program of a project from its demonstrations, and from what a person said since."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from meshforge.common import ProjectError
from meshforge.project.accept import accept_outcome, digest_learning_inputs
from meshforge.project.answer import actions_of, check_answer, confirm_repair, reject_repair
from meshforge.project.family import FamilyMeshes
from meshforge.project.review import find_accepted_results
from meshforge.store import AnswerLine, AnswersFile, Store
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import (
    Ambiguous,
    Answer,
    Demonstration,
    Found,
    LabelCorrection,
    LearningOutcome,
    NoProgram,
    Options,
    Repair,
    synthesize,
)

Confirm = Callable[[Repair], bool]


@dataclass(frozen=True, slots=True, kw_only=True)
class LearnOptions:
    """How a project is to learn; the fields are those of `Project.synthesize`."""

    accept: bool = True
    options: Options | None = None
    confirm: Confirm | None = None
    stop: Callable[[], bool] | None = None
    answers: Sequence[Answer] = ()
    meshes: Mapping[str, SymbolicMesh] | None = None


def learn_program(store: Store, how: LearnOptions) -> LearningOutcome:
    """What can be learned from the demonstrations. Raises ProjectError where there are none."""
    meshes = FamilyMeshes(store).meshes() if how.meshes is None else how.meshes
    demos = _read_demonstrations(store, meshes)
    inputs = digest_learning_inputs(store)
    answers_file = store.answers()
    fitting, unfit = _sort_answers(store, answers_file, demos, how.answers)
    accepted = _answers_of_accepted(store, demos, fitting)
    asker = _RepairAsker(store, how.confirm) if how.accept and how.confirm else None
    settings = store.settings
    names = dict.fromkeys(name for demo in demos.values() for step in demo.steps for name in step.action.templates)
    confirm = _ask_once(asker or how.confirm) if how.confirm else None
    templates = store.templates(names)
    options = replace(
        how.options or Options(),
        contact=settings.thresholds.contact,
        extremity=settings.thresholds.extremity,
        rejected=tuple(_list_rejections(answers_file)),
        stop=how.stop,
    )

    def learn(answers: Sequence[Answer]) -> LearningOutcome:
        return synthesize(
            tuple(demos.values()),
            batch=meshes,
            orient=store.orientation,
            templates=templates,
            vocabulary=settings.vocabulary or None,
            options=options,
            confirm=confirm,
            answers=answers,
        )

    outcome = learn([*accepted, *fitting])
    if isinstance(outcome, NoProgram) and accepted:
        overruled = tuple(dict.fromkeys(answer.asset for answer in accepted))
        outcome = replace(learn(fitting), overruled=overruled)
    stale = [answer for answer in outcome.stale if answer not in accepted]
    outcome = replace(outcome, stale=tuple(dict.fromkeys([*unfit, *stale])))
    if how.accept and isinstance(outcome, Found | Ambiguous):
        accept_outcome(store, outcome, asker.inputs if asker and asker.inputs else inputs)
    return outcome


def _ask_once(confirm: Confirm) -> Confirm:
    """Asks about each correction once, however often something is learned."""
    answers: dict[LabelCorrection, bool] = {}

    def ask(repair: Repair) -> bool:
        if repair.correction not in answers:
            answers[repair.correction] = confirm(repair)
        return answers[repair.correction]

    return ask


class _RepairAsker:
    """Asks about repairs and keeps the answers at once. inputs: the digest of what is learned from, since then."""

    def __init__(self, store: Store, confirm: Confirm) -> None:
        self._store, self._confirm = store, confirm
        self.inputs: str | None = None

    def __call__(self, repair: Repair) -> bool:
        right = self._confirm(repair)
        (confirm_repair if right else reject_repair)(self._store, repair.correction)
        self.inputs = digest_learning_inputs(self._store)
        return right


def _read_demonstrations(store: Store, meshes: Mapping[str, SymbolicMesh]) -> dict[str, Demonstration]:
    ids = store.demonstration_ids()
    if not ids:
        raise ProjectError(
            "nothing is demonstrated yet",
            where=str(store.folder),
            remedy=f"Show the steps on an asset or two: meshforge demonstrate {store.folder} ASSET STEPS...",
        )
    # one that cannot be read is missing among the meshes; reading it again says why
    return {asset: Demonstration(meshes.get(asset) or store.mesh(asset), store.steps(asset), asset) for asset in ids}


def _sort_answers(
    store: Store, said: AnswersFile, demos: Mapping[str, Demonstration], more: Sequence[Answer]
) -> tuple[list[Answer], list[Answer]]:
    """The answers to learn from, and those to a rule that does something else by now."""
    lines = {line.id: line for line in [*said.answers, *(check_answer(store, answer) for answer in more)]}
    actions = actions_of(demo.steps for demo in demos.values())

    def fits(line: AnswerLine) -> bool:
        return actions.get(line.rule) == (line.action or actions.get(line.rule, ""))

    fitting = [line.answer for line in lines.values() if fits(line)]
    return fitting, [line.answer for line in lines.values() if not fits(line)]


def _answers_of_accepted(store: Store, demos: Mapping[str, Demonstration], said: Sequence[Answer]) -> list[Answer]:
    """What rules select on results that were accepted, but for what was said otherwise, or of rules that are others."""
    actions = actions_of(demo.steps for demo in demos.values())
    known = {(answer.rule, answer.asset) for answer in said}
    return [
        Answer(one.rule, asset, one.select)
        for asset, seen in find_accepted_results(store).items()
        for one in seen
        if actions.get(one.rule) == one.action and (one.rule, asset) not in known
    ]


def _list_rejections(answers: AnswersFile) -> list[LabelCorrection]:
    """What is not to be proposed: what was refused, and what would undo a confirmed repair."""
    undone = (line.correction.reverse for line in answers.confirmed)
    return [*(line.correction for line in answers.rejected), *(reverse for reverse in undone if reverse)]
