"""What became of a new asset before the program (hulls that were split, those that were left though they likely span
parts, labels by likeness) in words, as JSON and as doubts; and how probable its edit is, as a review sees it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from meshforge import batch
from meshforge.common import describe_error, join_names, pluralize
from meshforge.label_model import model_family
from meshforge.labels import NEW, HullSpan, pick_evenly
from meshforge.labels.reference_family import MOST_COMPARED, choose_labelled
from meshforge.project.review import ProjectReview
from meshforge.project.span_splits import WENT_ELSEWHERE
from meshforge.signoff import AssetConfidence, Doubt, ReviewState, assess_asset
from meshforge.store import MOST_TOLD, Store, describe_parts
from meshforge.symbolic import Label, LabelFile
from meshforge.synthesis import LearningOutcome

_DIGITS = 3
_BY: Mapping[str, str] = {"name": "by names", "plugin": "by a plug-in"}


@dataclass(frozen=True, slots=True)
class HullSplit:
    """A hull that was split. chance: that it spans parts, None where it was only made anew with its body; told: in
    words; parts: the label of each by its name."""

    hull: str
    chance: float | None
    told: str
    parts: Mapping[str, Label]

    def __str__(self) -> str:
        """`base holds wall and handle, 94%: into wall (99%), 2 handle (97% to 98%)`."""
        parts = describe_parts((label.name, label.confidence) for label in self.parts.values())
        return f"{self.told}: {f'into {parts}' if parts else WENT_ELSEWHERE}"


def parts_of(splits: Iterable[HullSplit]) -> dict[str, Label]:
    """The label of each part of hulls that were split, by its name."""
    return {name: label for split in splits for name, label in split.parts.items()}


@dataclass(frozen=True, slots=True)
class NewAssetResult:
    """What became of a new asset before the program.

    splits: hulls that were split; spanning: those that likely span parts and were not; guesses: labels that the family
    gave to hulls that had none; taken: labels that files, names and plug-ins gave to them before; notes: all else;
    problem: why it could not be prepared.
    """

    asset: str
    splits: tuple[HullSplit, ...] = ()
    spanning: tuple[HullSpan, ...] = ()
    guesses: Mapping[str, Label] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    problem: str | None = None
    taken: Mapping[str, Label] = field(default_factory=dict)

    @property
    def doubts(self) -> tuple[Doubt, ...]:
        """All that was guessed, with the probability that it is wrong, the least sure first."""
        words = [
            (f"{name} is called {one.name} as a part that was split off", one, name)
            for name, one in parts_of(self.splits).items()
        ]
        words += [(f"{name} is called {one.name} by its likeness", one, name) for name, one in self.guesses.items()]
        labels = [Doubt("label", text, (name,), share=1 - one.confidence) for text, one, name in words]
        return tuple(sorted([*self.split_doubts, *labels], key=lambda one: -one.share))

    @property
    def split_doubts(self) -> tuple[Doubt, ...]:
        """Those about which hulls span parts: whether one that was split does not, or one that was left does."""
        told = [(one, one.chance) for one in self.splits]
        splits = [Doubt("label", str(one), (one.hull,), share=1 - chance) for one, chance in told if chance is not None]
        return (*splits, *(Doubt("label", f"{one}: not split", (one.hull,), share=one.chance) for one in self.spanning))

    @property
    def probability(self) -> float:
        """That all of it is right, at most: that of the least sure guess, 1 where nothing was guessed."""
        return 1 - max((one.share for one in self.doubts), default=0.0)

    def describe(self) -> tuple[str, ...]:
        """A sentence on each split, each hull that was left, and on the labels."""
        rows = [*map(str, self.splits), *(f"{span}: not split" for span in self.spanning)]
        counts = Counter(_BY.get(one.source, "from a file") for one in self.taken.values())
        rows += [f"{pluralize(count, 'label')} {by}" for by, count in counts.items()]
        if self.guesses:
            name, least = min(self.guesses.items(), key=lambda row: row[1].confidence)
            rows.append(
                f"{pluralize(len(self.guesses), 'label')} by likeness to the family; "
                f"least sure: {name} is {least.name}, {min(least.confidence, MOST_TOLD):.0%}"
            )
        return (*rows, *self.notes)

    def to_json(self) -> dict[str, Any]:
        """What the line of `apply --json` says of it."""
        return {
            "split": [
                {
                    "hull": one.hull,
                    "chance": None if one.chance is None else round(one.chance, _DIGITS),
                    "into": [
                        {"hull": name, "label": label.name, "confidence": label.confidence}
                        for name, label in one.parts.items()
                    ],
                }
                for one in self.splits
            ],
            "spanning": [
                {"hull": one.hull, "chance": round(one.chance, _DIGITS), "holds": list(one.shares)}
                for one in self.spanning
            ],
            "labelled": {
                name: {"label": one.name, "confidence": one.confidence, "source": one.source}
                for name, one in self.taken.items()
            },
            "guessed": {name: {"label": one.name, "confidence": one.confidence} for name, one in self.guesses.items()},
            "sure_at_most": round(self.probability, _DIGITS),
        }


def describe_new(results: Sequence[NewAssetResult]) -> str | None:
    """How many hulls of new assets were split, and how many likely span parts and were not; None where none."""
    splits, left = sum(len(one.splits) for one in results), sum(len(one.spanning) for one in results)
    split = [one.asset for one in results if one.splits]
    parts = [f"{pluralize(splits, 'hull')} of new assets split ({join_names(split)})"] if splits else []
    parts += [f"{pluralize(left, 'hull')} likely {'spans' if left == 1 else 'span'} parts, not split"] if left else []
    return "; ".join(parts) or None


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
        found[job.id] = replace(one.with_doubts(results[job.id].split_doubts), asset=job.id)
    return found


def _choose_state(state: ReviewState) -> ReviewState:
    """The state of few assets: all that were demonstrated or corrected, of labelled and accepted ones some, evenly."""
    files = {asset: LabelFile(labels=mesh.labels) for asset, mesh in state.meshes.items()}
    accepted = pick_evenly(sorted(state.accepted), MOST_COMPARED)
    some = {*state.demos, *state.corrected, *accepted, *choose_labelled(files)}
    meshes = {asset: mesh for asset, mesh in state.meshes.items() if asset in some}
    return replace(state, meshes=meshes, accepted=frozenset(accepted))


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
