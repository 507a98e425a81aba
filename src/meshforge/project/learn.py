"""The program of a project: learned from its demonstrations and from what a person said since, accepted, and compared
with what it was learned from.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from meshforge.batch import RECORD_FILE, file_digest, program_digest, text_digest
from meshforge.common import ProgramError, ProjectError, write_atomically
from meshforge.language import Program
from meshforge.project.answer import actions_of, check_answer, confirm_repair, reject_repair
from meshforge.project.family import FamilyMeshes
from meshforge.project.review import find_accepted_results
from meshforge.store import AnswerLine, AnswersFile, ProgramRecord, Settings, Store
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


@dataclass(frozen=True, slots=True)
class ProgramState:
    """Whether a program is up to date with what it was learned from.

    outdated: whether that changed since; question: the id of the one that was open when it was learned;
    by_hand: whether a person wrote or changed the program, which then was learned from nothing.
    """

    outdated: bool = False
    question: str | None = None
    by_hand: bool = False


def accept_outcome(store: Store, outcome: Found | Ambiguous, inputs: str) -> None:
    """Keep a learned program, and what it was learned from."""
    store.write_program(outcome.program)
    question = outcome.question.id if outcome.question else None
    record = ProgramRecord(
        program=program_digest(outcome.program), lesson=inputs, status=outcome.status, question=question
    )
    store.write_program_record(record)


def read_program_state(store: Store) -> ProgramState:
    """The state of the project's program; one that does not parse was written by a person."""
    try:
        return program_state_of(store, store.program())
    except ProgramError:
        return ProgramState(by_hand=True)


def program_state_of(store: Store, program: Program | None) -> ProgramState:
    """The state of a program; one that a person wrote or changed is never outdated."""
    if program is None:
        return ProgramState()
    record = store.program_record()
    if not record or record.program != program_digest(program):
        return ProgramState(by_hand=True)
    outdated = record.lesson != digest_learning_inputs(store)
    return ProgramState(outdated, None if outdated else record.question)


def replace_program(store: Store, old: Program, new: Program, inputs: str, settings: Settings) -> None:
    """Keep a program in which a label was renamed, in the same state; under the lock that the caller holds.

    inputs: the digest of what was learned from, before anything was renamed; settings: what they are going to be.
    What it was learned from is written first: killed in between, it is that of the new program already.
    """
    record = store.program_record()
    if record and record.program in (program_digest(old), program_digest(new)):
        now = digest_learning_inputs(store, settings) if record.lesson == inputs else record.lesson
        store.write_program_record(record.model_copy(update={"program": program_digest(new), "lesson": now}))
    if new != old:
        write_atomically(store.layout.program, str(new))


def digest_learning_inputs(store: Store, settings: Settings | None = None) -> str:
    """The digest of all that is learned from: settings, what a person said, and all about the assets of which they said
    something: steps, labels and files. settings: in place of those that are written.
    """
    layout, settings = store.layout, settings or store.settings
    words = [settings.orient, str(settings.vocabulary), str(settings.thresholds)]
    words += [file_digest(layout.answers)] if layout.answers.exists() else []
    concerned = {line.asset for line in store.answers().answers} | set(store.demonstration_ids())
    for asset, path in store.found.ids.items():
        if asset in concerned:
            files = [layout.demonstration(asset), layout.labels(asset), layout.preparation(asset) / RECORD_FILE, path]
            words += [asset, *(file_digest(file) for file in files if file.is_file())]
    return text_digest("\n".join(words))


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
