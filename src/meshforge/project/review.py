"""A project's family reviewed: how probable each edit is, the question that is worth most, replies, and sign-offs.

A sign-off rests on the digests of all that decides an edit: it is void when one of them changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from meshforge import batch
from meshforge.batch import (
    EXECUTION_DEFAULTS,
    IN_PROCESS,
    ExecutionOptions,
    Failed,
    OutputInputs,
    program_digest,
    text_digest,
)
from meshforge.common import MeshForgeError, ProjectError
from meshforge.label_model import model_family
from meshforge.labels.descriptor_cache import recall_descriptors
from meshforge.labels.family_comparison import ignore_stage
from meshforge.labels.label_by_consensus import label_by_consensus
from meshforge.labels.merge import ignore_report, set_labels
from meshforge.project import demonstrations, learn, run
from meshforge.project.alarms import measure_results
from meshforge.project.family_state import FamilyStateReader
from meshforge.project.sign_offs import AssessmentBasis, Clock, keep_assessment, now_utc, renew_sign_offs
from meshforge.project.span_questions import add_demonstration_doubts, add_span_doubts, answer_span, ask_about_spans
from meshforge.signoff import (
    BAR,
    Assessment,
    AssetConfidence,
    Doubt,
    ReviewChoice,
    ReviewQuestion,
    ReviewReply,
    ReviewState,
    describe_odd_results,
    review_family,
)
from meshforge.signoff.prices import YES_OR_NO
from meshforge.signoff.question import ASIDE, RIGHT
from meshforge.signoff.slips import ON_PURPOSE
from meshforge.store import Store
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Ambiguous, Answer, Found, LabelCorrection, LearningOutcome

_ID_DIGITS = 12


@dataclass(frozen=True, eq=False)
class ProjectReview:
    """How a family stands. outcome: of learning, None where nothing is demonstrated; state: what is known of it;
    lost: why some assets could not be looked at, by id; taken_back: why some are no longer signed off."""

    assessment: Assessment
    outcome: LearningOutcome | None
    state: ReviewState
    lost: Mapping[str, str]
    taken_back: Mapping[str, str] = field(default_factory=dict)


def review_project(
    store: Store, bar: float = BAR, *, clock: Clock = now_utc, execution: ExecutionOptions = EXECUTION_DEFAULTS
) -> ProjectReview:
    """Learn the program from all that is known, unless a person wrote it, and look how the family stands under it.

    What is found is kept, and assets at or above the bar whose output is up to date are signed off; so are those that a
    person showed or accepted. Raises ProjectError where there is no asset that can be read.
    """
    before = AssessmentBasis.take(store, execution)
    meshes, lost = _read_meshes(store)
    if not meshes:
        raise ProjectError("there is no asset that can be read", where=str(store.folder))
    recall_descriptors(store, meshes, execution)
    outcome, by_hand = _learn(store, meshes)
    program = outcome.program if outcome else None
    basis = before.under(store, program or store.program())
    state = FamilyStateReader(store, meshes, program, by_hand, basis.inputs).read()
    measures = measure_results(store, program, meshes, basis.inputs) if program else {}
    alarms = describe_odd_results(measures)
    found = review_family(state, outcome, model_family(list(meshes.values())), bar, alarms)
    found = add_span_doubts(store, meshes, _add_unreadable(store, found, state, lost), state.reviewed_assets)
    if not by_hand:
        found = add_demonstration_doubts(store, found, {*state.accepted, *state.mended})
    found = ask_about_spans(store, meshes, found, program is not None)
    keep_assessment(store, found, basis, measures, execution)
    taken_back = renew_sign_offs(store, clock=clock, execution=execution)
    return ProjectReview(found, outcome, state, lost, taken_back)


def build_review_state(
    store: Store, meshes: Mapping[str, SymbolicMesh], inputs: Mapping[str, OutputInputs]
) -> ReviewState:
    """All that is known of a family under the project's program.

    meshes: of all or some of its assets, by id; inputs: the digests of their edits.
    """
    program = store.program()
    by_hand = program is not None and learn.program_state_of(store, program).by_hand
    return FamilyStateReader(store, meshes, program, by_hand, inputs).read()


def _read_meshes(store: Store) -> tuple[dict[str, SymbolicMesh], dict[str, str]]:
    """All assets by id, and why some cannot be read."""
    meshes, lost = dict[str, SymbolicMesh](), dict[str, str]()
    for asset in store.assets():
        try:
            meshes[asset] = store.mesh(asset)
        except MeshForgeError as error:
            lost[asset] = error.sentence
    return meshes, lost


def _learn(store: Store, meshes: Mapping[str, SymbolicMesh]) -> tuple[LearningOutcome | None, bool]:
    """What is learned, which becomes the project's program, or what a person wrote in its place; and whether so."""
    program = store.program()
    if program is not None and learn.program_state_of(store, program).by_hand:
        return Found(rules=program.rules, readings=(), tried=(), seconds={}, program=program), True
    if not store.demonstration_ids():
        return None, False
    some = set(learn.select_assets(store))
    before = learn.digest_learning_inputs(store)
    outcome = learn.learn_program(store, accept=False, meshes={n: mesh for n, mesh in meshes.items() if n in some})
    if isinstance(outcome, Found | Ambiguous):
        is_same = program is not None and program_digest(program) == program_digest(outcome.program)
        if not is_same or learn.program_state_of(store, program).outdated:
            learn.accept_outcome(store, outcome, before)
    return outcome, False


