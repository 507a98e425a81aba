"""What becomes of a reply to a question of a review: it is kept as events, and then done."""

from collections.abc import Callable
from typing import assert_never

from meshforge import batch
from meshforge.batch import IN_PROCESS, Failed
from meshforge.common import ProjectError, join_names, suggest_name
from meshforge.labels import label_project, set_labels_of
from meshforge.project import demonstrations, run
from meshforge.signoff import ReviewChoice, ReviewQuestion, ReviewReply
from meshforge.signoff.question import EXCLUDE, NO, RIGHT, WRONG
from meshforge.store import ExclusionEvent, LabelsEvent, Origin, ReplyEvent, SnoozeEvent, Store
from meshforge.synthesis import Answer, LabelFix


def reply_to(store: Store, question: ReviewQuestion, reply: ReviewReply) -> None:
    """Keep what a person said to a question, and do it; killed in between, the question is asked again.

    Raises ProjectError, with nothing kept, where the reply does not fit.
    """
    choice, origin = find_choice(question, reply), Origin.of(question, reply)
    if reply.later:
        _snooze(store, origin)
        return
    match question.kind:
        case "candidate" | "label":
            refused = [one.select or () for one in question.choices] if choice is None else []
            select = None if choice is None else choice.select
            answer = Answer(question.rule or 1, question.asset, select, refused)
            store.add_events(demonstrations.check_answer(store, answer).with_origin(origin))
        case "group":
            _label(store, question, choice, reply)
        case "repair":
            _repair(store, question, choice, reply)
        case "result":
            _judge(store, question, choice, reply)
        case "selection":
            if choice is None or choice.id == NO:
                _snooze(store, origin)
            elif choice.label:
                _label(store, question, choice, reply)
            else:
                place, select = (question.asset, question.rule or 1), choice.select or ()
                _do(store, origin, lambda: demonstrations.correct_selection(store, *place, select, origin))
        case "orientation":
            if choice is None or choice.orient is None:
                _snooze(store, origin)
            else:
                turned = choice.orient
                _do(store, origin, lambda: store.set_orientation(turned))
        case "demonstrate":
            _snooze(store, origin)
        case _:
            assert_never(question.kind)


def find_choice(question: ReviewQuestion, reply: ReviewReply) -> ReviewChoice | None:
    """Return the choice that a reply names, None for none of them. Raises ProjectError for one that there is not, and
    for more than can be said to the question."""
    choice = question.choice(reply.choice)
    ids = [one.id for one in question.choices]
    if reply.choice is not None and choice is None:
        remedy = suggest_name(reply.choice, ids, f"Its choices are: {join_names(ids) or 'none'}.")
        raise ProjectError(f"question {question.id} has no choice {reply.choice!r}", remedy=remedy)
    is_wrong = question.kind == "result" and reply.choice == WRONG
    if (reply.selections or reply.labels) and not is_wrong:
        remedy = f'They go with the choice "{WRONG}" of a question whether a result is right.'
        raise ProjectError(f"question {question.id} takes no selections and labels with that reply", remedy=remedy)
    if unknown := [place for place in reply.exceptions if place not in question.hulls]:
        raise ProjectError(f"question {question.id} is not about {unknown[0].hull} of {unknown[0].asset}")
    return choice


def _snooze(store: Store, origin: Origin) -> None:
    store.add_events(SnoozeEvent(**origin._asdict()))


def _do(store: Store, origin: Origin, effect: Callable[[], object]) -> None:
    store.add_events_before(effect, ReplyEvent(**origin._asdict()))


def _judge(store: Store, question: ReviewQuestion, choice: ReviewChoice | None, reply: ReviewReply) -> None:
    """Keep a verdict on the result as the program makes it now, or why an asset is given up."""
    asset, origin = question.asset, Origin.of(question, reply)
    if choice is None:
        _snooze(store, origin)
    elif choice.id in EXCLUDE:
        reason = EXCLUDE[choice.id]
        store.add_events(ExclusionEvent(asset=asset, reason=reason, **origin._asdict()))
    elif choice.id == RIGHT:
        program, jobs, templates = run.build_work(store, {asset})
        for outcome in batch.apply(program, jobs, store.layout.edited, templates=templates, execution=IN_PROCESS):
            if isinstance(outcome, Failed):
                raise ProjectError(f"{asset} cannot be edited: {outcome.error}", where=str(store.folder))
        run.review_assets(store, asset, "accepted", goals=question.goals, origin=origin)
    else:
        run.review_assets(store, asset, "wrong", selections=reply.selections, labels=reply.labels, origin=origin)
        if reply.labels:
            _agree_again(store)
        if not (reply.selections or reply.labels) and question.choice(RIGHT) is None:
            _snooze(store, origin)  # it was called wrong before, and nothing more was said


def _label(store: Store, question: ReviewQuestion, choice: ReviewChoice | None, reply: ReviewReply) -> None:
    given = dict.fromkeys(question.hulls, choice.label) if choice and choice.label else {}
    labels = dict[str, dict[str, str]]()
    for place, label in sorted({**given, **reply.exceptions}.items()):
        labels.setdefault(place.asset, {})[place.hull] = str(label)
    origin = Origin.of(question, reply)
    if not labels:
        _snooze(store, origin)
        return
    event = LabelsEvent(labels=labels, **origin._asdict())
    store.add_events_before(lambda: set_labels_of(store, labels), event)
    _agree_again(store)


def _repair(store: Store, question: ReviewQuestion, choice: ReviewChoice | None, reply: ReviewReply) -> None:
    """Fix the label of a hull, so that it can be withdrawn, or keep it; what was refused is not proposed again."""
    (place,), origin = question.hulls, Origin.of(question, reply)
    label = reply.exceptions.get(place) or (choice.label if choice else None)
    if label is None:
        _snooze(store, origin)
        return
    proposed, was = question.choices[0].label, store.mesh(place.asset).hull_of(place.hull).label
    if label != was:
        demonstrations.confirm(store, LabelFix(place.asset, place.hull, was, label), origin)
    elif proposed:
        demonstrations.reject(store, LabelFix(place.asset, place.hull, was, proposed), origin)
        set_labels_of(store, {place.asset: {place.hull: label}})
    _agree_again(store)


def has_agreed_labels(store: Store) -> bool:
    """Return whether labels that sources gave were replaced, so that others may follow what a person says of one."""
    return any(label.given for asset in store.assets() for label in store.labels(asset).labels.values())


def _agree_again(store: Store) -> None:
    if has_agreed_labels(store):
        label_project(store, "propagate")
