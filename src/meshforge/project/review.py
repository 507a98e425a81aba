"""A project's family reviewed: how probable each edit is, the question that is worth most, replies, and sign-offs.

A sign-off rests on the digests of all that decides an edit: it is void when one of them changes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Literal

from meshforge.batch import IN_PROCESS, ExecutionOptions, Failed, OutputInputs, apply, inputs_of, read_stamp
from meshforge.common import MeshForgeError, ProjectError
from meshforge.label_model import model_family
from meshforge.labels.merge import set_labels
from meshforge.language import Program
from meshforge.project import demonstrations, learn, run
from meshforge.signoff import BAR, Assessment, Reply, ReviewQuestion, ReviewState, find_alarms, review_family
from meshforge.signoff.question import ASIDE, RIGHT, Selections
from meshforge.store import AssessmentFile, ConfidenceLine, SignOff, Store, Verdict, find_changes, survey
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, Found, LabelCorrection, LearningOutcome

Clock = Callable[[], datetime]


def now_utc() -> datetime:
    """The present time."""
    return datetime.now(UTC)


@dataclass(frozen=True, eq=False)
class ProjectReview:
    """How a family stands. outcome: of learning, None where nothing is demonstrated; state: what is known of it;
    lost: why some assets could not be looked at, by id."""

    assessment: Assessment
    outcome: LearningOutcome | None
    state: ReviewState
    lost: Mapping[str, str]


def review_project(
    store: Store, bar: float = BAR, *, clock: Clock = now_utc, execution: ExecutionOptions | None = None
) -> ProjectReview:
    """Learn the program from all that is known, unless a person wrote it, and look how the family stands under it.

    What is found is kept, and assets at or above the bar are signed off; so are those that a person accepted.
    Raises ProjectError where there is no asset that can be read.
    """
    meshes, lost = _read_meshes(store)
    if not meshes:
        raise ProjectError("there is no asset that can be read", where=str(store.folder))
    outcome = _learn(store, meshes)
    state = _build_state(store, meshes)
    execution = execution or ExecutionOptions()
    alarms = _find_alarms(store, find_inputs(store, execution))
    assessment = review_family(state, outcome, model_family(list(meshes.values())), bar, alarms)
    _keep(store, assessment, execution, clock)
    return ProjectReview(assessment, outcome, state, lost)


def _find_alarms(store: Store, inputs: Mapping[str, OutputInputs]) -> dict[str, list[str]]:
    """What stands out among the results that are up to date, a sentence each, by asset."""
    measures = {}
    for asset, now in inputs.items():
        stamp = read_stamp(store.layout.edited, asset)
        if stamp and stamp.measures and stamp.inputs and not find_changes(now, stamp.inputs):
            measures[asset] = stamp.measures
    return {asset: [alarm.text for alarm in alarms] for asset, alarms in find_alarms(measures).items()}


def _read_meshes(store: Store) -> tuple[dict[str, SymbolicMesh], dict[str, str]]:
    """All assets by id, and why some cannot be read."""
    meshes, lost = dict[str, SymbolicMesh](), dict[str, str]()
    for asset in store.assets():
        try:
            meshes[asset] = store.mesh(asset)
        except MeshForgeError as error:
            lost[asset] = error.sentence
    return meshes, lost


def _learn(store: Store, meshes: Mapping[str, SymbolicMesh]) -> LearningOutcome | None:
    program = store.program()
    if program is not None and learn.program_state_of(store, program).by_hand:
        return Found(rules=program.rules, readings=(), tried=(), seconds={}, program=program)
    if not store.demonstration_ids():
        return None
    some = set(learn.select_assets(store))
    return learn.learn_program(store, meshes={name: mesh for name, mesh in meshes.items() if name in some})


def _build_state(store: Store, meshes: Mapping[str, SymbolicMesh]) -> ReviewState:
    settings, program = store.settings, store.program()
    limits = settings.thresholds
    words = settings.vocabulary or tuple(sorted({h.label for mesh in meshes.values() for h in mesh.hulls if h.label}))
    frame = Program(words, store.orientation, (), limits.contact, limits.extremity)
    names = program.templates if program else ()
    accepted, verdicts = find_accepted(store), find_verdicts(store)
    by_hand = program is not None and learn.program_state_of(store, program).by_hand
    shown = {} if by_hand else {name: demo for name, demo in store.demonstrations().items() if name in meshes}
    return ReviewState(
        meshes,
        frame,
        store.templates(names),
        shown,
        tuple(line.answer for line in store.answers().answers),
        {asset: done for asset, done in accepted.items() if asset in meshes},
        {asset: () for asset, verdict in verdicts.items() if verdict == "accepted" and asset not in accepted},
        frozenset(asset for asset, verdict in verdicts.items() if verdict == "flagged"),
        frozenset(store.sign_offs().later),
    )


def find_accepted(store: Store) -> dict[str, Selections]:
    """What each rule selected on results that a person accepted as they are."""
    return {
        asset: tuple(frozenset(one.select) for one in sorted(seen, key=lambda one: one.rule))
        for asset, seen in run.find_accepted_results(store).items()
    }


def find_verdicts(store: Store) -> dict[str, Verdict]:
    """What a person said about each output that is still as it was then."""
    present = {asset: run.output_digest(read_stamp(store.layout.edited, asset)) for asset in store.reviews()}
    return {asset: one.verdict for asset, one in store.reviews().items() if one.output == present[asset]}


def find_inputs(store: Store, execution: ExecutionOptions) -> dict[str, OutputInputs]:
    """The digests of all that decides the edit of each asset that can be read; none where there is no program."""
    program = store.program()
    if program is None:
        return {}
    facts = survey(store.found, store.layout, execution=execution)
    task = run.build_task(store, program)
    return {
        job.id: inputs_of(task, job, dict(facts[job.id].files))
        for job in run.build_jobs(store)
        if not facts[job.id].error
    }


def _keep(store: Store, found: Assessment, execution: ExecutionOptions, clock: Clock) -> None:
    """Keep what was found, and sign off what may be; sign-offs that are void are taken away."""
    inputs = find_inputs(store, execution)
    assets = {name: one for name, one in found.assets.items() if name in inputs}
    lines = {name: ConfidenceLine.of(one, inputs[name]) for name, one in assets.items()}
    store.write_assessment(AssessmentFile(bar=found.bar, assets=lines))
    when, signed = clock().isoformat(timespec="seconds"), set(found.signed_off)
    with store.lock():
        before = store.sign_offs()
        kept = {
            name: one
            for name, one in before.assets.items()
            if name in signed and name in inputs and not find_changes(inputs[name], one.rests_on)
        }
        for name in sorted(signed - kept.keys()):
            if name in assets:
                by: Literal["person", "tool"] = "person" if name in found.looked_at else "tool"
                sure = assets[name].probability
                kept[name] = SignOff(by=by, when=when, probability=sure, rests_on=inputs[name])
        store.write_sign_offs(before.model_copy(update={"assets": dict(sorted(kept.items()))}))


def reply_to(store: Store, review: ProjectReview, question: ReviewQuestion, reply: Reply) -> None:
    """Keep what a person said to a question. Raises ProjectError where it does not fit."""
    choices = question.choices
    if reply.choice is not None and not 0 <= reply.choice < len(choices):
        raise ProjectError(f"question {question.id} has {len(choices)} choices", remedy="Count them from 0.")
    choice = None if reply.choice is None else choices[reply.choice]
    if reply.later or (choice is None and question.kind not in ("reading", "label") and not reply.exceptions):
        _put_off(store, question.id)
    elif question.kind == "result":
        assert choice is not None
        _make_output(store, question.asset)
        note = "set aside" if choice.text == ASIDE else None
        run.review_assets(store, question.asset, "accepted" if choice.text == RIGHT else "flagged", note)
    elif question.kind == "orientation":
        if choice is not None and choice.orient is not None:
            store.set_orientation(choice.orient)
        _put_off(store, question.id)
    elif question.kind in ("reading", "label"):
        refused = [one.select or () for one in choices] if choice is None else []
        select = None if choice is None else choice.select
        demonstrations.add_answer(store, Answer(question.rule or 1, question.asset, select, refused))
    else:
        _write_labels(store, review.state, question, reply)


def _make_output(store: Store, asset: str) -> None:
    """Make the output that a verdict is about, where it is not there as it would be now."""
    program, jobs, templates = run.build_work(store, {asset})
    for outcome in apply(program, jobs, store.layout.edited, templates=templates, execution=IN_PROCESS):
        if isinstance(outcome, Failed):
            raise ProjectError(f"{asset} cannot be edited: {outcome.error}", where=str(store.folder))


def _put_off(store: Store, question: str) -> None:
    with store.lock():
        kept = store.sign_offs()
        if question not in kept.later:
            store.write_sign_offs(kept.model_copy(update={"later": (*kept.later, question)}))


def _write_labels(store: Store, state: ReviewState, question: ReviewQuestion, reply: Reply) -> None:
    """Labels that a person gave: of a repair as such, so that it can be taken back; of a group as theirs."""
    choice = None if reply.choice is None else question.choices[reply.choice]
    given = dict.fromkeys(question.hulls, choice.label) if choice is not None and choice.label else {}
    for place, label in sorted({**given, **reply.exceptions}.items()):
        was = state.meshes[place.asset].hull_of(place.hull).label
        if question.kind == "repair" and label and label != was:
            demonstrations.confirm(store, LabelCorrection(place.asset, place.hull, was, label))
        elif label:
            set_labels(store, place.asset, {place.hull: label}, "user", 1.0)


def list_sign_offs(store: Store, inputs: Mapping[str, OutputInputs]) -> dict[str, tuple[SignOff, tuple[str, ...]]]:
    """Each sign-off, with what changed since of all that it rests on; nothing where it holds."""
    found = {}
    for asset, one in store.sign_offs().assets.items():
        changes = find_changes(inputs[asset], one.rests_on) if asset in inputs else ("asset",)
        found[asset] = (one, changes)
    return found
