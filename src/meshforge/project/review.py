"""A project's family reviewed: how probable each edit is, the questions that are worth most, and sign-offs.

A sign-off rests on the digests of all that decides an edit: it is void when one of them changes.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from meshforge.batch import EXECUTION_DEFAULTS, ExecutionOptions
from meshforge.common import MeshForgeError, ProjectError
from meshforge.label_model import model_family
from meshforge.labels.descriptor_cache import recall_descriptors
from meshforge.language import Program
from meshforge.project.family_state import measure_results, read_family_state
from meshforge.project.goals import read_goal_statuses
from meshforge.project.learn import renew_program, update_classes
from meshforge.project.sign_offs import AssessmentBasis, Clock, keep_assessment, now_utc, renew_sign_offs
from meshforge.signoff import THRESHOLD, Assessment, EditMeasures, ReviewState, describe_outliers, review_family
from meshforge.store import Store
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import LearningOutcome


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
    store: Store,
    threshold: float = THRESHOLD,
    *,
    clock: Clock = now_utc,
    execution: ExecutionOptions = EXECUTION_DEFAULTS,
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
    classed = update_classes(store, meshes)
    if any(classed[asset] is not mesh for asset, mesh in meshes.items()):
        meshes, before = classed, AssessmentBasis.take(store, execution)
    outcome, by_hand = renew_program(store, meshes)
    made = assess_family(store, meshes, outcome, before, threshold, by_hand=by_hand, lost=lost)
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
    threshold: float,
    *,
    by_hand: bool = False,
    lost: Mapping[str, str] = MappingProxyType({}),
    stop: Callable[[], bool] | None = None,
) -> FamilyAssessment | None:
    """Return how sure the edits of a family are; None once `stop` says so.

    meshes: of its assets that can be read, by id; outcome: what was learned, or by hand the program that a person
    wrote; before: taken before the meshes were read; lost: why others cannot be read.
    """
    program = outcome.program if outcome else None
    basis = before.under(store, program or store.program())
    state = read_family_state(store, meshes, lost, program, by_hand, basis.inputs)
    measures = measure_results(store, program, meshes, basis.inputs, stop) if program else {}
    family = model_family(list(meshes.values()))
    if stop and stop():
        return None
    shown = [replace(measures[asset], misfits=()) for asset in state.demos if asset in measures]
    shown += [measures[asset] for asset in state.accepted if asset in measures]
    goals = read_goal_statuses(store, program, basis.inputs)
    found = review_family(state, outcome, family, threshold, describe_outliers(measures, shown), goals)
    return FamilyAssessment(found, state, program, basis, measures)


def _read_meshes(store: Store) -> tuple[dict[str, SymbolicMesh], dict[str, str]]:
    meshes, lost = dict[str, SymbolicMesh](), dict[str, str]()
    for asset in store.assets():
        try:
            meshes[asset] = store.mesh(asset)
        except MeshForgeError as error:
            lost[asset] = error.sentence
    return meshes, lost
