"""What a person says while a program is learned: answers to questions, and repairs of labels, confirmed or rejected."""

from __future__ import annotations

from collections.abc import Iterable

from meshforge.common import MeshForgeError, ProjectError, UsageError, nearest_name
from meshforge.labels import merge
from meshforge.store import (
    AnswerLine,
    ConfirmationLine,
    LabelBefore,
    RepairLine,
    Store,
    action_text_without_each,
    hull_digests,
    repair_id,
)
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import Answer, LabelCorrection, Question, Step


def add_answer(store: Store, given: Answer) -> str:
    """Keep an answer in place of an earlier one to the same question, and give its id. Raises as `check_answer`."""
    line = check_answer(store, given)
    with store.lock():
        store.write_answers(store.answers().with_line(line))
    return line.id


def answer_by_choice(question: Question, choice: int | None) -> Answer:
    """The answer that takes a choice, counted from 0. Raises UsageError where there is no such choice."""
    if choice is not None and not 0 <= choice < len(question.choices):
        raise UsageError(f"the question {question.id} has {len(question.choices)} choices, none at place {choice}")
    return question.answer_with(choice)


def check_answer(store: Store, given: Answer) -> AnswerLine:
    """An answer as it is kept. Raises ProjectError: no such asset, or no such rule. Its hulls may be made by a rule."""
    store.path(given.asset)
    actions = actions_of(map(store.steps, store.demonstration_ids()))
    if given.rule not in actions:
        shown = f"only rules 1 to {max(actions)} are" if actions else "nothing is"
        raise ProjectError(f"there is no rule {given.rule} to answer for: {shown} demonstrated", where=given.asset)
    select = None if given.select is None else tuple(sorted(given.select))
    identity = f"{given.rule}:{given.asset}"
    refused = tuple(tuple(sorted(choice)) for choice in given.refused)
    action = actions[given.rule]
    return AnswerLine(id=identity, rule=given.rule, asset=given.asset, select=select, action=action, refused=refused)


def actions_of(demonstrations: Iterable[Iterable[Step]]) -> dict[int, str]:
    """What each rule does, as the first demonstration that shows it says, without `Each`."""
    found: dict[int, str] = {}
    for step in (step for steps in demonstrations for step in steps if step.shown):
        found.setdefault(step.rule, action_text_without_each(step.action, step.label))
    return dict(sorted(found.items()))


def confirm_repair(store: Store, right: LabelCorrection) -> str:
    """Repair a label as a person confirmed it, remembering what was there before; give the id of the repair.

    Raises ProjectError where there is no such asset, hull or label, or where the hull has got another label since.
    """
    with store.lock():
        mesh = store.mesh(right.asset)
        labels, problem = _repair_label(store, mesh, right)
        if problem:
            raise ProjectError(problem, where=right.asset, remedy=f"Learn again: meshforge synthesize {store.folder}")
        answers, identity = store.answers(), repair_id(right)
        known = [line.before for line in answers.confirmed if line.id == identity]
        current = mesh.hull_of(right.hull).annotation
        before = known[0] if known and current == _label_of_repair(right) else LabelBefore.of(current)
        line = ConfirmationLine(
            id=identity, asset=right.asset, hull=right.hull, was=right.was, to=right.to, before=before
        )
        # the record first: killed in between, the repair is merely proposed again
        store.write_answers(answers.with_line(line))
        store.write_labels(right.asset, hull_digests(mesh), labels, store.vocabulary)
    return identity


def reject_repair(store: Store, wrong: LabelCorrection) -> str:
    """Remember that a repair was refused, so that it is not proposed again; give its id."""
    store.path(wrong.asset)
    identity = repair_id(wrong)
    line = RepairLine(id=identity, asset=wrong.asset, hull=wrong.hull, was=wrong.was, to=wrong.to)
    with store.lock():
        store.write_answers(store.answers().with_line(line))
    return identity


def take_back(store: Store, entry: str) -> str | None:
    """Take back an answer or a repair by its id; of a confirmed repair the hull gets the label it had before.

    Gives a sentence where that label is left alone, since it was changed after the repair.
    Raises ProjectError, naming the nearest id, where there is no such one.
    """
    with store.lock():
        kept = store.answers()
        if entry not in kept.ids:
            like = nearest_name(entry, kept.ids)
            listing = f"See what was said: meshforge synthesize {store.folder} --list-answers"
            remedy = f"Did you mean {like!r}?" if like else listing
            raise ProjectError(f"there is no answer or repair {entry!r}", where=str(store.folder), remedy=remedy)
        notes = [_restore_label(store, line) for line in kept.confirmed if line.id == entry]
        store.write_answers(kept.without(entry))
    return next(iter(notes), None)


def take_back_all(store: Store) -> tuple[str, ...]:
    """Take back everything; gives the sentences about labels that are left alone."""
    notes = [take_back(store, entry) for entry in store.answers().ids]
    return tuple(note for note in notes if note)


def _label_of_repair(correction: LabelCorrection) -> Label:
    return Label(correction.to, 1.0, "repair")


def _repair_label(store: Store, mesh: SymbolicMesh, right: LabelCorrection) -> tuple[dict[str, Label], str | None]:
    """The labels of a mesh with one repaired, and why that cannot be."""
    given = {right.hull: _label_of_repair(right)}
    labels, report = merge.merge_labels(right.asset, mesh.index, mesh.labels, given, store.vocabulary)
    if report.problems:
        return labels, report.problems[0]
    label = mesh.hull_of(right.hull).label
    if label not in (right.was, right.to):
        return labels, f"{right.hull} is labelled {label or 'nothing'} now, no longer {right.was or 'nothing'}"
    return labels, None


def _restore_label(store: Store, line: ConfirmationLine) -> str | None:
    """Give a hull the label back that it had before a repair; a sentence on why, where that is not done."""
    try:
        mesh = store.mesh(line.asset)
        current = mesh.hull_of(line.hull).annotation
    except MeshForgeError as error:
        return f"the label of {line.hull} in {line.asset} is left as it is: {error.problem}"
    before = line.before.annotation if line.before else None
    if current not in (before, _label_of_repair(line.correction)):
        state = f"labelled {current.name}" if current else "without a label"
        return f"{line.hull} in {line.asset} is left {state}, as it was changed after the repair"
    if current != before:
        labels = mesh.with_labels({line.hull: before}).labels
        store.write_labels(line.asset, hull_digests(mesh), labels, store.vocabulary)
    return None
