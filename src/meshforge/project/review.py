"""A project's family reviewed: how probable each edit is, the questions that are worth most, and sign-offs.

A sign-off rests on the digests of all that decides an edit: it is void when one of them changes.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from meshforge.batch import EXECUTION_DEFAULTS, ExecutionOptions, program_digest
from meshforge.common import MeshForgeError, ProjectError
from meshforge.label_model import model_family
from meshforge.labels.descriptor_cache import recall_descriptors
from meshforge.language import Program
from meshforge.project import learn
from meshforge.project.alarms import measure_results
from meshforge.project.family_state import FamilyStateReader
from meshforge.project.hull_mapping import describe_replaced
from meshforge.project.sign_offs import AssessmentBasis, Clock, keep_assessment, now_utc, renew_sign_offs
from meshforge.signoff import BAR, Assessment, AssetConfidence, Doubt, EditMeasures, ResultQuestion, ReviewState
from meshforge.signoff.outliers import describe_odd_results
from meshforge.signoff.question import YES_OR_NO, identify
from meshforge.signoff.review import EXCLUDE_CHOICES, review_family
from meshforge.store import Store
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Ambiguous, Found, LearningOutcome

_NOT_MEANT = 0.5  # the probability that not all new hulls are meant where a demonstration named the one before


@dataclass(frozen=True, eq=False)
class ProjectReview:
    """How a family stands. outcome: of learning, None where nothing is demonstrated; state: what is known of it;
    lost: why some assets could not be read, by id; taken_back: why some are no longer signed off."""

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
    if not meshes and not lost:
        raise ProjectError("there is nothing to review: no asset is of this family", where=str(store.folder))
    if not meshes:
        raise ProjectError("there is no asset that can be read", where=str(store.folder))
    recall_descriptors(store, meshes, execution)
    outcome, by_hand = _learn(store, meshes)
    made = assess_family(store, meshes, outcome, before, bar, by_hand=by_hand, lost=lost)
    assert made, "nobody stops it"
    made.keep(store, execution)
    taken_back = renew_sign_offs(store, clock=clock, execution=execution)
    return ProjectReview(made.found, outcome, made.state, lost, taken_back)


@dataclass(frozen=True, eq=False, slots=True)
class FamilyAssessment:
    """How sure the edits of a project are. program: the one that makes them, None where there is none; basis: what all
    that was computed from; measures: of the edits, by asset."""

    found: Assessment
    state: ReviewState
    program: Program | None
    basis: AssessmentBasis
    measures: Mapping[str, EditMeasures]

    def keep(self, store: Store, execution: ExecutionOptions = EXECUTION_DEFAULTS) -> bool:
        """Keep it, so that a status need not learn anything; whether that was done, as nothing changed meanwhile."""
        return keep_assessment(store, self.found, self.basis, self.measures, execution)


def assess_family(
    store: Store,
    meshes: Mapping[str, SymbolicMesh],
    outcome: LearningOutcome | None,
    before: AssessmentBasis,
    bar: float,
    *,
    by_hand: bool = False,
    lost: Mapping[str, str] = MappingProxyType({}),
    stop: Callable[[], bool] = lambda: False,
) -> FamilyAssessment | None:
    """How sure the edits of a family are; None once `stop` says so.

    meshes: of its assets that can be read, by id; outcome: what was learned, or by hand the program that a person
    wrote; before: taken before the meshes were read; lost: why others cannot be read.
    """
    program = outcome.program if outcome else None
    basis = before.under(store, program or store.program())
    state = FamilyStateReader(store, meshes, program, by_hand, basis.inputs).read()
    measures = measure_results(store, program, meshes, basis.inputs, stop) if program else {}
    family = model_family(list(meshes.values()))
    if stop():
        return None
    shown = [measures[asset] for asset in (*state.demos, *state.accepted) if asset in measures]
    found = review_family(state, outcome, family, bar, describe_odd_results(measures, shown))
    found = _add_unreadable(store, found, state, lost)
    if not by_hand:
        found = _add_demonstration_doubts(store, found, state.accepted | state.corrected)
    return FamilyAssessment(found, state, program, basis, measures)


def _read_meshes(store: Store) -> tuple[dict[str, SymbolicMesh], dict[str, str]]:
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
    if by_hand := learn.program_by_hand(store):
        return by_hand, True
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
    """The same with assets that cannot be read, which need review until a person excludes them."""
    unknown = {
        name: AssetConfidence(name, 0.0, (Doubt("alarm", f"it cannot be read: {why}", share=1.0),))
        for name, why in lost.items()
    }
    every = {**found.assets, **unknown}
    found = replace(found, assets={name: every[name] for name in store.assets() if name in every})
    asked = [_ask_to_exclude(name, lost[name]) for name in found.held if name in lost]
    return replace(found, questions=(*found.questions, *(one for one in asked if one.id not in state.snoozed)))


def _add_demonstration_doubts(store: Store, found: Assessment, looked_at: Collection[str]) -> Assessment:
    """The same, where a program is learned from a demonstration that names hulls which others replaced since, and
    nobody has looked whether all of these are meant.

    looked_at: assets whose result a person found right, or corrected.
    """
    texts = {asset: [*describe_replaced(store, asset)] for asset in store.demonstration_ids() if asset in found.assets}
    if not any(texts.values()):
        return found
    assets = dict(found.assets)
    for asset in assets.keys() - set(looked_at):
        told = (text if one == asset else f"{one}: {text}" for one, own in texts.items() for text in own)
        assets[asset] = assets[asset].with_doubts(Doubt("reading", text, share=_NOT_MEANT) for text in told)
    unseen = {asset for asset, own in texts.items() if own} - set(looked_at)
    return replace(found, assets=assets, looked_at=found.looked_at - unseen)


def _ask_to_exclude(asset: str, why: str) -> ResultQuestion:
    text = f"{asset} cannot be read: {why} Is it to be excluded?"
    draft = ResultQuestion(text, YES_OR_NO, 0.0, asset, choices=EXCLUDE_CHOICES)
    return identify(draft, [why])
