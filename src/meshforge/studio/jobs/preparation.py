"""Jobs before the program runs: decomposing, rebuilding, and labelling."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import groupby
from typing import Literal
from uuid import uuid4

from meshforge.batch import ExecutionOptions, record_digest
from meshforge.common import format_share, pluralize, relative_name
from meshforge.geometry import CoacdSettings, VhacdSettings
from meshforge.labels import (
    LabelOutcome,
    LabelResult,
    Tally,
)
from meshforge.project import (
    REBUILD_DEFAULTS,
    SOURCE_WORDS,
    DecompositionPlan,
    PreparationResult,
    Project,
    RebuildSettings,
    keep_rebuilt,
    read_piece_engine,
    read_preparation_plan,
)
from meshforge.store import ConflictError, Layout
from meshforge.studio.session.job_runner import JobProgress
from meshforge.studio.session.session import Session
from meshforge.studio.wire.jobs import DecomposeJob, Job, JobLine, RebuildJob
from meshforge.symbolic import GIVEN_SOURCES


def start_decompose(session: Session, request: DecomposeJob) -> Job:
    """Start to decompose whatever some assets have no hulls for; each asset is one edit, all are undone at once."""
    project = session.project
    session.check_assets(*request.assets)
    assets, group = tuple(dict.fromkeys(request.assets)), uuid4().hex
    plan = choose_decomposition(project, request)

    def work(progress: JobProgress) -> str:
        made = 0
        results = project.decompose(
            assets,
            plan.settings,
            hollow=plan.hollow,
            by=plan.by,
            execution=ExecutionOptions(stop=progress.is_stopped, progress=progress.advance),
            write_block=lambda asset: session.record_preparation(f"{asset} decomposed", asset, group),
        )
        for result in results:
            made += len(result.hulls)
            progress.add_line(_decompose_line(result))
        return f"{pluralize(made, 'hull')} made for {pluralize(len(assets), 'asset')}."

    return session.jobs.start("decompose", f"Decomposing {pluralize(len(assets), 'asset')}", len(assets), work)


def choose_decomposition(project: Project, request: DecomposeJob) -> DecompositionPlan:
    """Return how assets are decomposed: where nothing is asked for, as the project's other ones, so that it stays clear
    how new ones are."""
    plan = read_preparation_plan(project).decompose if request.method is None else ()
    if len(plan) == 1 and not plan[0].only:
        return plan[0]
    return DecompositionPlan(VhacdSettings() if request.method == "vhacd" else CoacdSettings(), by=request.by)


def _decompose_line(result: PreparationResult) -> JobLine:
    text = "; ".join((*result.problems, *result.notes))
    if result.made:
        return JobLine(asset=result.asset, status="done", text=text or pluralize(len(result.hulls), "hull"))
    return JobLine(asset=result.asset, status="failed" if result.problems else "unchanged", text=text)


def start_rebuild(session: Session, request: RebuildJob) -> Job:
    """Start to rebuild bodies of which hulls span parts, or only to find these; each asset is one edit, all are undone
    at once."""
    project, group, bodies = session.project, uuid4().hex, request.bodies
    session.check_assets(*(bodies or ()))

    def work(progress: JobProgress) -> str:
        if bodies is None and _are_labels_given(project.tally_labels()):
            return "None: all hulls have labels from you or from files."
        how = RebuildSettings(pieces=read_piece_engine(project))
        results = project.rebuild_spanning(
            how=how,
            bodies=bodies,
            dry_run=bodies is None,
            execution=ExecutionOptions(stop=progress.is_stopped),
            stage=progress.stage,
            write_block=lambda asset: session.record_preparation(f"bodies of {asset} rebuilt", asset, group),
        )
        found = list[PreparationResult]()
        for result in results:
            found.append(result)
            for line in _rebuild_lines(result, bodies is not None):
                progress.add_line(line)
        if request.every and all(result.made for result in found):
            keep_rebuilt(project, project.assets(), how)
        session.update([relative_name(project.layout.preparation_plan, project.folder)])
        return _describe_rebuild(found)

    title = "Looking for hulls that span parts" if bodies is None else "Rebuilding bodies"
    count = len(project.assets() if bodies is None else bodies)
    return session.jobs.start("rebuild", title, count, work, stays="what is rebuilt stays.")


def _are_labels_given(tally: Tally) -> bool:
    """Whether people and files labelled every hull, so that each is of one part."""
    return not (tally.unlabelled or tally.unreadable) and all(one.source in GIVEN_SOURCES for one in tally.shares)


def _rebuild_lines(result: PreparationResult, was_asked: bool) -> Iterator[JobLine]:
    """What was found of one asset, a line a body, and what of it could not be looked at; was_asked: whether bodies of
    it were to be rebuilt."""
    asset, texts = result.asset, [*result.problems, *result.notes]
    if not was_asked:
        for body, spans in groupby(sorted(result.found, key=lambda one: one.body), key=lambda one: one.body):
            own = tuple(spans)
            hulls = tuple(span.hull for span in own)
            yield JobLine(asset=asset, status="skipped", text="; ".join(map(str, own)), body=body, hulls=hulls)
    elif not result.problems:
        texts = ["; ".join(map(str, result.found)) or "no hull spans parts any more: left as it is", *texts]
    if texts:
        status: Literal["failed", "done", "skipped"]
        status = "failed" if result.problems else "done" if result.made else "skipped"
        yield JobLine(asset=asset, status=status, text="; ".join(texts))


def _describe_rebuild(results: Sequence[PreparationResult]) -> str:
    made, found = ([one for one in results if getattr(one, what)] for what in ("made", "found"))
    lost = sum(bool(result.problems) for result in results)
    left = f" {pluralize(lost, 'asset')} could not be looked at." if lost else ""
    if made:
        hulls = pluralize(sum(len(result.hulls) for result in made), "hull")
        return f"Bodies of {pluralize(len(made), 'asset')} rebuilt: {hulls}.{left}"
    if found:
        hulls = pluralize(sum(len(result.found) for result in found), "hull")
        return f"{hulls} of {pluralize(len(found), 'asset')} may span parts. Nothing is changed.{left}"
    return f"None: no hull spans parts with {format_share(REBUILD_DEFAULTS.min_confidence)} or more.{left}"


def start_label(session: Session) -> Job:
    """Start to label all hulls from files, names, and the labels that there are, weighed together."""
    project = session.project
    began, used = _preparation_digests(project), session.count_edits()
    files = [file.path(project.folder) for file in (Layout.settings, Layout.labels, Layout.label_sources)]

    @contextmanager
    def record(best: str | None) -> Iterator[None]:
        edit = {"kind": "label-all", "used": used, "next": best}
        with session.record("hulls labelled", edit, files, uuid4().hex):
            if _preparation_digests(session.project) != began:
                raise ConflictError("assets or their hulls were changed meanwhile", remedy="Label again.")
            yield

    def work(progress: JobProgress) -> str:
        options = ExecutionOptions(stop=progress.is_stopped)
        result = project.label(execution=options, stage=progress.stage, write_block=record)
        for outcome in result.outcomes:
            progress.add_line(_labels_line(outcome, [f"{outcome.unsure} unsure"] if outcome.unsure else []))
        if not any(outcome.taken for outcome in result.outcomes):
            session.label_changes.note_no_change(used, result.next)
            session.refresh_queue.add()
        return " ".join(_describe_labels(result, project.tally_labels()))

    return session.jobs.start("label", "Labelling", len(project.assets()), work, stays="no label was changed.")


def _preparation_digests(project: Project) -> dict[str, str | None]:
    """The digest of each asset's preparation, which decides which hulls it has, besides its files."""
    return {asset: record_digest(project.layout.preparation(asset)) for asset in project.assets()}