def _add_unreadable(store: Store, found: Assessment, state: ReviewState, lost: Mapping[str, str]) -> Assessment:
    """The same with assets that cannot be read, which are held until a person sets them aside."""
    unknown = {
        name: AssetConfidence(name, 0.0, (Doubt("alarm", f"it cannot be read: {why}", share=1.0),))
        for name, why in lost.items()
    }
    every = {**found.assets, **unknown}
    found = replace(found, assets={name: every[name] for name in store.assets()})
    asked = (_ask_to_set_aside(name, lost[name]) for name in found.held if name in lost)
    return replace(found, question=found.question or next((one for one in asked if one.id not in state.later), None))


def _ask_to_set_aside(asset: str, why: str) -> ReviewQuestion:
    text = f"{asset} cannot be read: {why} Is it to be set aside?"
    name = text_digest(text)[:_ID_DIGITS]
    return ReviewQuestion(f"result-{name}", "result", text, YES_OR_NO, 0.0, asset, choices=(ReviewChoice(ASIDE),))


def reply_to(store: Store, review: ProjectReview, question: ReviewQuestion, reply: ReviewReply) -> None:
    """Keep what a person said to a question. Raises ProjectError where it does not fit."""
    choices = question.choices
    if reply.choice is not None and not 0 <= reply.choice < len(choices):
        raise ProjectError(f"question {question.id} has {len(choices)} choices", remedy="Count them from 0.")
    choice = None if reply.choice is None else choices[reply.choice]
    if reply.later or (choice is None and question.kind not in ("reading", "label") and not reply.exceptions):
        store.put_off(question.id)
    elif question.kind == "span":
        assert choice is not None
        answer_span(store, question, choice)
    elif question.kind == "result":
        assert choice is not None
        _judge(store, question.asset, choice.text)
    elif question.kind == "orientation":
        if choice is not None and choice.orient is not None:
            store.set_orientation(choice.orient)
        store.put_off(question.id)
    elif question.kind == "selection":
        assert choice is not None
        if choice.text == ON_PURPOSE:
            store.put_off(question.id)
        else:
            demonstrations.correct_selection(store, question.asset, question.rule or 1, choice.select or ())
    elif question.kind in ("reading", "label"):
        refused = [one.select or () for one in choices] if choice is None else []
        select = None if choice is None else choice.select
        demonstrations.add_answer(store, Answer(question.rule or 1, question.asset, select, refused))
    else:
        _write_labels(store, review.state, question, reply)


def _judge(store: Store, asset: str, said: str) -> None:
    """Keep a verdict on the output as the program makes it now; what has none is set aside, unless it were right."""
    try:
        _make_output(store, asset)
    except MeshForgeError:
        if said == RIGHT:
            raise
        with store.lock():
            store.write_sign_offs(store.sign_offs().with_aside(asset))
        return
    note = ASIDE if said == ASIDE else None
    run.review_assets(store, asset, "accepted" if said == RIGHT else "flagged", note)


def _make_output(store: Store, asset: str) -> None:
    """Make the output that a verdict is about, where it is not there as it would be now."""
    program, jobs, templates = run.build_work(store, {asset})
    for outcome in batch.apply(program, jobs, store.layout.edited, templates=templates, execution=IN_PROCESS):
        if isinstance(outcome, Failed):
            raise ProjectError(f"{asset} cannot be edited: {outcome.error}", where=str(store.folder))


def _write_labels(store: Store, state: ReviewState, question: ReviewQuestion, reply: ReviewReply) -> None:
    """Labels that a person gave: of a repair as such, so that it can be taken back; of a group as theirs. A repair that
    they did not want is not proposed again."""
    choice = None if reply.choice is None else question.choices[reply.choice]
    given = dict.fromkeys(question.hulls, choice.label) if choice is not None and choice.label else {}
    for place, label in sorted({**given, **reply.exceptions}.items()):
        was = state.meshes[place.asset].hull_of(place.hull).label
        if question.kind == "repair" and label and label != was:
            demonstrations.confirm(store, LabelCorrection(place.asset, place.hull, was, label))
            continue
        if question.kind == "repair" and (proposed := question.choices[0].label):
            demonstrations.reject(store, LabelCorrection(place.asset, place.hull, was, proposed))
        if label:
            set_labels(store, place.asset, {place.hull: label}, "user", 1.0)
    if any(hull.source == "consensus" for mesh in state.meshes.values() for hull in mesh.hulls):
        label_by_consensus(store, IN_PROCESS, ignore_stage, ignore_report)
