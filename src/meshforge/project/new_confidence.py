"""How probable the edits of assets are that are not of a project, as a review of it sees them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from meshforge import batch
from meshforge.common import describe_error
from meshforge.label_model import model_family
from meshforge.labels import NEW
from meshforge.labels.reference_family import MOST_COMPARED, choose_labelled
from meshforge.project.new_asset_result import NewAssetResult
from meshforge.project.review import ProjectReview
from meshforge.project.run import pick_evenly
from meshforge.signoff import AssetConfidence, Doubt, ReviewState, assess_asset
from meshforge.store import Store
from meshforge.symbolic import LabelFile
from meshforge.synthesis import LearningOutcome

_MOST_DOUBTS = 3


@dataclass(frozen=True, eq=False, slots=True)
class _Task:
    """state: of the assets that a new one is compared with; contact: the threshold, None for the language's own."""

    state: ReviewState
    outcome: LearningOutcome | None
    contact: float | None


def assess_new_assets(
    store: Store,
    review: ProjectReview,
    jobs: Sequence[batch.AssetJob],
    results: Mapping[str, NewAssetResult],
    execution: batch.ExecutionOptions,
) -> dict[str, AssetConfidence]:
    """How probable the edits of assets are that were prepared beside a project, each by itself, by id.

    results: what was guessed of them: an edit is at most as sure as that a hull which was split spans parts, and that
    one which was left does not. What their labels mean for the edit, the review of the project says.
    """
    task = _Task(_choose_state(review.state), review.outcome, store.settings.thresholds.contact)
    new = [job for job in jobs if job.id in results]
    found = dict[str, AssetConfidence]()
    for job, one in zip(new, batch.execute(partial(_assess, task), new, execution), strict=True):
        if isinstance(one, batch.WorkerFailure):
            one = _describe_failure(one.why)
        found[job.id] = _add_splits(job.id, one, results[job.id])
    return found


def _choose_state(state: ReviewState) -> ReviewState:
    """The state of few assets: all that were demonstrated or corrected, of labelled and accepted ones some, evenly."""
    files = {asset: LabelFile(labels=mesh.labels) for asset, mesh in state.meshes.items()}
    accepted = pick_evenly(list(state.accepted), MOST_COMPARED)
    some = {*state.demos, *state.mended, *accepted, *choose_labelled(files)}
    meshes = {asset: mesh for asset, mesh in state.meshes.items() if asset in some}
    return replace(state, meshes=meshes, accepted={asset: state.accepted[asset] for asset in accepted})


def _assess(task: _Task, job: batch.AssetJob) -> AssetConfidence:
    try:
        mesh = batch.read_job(job)
        mesh = mesh if task.contact is None else replace(mesh, epsilon=task.contact)
        state = replace(task.state, meshes={**task.state.meshes, NEW: mesh})
        return assess_asset(state, task.outcome, model_family(list(state.meshes.values())), NEW)
    except Exception as error:  # one asset never stops the others
        return _describe_failure(describe_error(error, str(job.path)))


def _describe_failure(why: str) -> AssetConfidence:
    return AssetConfidence(NEW, 0.0, (Doubt("alarm", f"it could not be looked at: {why}", share=1.0),))


def _add_splits(asset: str, found: AssetConfidence, result: NewAssetResult) -> AssetConfidence:
    own = result.split_doubts
    probability = min(found.probability, 1 - max((one.share for one in own), default=0.0))
    doubts = sorted([*found.doubts, *own], key=lambda one: -one.share)[:_MOST_DOUBTS]
    return AssetConfidence(asset, probability, tuple(doubts))