def _describe_labels(result: LabelResult, tally: Tally) -> Iterator[str]:
    """What was done, from which sources all labels are now, and what these disagree about, a sentence each."""
    taken, unsure = (sum(getattr(one, name) for one in result.outcomes) for name in ("taken", "unsure"))
    assets = pluralize(sum(outcome.taken > 0 for outcome in result.outcomes), "asset")
    new = f"{pluralize(taken, 'label')} on {assets}" if taken else "Every label stays as it is"
    yield f"{new}; {unsure or 'none'} unsure."
    shares = [f"{SOURCE_WORDS[one.source]} {one.sure + one.likely + one.unsure:,}" for one in tally.shares]
    yield f"All labels by source: {', '.join(shares)}."
    if found := tally.describe_contradictions():
        yield f"{found}."
    for one, other in result.alike:
        yield f"{one} and {other} are on hulls that look alike: are they one part?"
    yield from (f"{note}." for note in result.notes)


def _labels_line(report: LabelOutcome, notes: list[str]) -> JobLine:
    """What became of the labels of one asset; notes: what to say besides how many were taken."""
    if report.problems:
        return JobLine(asset=report.asset, status="failed", text="; ".join(report.problems))
    text = ", ".join([pluralize(report.taken, "label"), *notes])
    return JobLine(asset=report.asset, status="done" if report.taken else "unchanged", text=text)
