"""The status of a project, put together from its files and from the stamps of its outputs."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from meshforge import batch, labels, language, symbolic
from meshforge.common import MeshForgeError, format_share, quote_path, relative_name
from meshforge.project.demonstrations import find_unknown_hulls, is_wrong_as_shown
from meshforge.project.family_step import choose_next_step
from meshforge.project.goals import read_goal_statuses
from meshforge.project.hull_mapping import describe_replaced
from meshforge.project.learn import ProgramState, program_state_of, suggest_first_demonstration
from meshforge.project.run import build_jobs, build_task, make_empty_program, output_digest
from meshforge.project.sign_offs import digest_inputs, find_bases
from meshforge.project.status import AssetStatus, FamilyState, OpenQuestion, Status
from meshforge.signoff import THRESHOLD, ExclusionReason, GoalStatus, ResultState, ResultStatus
from meshforge.store import (
    AssessmentFile,
    AssetFacts,
    AssetOutput,
    ConfidenceLine,
    Feedback,
    History,
    SignOff,
    SignOffBasis,
    Store,
    VerdictEvent,
    find_outputs,
    geometry_digest,
    iterate_asset_index,
)


def compute_status(
    store: Store,
    only: Collection[str] | None = None,
    *,
    others: Iterable[AssetStatus] = (),
    workers: int | None = None,
    progress: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
    verify: bool = False,
) -> Status:
    """Return how far everything is, what is stale, and the next sensible step.

    only: ids; then the status holds these assets alone, and its next step counts besides them `others`, which are
    known already. workers, progress, stop: as of `meshforge.batch.run_isolated`, for assets that have to be read;
    verify: hash every file of assets and outputs, also those that do not seem to have changed.
    Raises ProjectError for an asset that is not there, and for a file of the project that cannot be read.
    """
    for asset in only or ():
        store.path(asset)
    settings, ids, feedback = store.settings, store.found.ids, store.feedback()
    only = None if only is None else [asset for asset in only if asset in ids]
    work = build_jobs(store, only)
    execution = batch.ExecutionOptions(workers=workers, stop=stop)
    facts = dict(
        iterate_asset_index(store.found, store.layout, only, execution=execution, progress=progress, verify=verify)
    )
    outputs = find_outputs(store.layout, facts, verify=verify)
    program, task, problem = _read_program(store)
    bare = None if program or problem else make_empty_program(store)
    writing = build_task(store, bare) if bare else task
    edits, rows = dict[str, batch.OutputInputs](), list[AssetStatus]()
    for job in work:
        one, edit = facts[job.id], batch.inputs_of(writing, job, facts[job.id].digests) if writing else None
        edits |= {job.id: edit} if edit and task and not one.error else {}
        made = outputs[job.id].stamp
        if edit and bare and made and made.inputs and made.inputs.program != edit.program:
            edit = None  # the output is of a program that is gone, and is not out of date without it
        rows.append(_asset_status(store, job, one, outputs[job.id], edit, feedback.verdict_on(job.id)))
    last, lacks = store.assessment(), "asset" if task else "templates" if program else "program"
    current = last if last and last.holds(digest_inputs(store), edits) else None
    result_statuses = ResultStatuses(
        find_bases(store, edits, outputs),
        lacks,
        feedback,
        store.exclusions(),
        store.sign_offs(),
        current,
        read_goal_statuses(store, program, edits),
    )
    assets = tuple(map(result_statuses.add_to, rows))
    state = program_state_of(store, program)
    rules = len(program.rules) if program else None
    known = {asset.id: asset for asset in (*others, *assets)}
    every = [known[asset] for asset in ids if asset in known]
    family = FamilyState(
        store.folder,
        every,
        settings.vocabulary,
        has_program=program is not None,
        asks_labels=bool(program and program.labels_asked),
        outdated=state.outdated,
        problem=problem,
        question=_find_question(state, every),
        suggest_first=partial(suggest_first_demonstration, store),
        find_offers=partial(find_offers, store),
    )
    return Status(
        settings.name,
        assets,
        settings.vocabulary,
        rules,
        state.outdated,
        problem,
        _find_lost_ids(store),
        tuple(sorted(store.every.ids.keys() - ids.keys())),
        choose_next_step(family),
        family,
        state.question,
        last.threshold if last else THRESHOLD,
    )


def _find_question(state: ProgramState, assets: Sequence[AssetStatus]) -> OpenQuestion | None:
    if not state.question or all(asset.is_done or asset.result_status.excluded for asset in assets):
        return None
    rule, _, asset = state.question.partition(":")
    return OpenQuestion("other", asset, f" about rule {rule} on {asset}, or apply the program as it is")


def find_offers(
    store: Store, cache: labels.OfferCache | None = None, only: Collection[str] | None = None
) -> labels.LabelOffers:
    """Return labels in files and names; none where the settings make no sense, which taking the labels reports."""
    try:
        return (cache or labels.OfferCache()).of(store, only)
    except MeshForgeError:
        return labels.LabelOffers()


def _read_program(store: Store) -> tuple[language.Program | None, batch.ApplyTask | None, str | None]:
    program = None
    try:
        program = store.program()
        return program, build_task(store, program) if program else None, None
    except MeshForgeError as error:
        return program, None, error.message


def _asset_status(
    store: Store,
    job: batch.AssetJob,
    facts: AssetFacts,
    output: AssetOutput,
    edit: batch.OutputInputs | None,
    review: VerdictEvent | None,
) -> AssetStatus:
    stamp = output.stamp
    failed = stamp.error if stamp and stamp.status == "failed" else None
    try:
        file, unreadable = store.labels_and_classes(job.id), None
    except MeshForgeError as error:
        file, unreadable = symbolic.LabelFile(), error.message
    homes = symbolic.match_labels(symbolic.LabelFile() if facts.error else file, facts.hulls)
    is_shown = store.layout.demonstration(job.id).exists()
    is_current = bool(review and (review.output == output_digest(stamp) or review.verdict == "wrong"))
    if is_current and review and is_shown and review.verdict == "wrong" and not review.meant:
        is_current = is_wrong_as_shown(store.steps(job.id), review)
    current_review = review if is_current else None
    return AssetStatus(
        id=job.id,
        hulls=None if facts.error else len(facts.hulls),
        labelled=len(homes.labels),
        doubtful=tuple(sorted((*homes.changed, *homes.gone), key=list(file.labels).index)),
        demonstrated=is_shown,
        output=stamp.status if stamp else "none",
        stale=_find_changes(output, edit),
        error=facts.error or unreadable or failed,
        flags=tuple(dict.fromkeys([*_find_flags(store, job.id, facts), *(stamp.flags if stamp else ())])),
        review=current_review.verdict if current_review else None,
        prepared=facts.prepared,
        sources=facts.sources,
        names=tuple(facts.hulls),
        labels=tuple(map(homes.labels.get, facts.hulls)),
        geometry="" if facts.error else geometry_digest(facts.hulls),
        after=stamp.after if stamp and output_digest(stamp) else None,
        after_labels=stamp.labels if stamp and output_digest(stamp) else (),
        output_digest=output_digest(stamp),
        manual_edits=len(job.manual_edits),
        review_note=current_review.note if current_review else None,
    )


def _find_flags(store: Store, asset: str, facts: AssetFacts) -> Iterator[str]:
    """What a person has to look at: demonstrated hulls that are gone, parts that stand for split hulls, and a
    preparation that was cut short."""
    if facts.error:
        return
    try:
        for rule, name in find_unknown_hulls(store.steps(asset), facts.hulls):
            parts = facts.replaced.get(name)
            fate = f"was split into {', '.join(parts)}" if parts else "is gone"
            yield f"{name}, which is demonstrated for rule {rule}, {fate}: demonstrate it anew"
        yield from describe_replaced(store, asset)
    except MeshForgeError as error:
        yield error.message
    own = relative_name(store.layout.preparation(asset), store.folder)
    if any(name == own or name.startswith(f"{own}/") for name in History(store.folder).interrupted):
        command = f"meshforge prepare {quote_path(store.folder)} {asset} --undo"
        yield f"its preparation was cut short, and selections may name hulls that are not there. Finish with: {command}"


def _find_changes(output: AssetOutput, edit: batch.OutputInputs | None) -> tuple[str, ...]:
    """What changed since the output was made, and of it. edit: all that decides what it would be now."""
    stamp = output.stamp
    if not stamp:
        return ()
    own = () if output.is_whole or stamp.status == "failed" else ("output",)
    if not stamp.inputs or not edit:
        return own
    return (*edit.model_copy(update={"settings": stamp.inputs.settings}).changes(stamp.inputs), *own)


def _find_lost_ids(store: Store) -> tuple[str, ...]:
    layout = store.layout
    kinds = (layout.labels, layout.demonstration, layout.manual_edits, layout.preparation)
    kept = {asset for kind in kinds for asset in kind.ids}
    return tuple(sorted(kept - store.every.ids.keys()))


@dataclass(frozen=True, eq=False, slots=True)
class ResultStatuses:
    """What is kept of a review. bases: what sign-offs would rest on now, of assets that can be edited; lacks: what is
    not there of the others; feedback: of people; exclusions: why assets are excluded; signed: what is signed off;
    last: what the last review found, None where something changed since; goals: what is known of them, by asset.
    """

    bases: Mapping[str, SignOffBasis]
    lacks: str
    feedback: Feedback
    exclusions: Mapping[str, ExclusionReason]
    signed: Mapping[str, SignOff]
    last: AssessmentFile | None
    goals: Mapping[str, tuple[GoalStatus, ...]]

    def add_to(self, asset: AssetStatus) -> AssetStatus:
        """Return an asset with how its result stands."""
        line = self.last.assets.get(asset.id) if self.last else None
        sign_off, goals = self.signed.get(asset.id), self.goals.get(asset.id, ())
        void = self._find_void(asset, sign_off)
        by = sign_off.by if sign_off and not _is_accepted(asset) else "person"
        state = self._find_state(asset, line and line.with_goals(goals), bool(sign_off), bool(void))
        if state == "signed off" and by == "tool" and any(goal.fails for goal in goals):
            state = "needs review"
        result_status = ResultStatus(
            probability=line.probability if line else None,
            reasons=line.reasons if line else (),
            state=state,
            by=by if state == "signed off" else None,
            void=void if state == "void" else (),
            excluded=self.exclusions.get(asset.id),
            found_since=self._find_news(line) if state == "signed off" else (),
        )
        return replace(asset, result_status=result_status.with_goals(goals))

    def _find_void(self, asset: AssetStatus, sign_off: SignOff | None) -> tuple[str, ...]:
        """What changed of all that a sign-off rests on, or, where there is none, since a person accepted the result."""
        if _is_accepted(asset) or (not sign_off and asset.review == "accepted"):
            return _list_changes(asset)
        now = self.bases.get(asset.id)
        return () if not sign_off else now.changes(sign_off.rests_on) if now else (self.lacks,)

    def _find_state(
        self, asset: AssetStatus, line: ConfidenceLine | None, is_signed: bool, is_void: bool
    ) -> ResultState:
        if asset.id in self.exclusions:
            return "excluded"
        verdict = self.feedback.verdict_on(asset.id)
        is_wrong = asset.review == "wrong" and not (verdict and verdict.meant)
        if asset.id in self.last.wrong if self.last else is_wrong:
            return "needs review"
        if is_signed or asset.review == "accepted":
            return "void" if is_void else "signed off"
        if not line or not self.last:
            return "unknown"
        return "sure" if line.passes(self.last.threshold) else "needs review"

    def _find_news(self, line: ConfidenceLine | None) -> tuple[str, ...]:
        """What was found after an asset was signed off, and no person has answered."""
        if not line or not self.last or line.passes(self.last.threshold):
            return ()
        sure = f"it is {format_share(line.probability)} sure now"
        weighty = (one.text for one in line.reasons if one.kind == "alarm" or one.share > 1 - self.last.threshold)
        return tuple(weighty) or (line.reasons[0].text if line.reasons else sure,)


def _is_accepted(asset: AssetStatus) -> bool:
    return asset.review == "accepted" and not _list_changes(asset)


def _list_changes(asset: AssetStatus) -> tuple[str, ...]:
    """What changed since the output was made, but for the version of this software."""
    return tuple(one for one in asset.stale if one != "software")
