"""Sign-offs of a project's results: made when a result is sure enough, or a person looked at it, and its output is up
to date; void when anything changes of what they rest on.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from types import MappingProxyType
from typing import Any, Literal, Self

from meshforge import batch, language, signoff
from meshforge.batch import EXECUTION_DEFAULTS
from meshforge.project import run
from meshforge.project.goals import read_goal_statuses
from meshforge.project.hull_mapping import describe_replaced
from meshforge.project.learn import digest_demonstrations, digest_learning_inputs, digest_settings
from meshforge.store import (
    ANSWERS,
    AssessmentFile,
    AssetOutput,
    ConfidenceLine,
    SignOff,
    SignOffBasis,
    Store,
    find_changes,
    find_outputs,
    iterate_asset_index,
)

_NO_MARKS: Mapping[str, Any] = {"assets": {}}
"""Of hulls as one part, which earlier versions kept: with it in digests, sign-offs of theirs stay."""
Clock = Callable[[], datetime]


def now_utc() -> datetime:
    """Return the present time."""
    return datetime.now(UTC)


def find_inputs(store: Store, execution: batch.ExecutionOptions = EXECUTION_DEFAULTS) -> dict[str, batch.OutputInputs]:
    """Return the digests of all that decides the edit of each asset that can be read; none without a program."""
    program = store.program()
    return _digest_edits(store, run.build_task(store, program), execution) if program else {}


def _digest_edits(
    store: Store, task: batch.ApplyTask, execution: batch.ExecutionOptions
) -> dict[str, batch.OutputInputs]:
    facts = dict(iterate_asset_index(store.found, store.layout, execution=execution))
    return {
        job.id: batch.inputs_of(task, job, facts[job.id].digests)
        for job in run.build_jobs(store)
        if not facts[job.id].error
    }


def digest_inputs(store: Store) -> str:
    """Return the digest of all that probabilities rest on beside the assets: what is learned from, what a person said,
    and whether they saw what preparations changed of it."""
    unconfirmed = [text for asset in store.demonstration_ids() for text in describe_replaced(store, asset)]
    return batch.value_digest([digest_learning_inputs(store), digest_feedback(store), unconfirmed])


def digest_feedback(store: Store) -> str:
    """Return the digest of what people said: answers and fixes, verdicts without notes, and exclusions."""
    feedback = store.feedback()
    lines = [*feedback.answers_and_fixes.values(), *(one for some in feedback.verdicts.values() for one in some)]
    answers = [one.model_dump(mode="json", exclude={"note", "by", "question"}) for one in lines]
    away = {asset: one.reason for asset, one in feedback.exclusions.items()}
    return batch.value_digest([answers, away, _NO_MARKS])


def find_bases(
    store: Store, edits: Mapping[str, batch.OutputInputs], outputs: Mapping[str, AssetOutput]
) -> dict[str, SignOffBasis]:
    """Return what a sign-off of each asset would rest on now. edits: the digests of all that decides its edit."""
    settings, answers = (
        digest_settings(store.settings),
        batch.value_digest([digest_demonstrations(store), digest_feedback(store)]),
    )
    return {asset: SignOffBasis.of(edit, settings, answers, outputs[asset].digest) for asset, edit in edits.items()}


@dataclass(frozen=True)
class AssessmentBasis:
    """What an assessment is computed from, as digests, taken before any of it is read. inputs_digest: of what is
    learned from and what a person said; inputs: of the edit of each asset that can be read.
    """

    inputs_digest: str
    inputs: Mapping[str, batch.OutputInputs]

    @classmethod
    def take(cls, store: Store, execution: batch.ExecutionOptions = EXECUTION_DEFAULTS) -> Self:
        """Return the digests as they are, of edits by an empty program: which it will be is often learned since."""
        return cls(digest_inputs(store), _digest_edits(store, run.build_task(store, language.Program()), execution))

    def under(self, store: Store, program: language.Program | None) -> Self:
        """Return the same of edits by a program; without one there are none."""
        if program is None:
            return replace(self, inputs={})
        digest, templates = batch.program_digest(program), batch.template_digests(store.templates(program.templates))
        edits = {
            asset: now.model_copy(update={"program": digest, "templates": {**now.templates, **templates}})
            for asset, now in self.inputs.items()
        }
        return replace(self, inputs=edits)


def keep_assessment(
    store: Store,
    found: signoff.Assessment,
    basis: AssessmentBasis,
    measures: Mapping[str, signoff.EditMeasures],
    execution: batch.ExecutionOptions = EXECUTION_DEFAULTS,
) -> bool:
    """Keep how sure each result is, so that a status need not learn anything; nothing where something changed since
    the basis was taken. Says whether it was kept.

    measures: of edits, by asset, so that the next review need not make them again.
    """
    if basis != AssessmentBasis(digest_inputs(store), find_inputs(store, execution)):
        return False
    lines = {
        name: ConfidenceLine(
            probability=one.confidence,
            reasons=one.reasons,
            rests_on=basis.inputs[name],
            looked_at=name in found.looked_at,
            measures=measures.get(name),
        )
        for name, one in found.without_goals.items()
        if name in basis.inputs
    }
    wrong = tuple(sorted(found.wrong))
    store.write_assessment(
        AssessmentFile(threshold=found.threshold, inputs_digest=basis.inputs_digest, wrong=wrong, assets=lines)
    )
    return True


_NO_ALARMS: Mapping[str, Sequence[str]] = MappingProxyType({})


def renew_sign_offs(
    store: Store,
    alarms: Mapping[str, Sequence[str]] = _NO_ALARMS,
    *,
    keep_persons: bool = False,
    clock: Clock = now_utc,
    execution: batch.ExecutionOptions = EXECUTION_DEFAULTS,
) -> dict[str, str]:
    """Sign off what may be by the last review, as far as that holds; take back what may not, and say why, by asset.

    Where nothing changed of what a sign-off rests on, it stays whatever was found since. alarms: sentences on outputs
    that stand out of those just written, by asset: the tool signs off none that has more of them than the review knew,
    none on which a goal was not tried, and takes back those on which one fails.
    keep_persons: those of a person stay where something but what was said changed; they are void then, and named so.
    """
    last, edits = store.assessment(), find_inputs(store, execution)
    if last is None or not last.holds(digest_inputs(store), edits):
        return {}
    when = clock().astimezone(UTC).isoformat(timespec="seconds")
    outputs, goals = find_outputs(store.layout, edits), read_goal_statuses(store, store.program(), edits)
    bases = find_bases(store, edits, outputs)
    with store.lock():
        if alarms:
            last = last.with_alarms(alarms)
            store.write_assessment(last)
        before, away = store.sign_offs(), {*last.wrong, *store.exclusions()}
        kept, lost = dict[str, SignOff](), dict[str, str]()
        for name in [*last.assets, *(before.keys() & store.found.ids.keys() - last.assets.keys())]:
            old, now, line = before.get(name), bases.get(name), last.assets.get(name)
            if line is None or now is None:  # it cannot be read now, so that its sign-off is void
                kept |= {name: old} if old else {}
                continue
            changes, is_away, own = now.changes(old.rests_on) if old else (), name in away, goals.get(name, ())
            line, failing = line.with_goals(own), [goal.describe() for goal in own if goal.fails]
            good, is_tried = line.passes(last.threshold) and not is_away, all(not goal.is_open for goal in own)
            stays = old and not changes and old.meets(last.threshold) and not is_away
            if old and stays and (old.by == "person" or not failing):
                kept[name] = old
            elif (
                good
                and (line.looked_at or is_tried)
                and outputs[name].is_whole
                and is_written(outputs[name].stamp, edits[name])
            ):
                by: Literal["person", "tool"] = "person" if line.looked_at else "tool"
                kept[name] = SignOff(asset=name, by=by, when=when, probability=line.probability, rests_on=now)
            elif old and (good or (keep_persons and old.by == "person" and {*changes} - {ANSWERS})):
                kept[name] = old  # where something changed void, and named so, until its output is there again
            elif old:
                lost[name] = "; ".join(failing) or _describe_loss(old, line, changes, is_away)
        store.write_sign_offs(kept)
    return lost


def _describe_loss(old: SignOff, line: ConfidenceLine, changes: tuple[str, ...], away: bool) -> str:
    if away:
        return "a person called it wrong, or excluded it"
    if line.is_outlier:
        return f"its output stands out: {line.reasons[0].text}"
    why = f", {' and '.join(changes)} changed" if changes else ", and more is asked for now"
    return f"it was {old.probability:.1%} sure, and is {line.probability:.1%} sure{why}"


def is_written(stamp: batch.Stamp | None, now: batch.OutputInputs) -> bool:
    """Return whether an output is what the edit would make."""
    made = stamp.inputs if stamp and stamp.status in ("edited", "unchanged") else None
    return made is not None and not find_changes(now, made)
