"""Jobs before the program runs: decomposing, rebuilding, and labelling."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import groupby
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from uuid import uuid4

from meshforge.batch import ExecutionOptions, apply_preparation, count_processors, record_digest
from meshforge.common import GeometryError, format_share, pluralize, relative_name
from meshforge.formats import read
from meshforge.geometry import CoacdSettings, VhacdSettings
from meshforge.labels import LabelOutcome, LabelResult, Tally
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
from meshforge.project.prepare import count_copies, count_pieces, try_decomposition
from meshforge.store import ConflictError, Layout
from meshforge.studio.queries.packets import pack_edited
from meshforge.studio.session.job_runner import JobProgress
from meshforge.studio.session.session import Session
from meshforge.studio.wire.jobs import DecomposeJob, DecomposeOptions, Job, JobLine, JobStatus, PreviewJob, RebuildJob
from meshforge.symbolic import GIVEN_SOURCES, SymbolicMesh


def start_decompose(session: Session, request: DecomposeJob) -> Job:
    """Start to decompose whatever some assets have no hulls for; each asset is one edit, all are undone at once."""
    project = session.project
    session.check_assets(*request.assets)
    assets, group = tuple(dict.fromkeys(request.assets)), uuid4().hex
    plan = choose_decomposition(project, request)

    def work(progress: JobProgress) -> str:
        done = list[PreparationResult]()
        with _count_pieces(progress) as (pieces, execution):
            results = project.decompose(
                assets,
                plan.settings,
                hollow=plan.hollow,
                by=plan.by,
                execution=execution,
                write_block=lambda asset: session.record_preparation(f"{asset} decomposed", asset, group),
                pieces=pieces,
            )
            for result in results:
                done.append(result)
                progress.add_line(_decompose_line(result))
        made = pluralize(sum(len(result.hulls) for result in done), "hull")
        copies = count_copies(entry for result in done for entry in result.made)
        alike = f" {pluralize(copies, 'equal copy', 'equal copies')} got the hulls of the first." if copies else ""
        return f"{made} made for {pluralize(len(assets), 'asset')}.{alike}"

    title = f"Decomposing {pluralize(len(assets), 'asset')}"
    return session.jobs.start("decompose", title, _count_sources(session, assets), work)


def start_preview(session: Session, request: PreviewJob) -> Job:
    """Start to make the hulls of one asset, for pages to fetch; none are kept."""
    project, asset = session.project, request.asset
    session.check_assets(asset, *request.assets)
    plan = choose_decomposition(project, request)

    def work(progress: JobProgress) -> str:
        with _count_pieces(progress) as (pieces, execution):
            found, seconds = try_decomposition(project, asset, plan, execution, pieces)
        if not found.made:
            raise GeometryError("; ".join(one.why for one in found.failed) or "nothing to decompose", where=asset)
        after = SymbolicMesh.of(apply_preparation(read(project.path(asset)), found.preparation))
        before = session.mesh(asset)
        session.preview = asset, pack_edited(before, before, after)
        hulls = pluralize(sum(len(entry.made) for entry in found.made), "hull")
        text = f"{pluralize(len(found.made), 'piece')}: {hulls}, {seconds:.0f} s"
        others = _count_sources(session, request.assets)
        rate = seconds / len(found.made) / min(count_processors(), len(request.assets) or 1)
        text += f"; {pluralize(len(request.assets), 'asset')}: about {max(rate * others, 1):.0f} s."
        return text + "".join(f" {lost.what}: {lost.why}." for lost in found.failed)

    total = _count_sources(session, [asset])
    return session.jobs.start("preview", f"Trying {asset}", total, work, stays="no hull was kept.")


def _count_sources(session: Session, assets: Iterable[str]) -> int:
    """How many pieces some assets have that are to be decomposed, as far as that is known."""
    known = {card.asset: card.sources for card in session.pages.cards}
    return sum(known.get(asset) or 1 for asset in assets)


@contextmanager
def _count_pieces(progress: JobProgress) -> Iterator[tuple[Path, ExecutionOptions]]:
    """A folder for how far each asset is, and options by which a job stops and says that."""
    with TemporaryDirectory(ignore_cleanup_errors=True) as name:

        def is_stopped() -> bool:
            progress.advance(count_pieces(Path(name))[0])
            return progress.is_stopped()

        yield Path(name), ExecutionOptions(stop=is_stopped)
        is_stopped()


def choose_decomposition(project: Project, request: DecomposeOptions) -> DecompositionPlan:
    """Return how assets are decomposed: if nothing is asked for, as the others, so that how new ones are is clear."""
    plan = read_preparation_plan(project).decompose if request.method is None else ()
    if len(plan) == 1 and not plan[0].only:
        return plan[0]
    is_vhacd = request.method == "vhacd"
    given: dict[str, Any] = {"max_convex_hulls" if is_vhacd else "max_convex_hull": request.most}
    given |= {} if is_vhacd else {"threshold": request.threshold}
    options = {name: value for name, value in given.items() if value is not None}
    return DecompositionPlan(VhacdSettings(**options) if is_vhacd else CoacdSettings(**options), by=request.by)


def _decompose_line(result: PreparationResult) -> JobLine:
    text = "; ".join((*result.problems, *result.notes))
    if result.made:
        return JobLine(asset=result.asset, status="done", text=text or pluralize(len(result.hulls), "hull"))
    return JobLine(asset=result.asset, status="failed" if result.problems else "unchanged", text=text)


def start_rebuild(session: Session, request: RebuildJob) -> Job:
    """Start to rebuild bodies of which hulls span parts, or only to find these; one edit an asset, undone at once."""
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
        status: JobStatus = "failed" if result.problems else "done" if result.made else "skipped"
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
