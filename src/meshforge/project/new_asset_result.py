"""What became of a new asset before the program (bodies that were rebuilt, hulls that were left though they likely
span parts, labels by likeness) in words, as JSON and as doubts; and how probable its edit is, as a review sees it."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from meshforge import batch
from meshforge.common import describe_error, join_names, pluralize
from meshforge.label_model import model_family
from meshforge.labels import HullSpan, pick_evenly
from meshforge.labels.reference_family import MOST_COMPARED, choose_labelled
from meshforge.project.rebuild import MOST_SHOWN, RebuiltBody
from meshforge.project.review import ProjectReview
from meshforge.signoff import Reason, ResultStatus, ReviewState, assess_asset
from meshforge.store import Store
from meshforge.symbolic import Label, LabelFile
from meshforge.synthesis import LearningOutcome

_DIGITS = 3
_NEW = ""  # the name of a new asset beside those of a project, whose ids are never empty
_BY: Mapping[str, str] = {"name": "by names", "plugin": "by a plug-in"}


@dataclass(frozen=True, slots=True)
class NewAssetResult:
    """What became of a new asset before the program.

    rebuilt: bodies that were rebuilt; spanning: hulls that likely span parts and were left; guesses: labels that the
    family gave to hulls that had none; taken: labels that files, names and plug-ins gave to them before; notes: all
    else; problem: why it could not be prepared.
    """

    asset: str
    rebuilt: tuple[RebuiltBody, ...] = ()
    spanning: tuple[HullSpan, ...] = ()
    guesses: Mapping[str, Label] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    problem: str | None = None
    taken: Mapping[str, Label] = field(default_factory=dict)

    @property
    def failure(self) -> batch.Failed | None:
        """Why no program runs on it; None where it could be prepared."""
        return batch.Failed(self.asset, f"it could not be prepared: {self.problem}", 0.0) if self.problem else None

    @property
    def new_labels(self) -> dict[str, Label]:
        """The label of each hull of a body that was rebuilt, by its name."""
        return {name: label for one in self.rebuilt for name, label in one.labels.items()}

    @property
    def reasons(self) -> tuple[Reason, ...]:
        """All that was guessed, with the probability that it is wrong, the least sure first."""
        words = [(f"{name} is called {one.name} by the rebuild", one, name) for name, one in self.new_labels.items()]
        words += [(f"{name} is called {one.name} by its likeness", one, name) for name, one in self.guesses.items()]
        labels = [Reason("label", text, (name,), share=1 - one.confidence) for text, one, name in words]
        return tuple(sorted([*self.span_reasons, *labels], key=lambda one: -one.share))

    @property
    def span_reasons(self) -> tuple[Reason, ...]:
        """Those about which hulls span parts: whether none of a body that was rebuilt does, or one that was left."""
        rebuilt = (Reason("label", str(one), tuple(one.labels), share=1 - one.chance) for one in self.rebuilt)
        left = (Reason("label", f"{one}: left as it is", (one.hull,), share=one.chance) for one in self.spanning)
        return (*rebuilt, *left)

    @property
    def probability(self) -> float:
        """That all of it is right, at most: that of the least sure guess, 1 where nothing was guessed."""
        return 1 - max((one.share for one in self.reasons), default=0.0)

    def describe(self) -> tuple[str, ...]:
        """Return a sentence on each body that was rebuilt, each hull that was left, and on the labels."""
        rows = [*map(str, self.rebuilt), *(f"{span}: left as it is" for span in self.spanning)]
        counts = Counter(_BY.get(one.source, "from a file") for one in self.taken.values())
        rows += [f"{pluralize(count, 'label')} {by}" for by, count in counts.items()]
        if self.guesses:
            name, least = min(self.guesses.items(), key=lambda row: row[1].confidence)
            rows.append(
                f"{pluralize(len(self.guesses), 'label')} by likeness to the family; "
                f"least sure: {name} is {least.name}, {min(least.confidence, MOST_SHOWN):.0%}"
            )
        return (*rows, *self.notes)

    def to_json(self) -> dict[str, Any]:
        """Return what the line of `apply --json` says of it."""
        return {
            "rebuilt": [
                {
                    "body": one.body,
                    "spanning": list(map(_span_to_json, one.spans)),
                    "into": [
                        {"hull": name, "label": label.name, "confidence": label.confidence}
                        for name, label in one.labels.items()
                    ],
                }
                for one in self.rebuilt
            ],
            "spanning": list(map(_span_to_json, self.spanning)),
            "labelled": {
                name: {"label": one.name, "confidence": one.confidence, "source": one.source}
                for name, one in self.taken.items()
            },
            "guessed": {name: {"label": one.name, "confidence": one.confidence} for name, one in self.guesses.items()},
            "sure_at_most": round(self.probability, _DIGITS),
        }


def _span_to_json(span: HullSpan) -> dict[str, Any]:
    return {"hull": span.hull, "chance": round(span.chance, _DIGITS), "holds": list(span.shares)}


def describe_new(results: Sequence[NewAssetResult]) -> str | None:
    """Return how many bodies of new assets were rebuilt, and how many that likely span parts were left, if any."""
    bodies, left = sum(len(one.rebuilt) for one in results), sum(len(one.spanning) for one in results)
    rebuilt = [one.asset for one in results if one.rebuilt]
    noun = "body" if bodies == 1 else "bodies"
    parts = [f"{bodies} {noun} of new assets rebuilt ({join_names(rebuilt)})"] if bodies else []
    parts += [f"{pluralize(left, 'hull')} likely {'spans' if left == 1 else 'span'} parts, left as is"] if left else []
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
) -> dict[str, ResultStatus]:
    """Return how probable the edits of assets are that were prepared beside a project, each by itself, by id.

    results: what was guessed of them: an edit is at most as sure as that a body which was rebuilt has a hull that
    spans parts, and that a hull which was left does not. What their labels mean for the edit, the review of the project
    says.
    """
    task = _Task(_choose_state(review.state), review.outcome, store.settings.thresholds.contact)
    new = [job for job in jobs if job.id in results]
    found = dict[str, ResultStatus]()
    for job, one in zip(new, batch.execute(partial(_assess, task), new, execution), strict=True):
        if isinstance(one, batch.WorkerFailure):
            one = _describe_failure(one.why)
        found[job.id] = one.with_reasons(results[job.id].span_reasons)
    return found


def _choose_state(state: ReviewState) -> ReviewState:
    """The state of few assets: all that were demonstrated or corrected, of labelled and accepted ones some, evenly."""
    files = {asset: LabelFile(labels=mesh.labels) for asset, mesh in state.meshes.items()}
    accepted = pick_evenly(sorted(state.accepted), MOST_COMPARED)
    some = {*state.demos, *state.corrected, *accepted, *choose_labelled(files)}
    meshes = {asset: mesh for asset, mesh in state.meshes.items() if asset in some}
    return replace(state, meshes=meshes, accepted=frozenset(accepted))


def _assess(task: _Task, job: batch.AssetJob) -> ResultStatus:
    try:
        mesh = batch.read_job(job)
        mesh = mesh if task.contact is None else replace(mesh, epsilon=task.contact)
        state = replace(task.state, meshes={**task.state.meshes, _NEW: mesh})
        return assess_asset(state, task.outcome, model_family(list(state.meshes.values())), _NEW)
    except Exception as error:  # one asset never stops the others
        return _describe_failure(describe_error(error, str(job.path)))


def _describe_failure(why: str) -> ResultStatus:
    return ResultStatus(0.0, (Reason("alarm", f"it could not be looked at: {why}", share=1.0),))
