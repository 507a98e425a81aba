"""Jobs on outputs: running the program, once new assets are prepared as the others were, checking what it wrote, and
exporting it into a folder of its own."""

import os
import shutil
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from uuid import uuid4

from meshforge import batch
from meshforge.checks.goals.base import GoalOutcome
from meshforge.checks.goals.registry import parse_goal
from meshforge.common import (
    ProjectError,
    UsageError,
    file_digest,
    join_names,
    plain_path,
    pluralize,
    relative_name,
    replace_atomically,
    write_atomically,
)
from meshforge.language import Program
from meshforge.project import (
    NewAssetOptions,
    NewAssetResult,
    build_run_report,
    describe_new,
    list_new,
    sees_whole_family,
    summarize_outputs,
)
from meshforge.studio.session.job_runner import JobProgress
from meshforge.studio.session.session import Session
from meshforge.studio.wire.asset import Fault
from meshforge.studio.wire.family import Card, picture_key
from meshforge.studio.wire.jobs import ApplyJob, ExportJob, Job, JobLine, JobStatus

EXPORT_MARK = ".meshforge-export"
"""The file that an export leaves in its folder: the names of all that was exported, one a line."""
EXPORT_REPORT = "meshforge-report.html"
"""The page that an export writes beside the outputs: pictures, figures, and how sure each result is."""
_RESERVED = (*batch.OWN_FOLDERS, batch.STATE)


def start_apply(session: Session, request: ApplyJob) -> Job:
    """Start to run the program on all assets, or on some. Raises ProjectError where there is no program."""
    project = session.project
    session.check_assets(*request.assets or ())
    assets = project.assets() if request.assets is None else tuple(dict.fromkeys(request.assets))
    if project.program() is None:
        raise ProjectError("there is no program yet", remedy="Demonstrate what is to be done on an asset or two.")

    def work(progress: JobProgress) -> str:
        summary = batch.RunSummary(shown=project.reference_measures())
        new, unclear = prepare_new(session, progress, assets, rebuild=request.rebuild)
        notes = {asset: one.describe() for asset, one in new.items()}
        failed = [one.failure for one in new.values() if one.failure]
        for failure in failed:
            summary.add(failure)
            progress.add_line(_apply_line(failure, notes))
        lost = {failure.asset for failure in failed}
        program, jobs, templates = project.work([asset for asset in assets if asset not in lost])
        jobs = tuple(replace(job, notes=notes.get(job.id, ())) for job in jobs)
        with progress.stage(len(jobs), "applying the program") as advance:
            execution = batch.ExecutionOptions(stop=progress.is_stopped, progress=advance)
            for outcome in batch.apply(program, jobs, project.layout.edited, templates=templates, execution=execution):
                summary.add(outcome)
                progress.add_line(_apply_line(outcome, notes))
                session.note_output(outcome.asset)
        fails = 0
        if goals := project.read_goals():
            with progress.stage(len(jobs), "trying goals") as advance:
                run = replace(batch.GOAL_EXECUTION, stop=progress.is_stopped, progress=advance)
                for one in project.try_goals(goals, only=[job.id for job in jobs], execution=run):
                    fails += any(result.outcome in ("failed", "broken") for result in one.after.values())
                    session.refresh_queue.add([one.asset])
        if sees_whole_family(project):  # else the studio knows too little: `review` signs off
            project.renew_sign_offs(summary.find_alarms(), keep_persons=True)
        session.learning.assess()  # what was accepted counts again where it came out the same
        text = ", ".join(f"{number} {word}" for word, number in summary.counts.items())
        of_goals = f"goals fail on {pluralize(fails, 'result')}" if fails else None
        remarks = (remark for remark in (unclear, describe_new(list(new.values())), of_goals) if remark)
        sentences = (f"{remark[0].upper()}{remark[1:]}." for remark in remarks)
        return " ".join([f"{pluralize(len(assets), 'asset')}: {text or 'none'}.", *sentences])

    title = f"Applying the program to {pluralize(len(assets), 'asset')}"
    return session.jobs.start("apply", title, len(assets), work, str(project.layout.edited))


def _apply_line(outcome: batch.AssetOutcome, notes: Mapping[str, tuple[str, ...]]) -> JobLine:
    before = notes.get(outcome.asset, ())
    if isinstance(outcome, batch.Failed):
        return JobLine(asset=outcome.asset, status="failed", text=outcome.error, before=before)
    more = (note for note in outcome.notes if note not in before)
    parts = [f"{outcome.before} → {pluralize(outcome.after, 'hull')}", *more, *outcome.flags]
    return JobLine(asset=outcome.asset, status=outcome.status, text="; ".join(parts), before=before)


def prepare_new(
    session: Session, progress: JobProgress, assets: Collection[str], *, rebuild: bool
) -> tuple[Mapping[str, NewAssetResult], str | None]:
    """Prepare those of some assets that are new; each is one edit, and all are undone at once. Return what became of
    them, and why they were not decomposed, where it is not clear how.

    rebuild: whether bodies are rebuilt of which a hull spans parts, or these only named. Raises ProjectError where what
    the project keeps of how its assets were prepared is damaged.
    """
    project, group = session.project, uuid4().hex
    new, unclear = list_new(project)
    if not any(one.id in assets for one in new):
        return {}, unclear
    program = project.program()
    options = NewAssetOptions(
        rebuild=rebuild,
        guess=program is None or bool(program.labels_asked),
        execution=batch.ExecutionOptions(stop=progress.is_stopped),
        stage=progress.stage,
        write_block=lambda asset: session.record_preparation(f"{asset} prepared as the others", asset, group),
    )
    results = {one.asset: one for one in project.prepare_new(options, assets)}
    session.update([relative_name(project.layout.preparation_plan, project.folder)])
    return results, unclear


def start_goal(session: Session, text: str) -> Job:
    """Start to try a goal on all assets, before and after the program. Raises ProgramError where it does not parse."""
    project, counts = session.project, Counter[str]()
    goal = parse_goal(text, "goal", project.words)

    def work(progress: JobProgress) -> str:
        run = replace(batch.GOAL_EXECUTION, stop=progress.is_stopped, progress=progress.advance)
        for one in project.try_goals({text: goal}, execution=run):
            line = _goal_line(one)
            progress.add_line(line)
            counts.update([line.status, *(f"{found.outcome} before" for found in one.before.values())])
        tried = pluralize(counts["done"] + counts["failed"], "asset")
        away = f"; it does not apply to {counts['skipped']}" if counts["skipped"] else ""
        before = f", {counts['passed before']} before the edit" if project.program() else ""
        return f"{goal.word()} holds on {counts['done']} of {tried}{before}{away}."

    total = len(set(project.assets()) - project.exclusions().keys())
    return session.jobs.start("goal", f"Trying {goal}", total, work)


_GOAL_WORDS: Mapping[GoalOutcome, JobStatus] = {"passed": "done", "untried": "skipped"}


def _goal_line(one: batch.AssetGoals) -> JobLine:
    if one.error:
        return JobLine(asset=one.asset, status="failed", text=one.error)
    (result,), picture = one.after.values(), next(iter(one.pictures.values()), None)
    status, key = _GOAL_WORDS.get(result.outcome, "failed"), picture_key(picture) if picture else None
    return JobLine(asset=one.asset, status=status, text=result.why, picture=key)


def start_check(session: Session) -> Job:
    """Start to check all outputs. Raises ProjectError where there are none."""
    assets = tuple(card.asset for card in session.pages.cards if card.check)
    if not assets:
        raise ProjectError("there is no output to be checked", remedy="Apply the program first.")

    def work(progress: JobProgress) -> str:
        with_text = failed = 0
        for asset, found in session.checks.check_all(session.project, assets, progress.advance, progress.is_stopped):
            line = to_line(asset, found)
            with_text += bool(line.text and line.status == "done")
            failed += line.status == "failed"
            progress.add_line(line)
            session.refresh_queue.add([asset])
        broken = f"; {failed} could not be checked" if failed else ""
        return f"{pluralize(len(assets), 'result')}: {with_text} with findings, limits of engines apart{broken}."

    return session.jobs.start("check", f"Checking {pluralize(len(assets), 'result')}", len(assets), work)


def to_line(asset: str, found: tuple[Fault, ...] | str) -> JobLine:
    """Return the line of one output: the rules that do not hold, without limits of engines, or why it is not known."""
    if isinstance(found, str):
        return JobLine(asset=asset, status="failed", text=found)
    rules = dict.fromkeys(fault.rule for fault in found if fault.engine is None)
    return JobLine(asset=asset, status="done", text=join_names(list(rules)))


def list_signed_off(session: Session) -> list[Card]:
    """Return the assets whose output is up to date and signed off: sure enough, with no goal that fails or was not
    tried, or accepted by a person."""
    known = session.pages.shown.assessment
    unreviewed = {row.asset for row in known.assets if row.state == "signed"} if known else set()
    unreviewed -= {card.asset for card in session.pages.cards if any(goal.is_open for goal in card.goals)}
    written = [card for card in session.pages.cards if card.output in ("edited", "unchanged") and not card.stale]
    return [card for card in written if card.review == "accepted" or (card.review is None and card.asset in unreviewed)]


def start_export(session: Session, request: ExportJob) -> Job:
    """Start to export. Raises UsageError for a folder that is not to be written, or holds other things."""
    folder = _check_folder(session, request.folder)
    known = _read_mark(folder)
    rows = list_signed_off(session) if request.signed_only else session.pages.cards
    if not rows:
        which = "signed off" if request.signed_only else "there"
        raise UsageError(f"no output is {which} to be exported", remedy="Apply the program, and accept what is right.")
    project, edited = session.project, session.project.layout.edited

    def work(progress: JobProgress) -> str:
        (folder / EXPORT_REPORT).unlink(missing_ok=True)  # it is of the export before
        kept: dict[str, None] = {}
        done = 0
        for card in rows:
            progress.raise_if_stopped()
            line = _export_asset(edited, folder, card.asset, known, kept)
            done += line.status == "done"
            progress.add_line(line)
            progress.advance()
        _remove_files(folder, [name for name in known if name not in kept])
        program, stop = project.program() or Program(), batch.ExecutionOptions(stop=progress.is_stopped)
        made = build_run_report(project, program, edited, summarize_outputs(project), execution=stop)
        with progress.stage(len(made.assets), "drawing the report") as advance:
            options = batch.ReportOptions(progress=advance, execution=stop)
            batch.write_report(folder / EXPORT_REPORT, made.header, made.assets, program=program, options=options)
        return f"{pluralize(done, 'asset')} exported, with {EXPORT_REPORT}."

    return session.jobs.start("export", f"Exporting {pluralize(len(rows), 'asset')}", len(rows), work, str(folder))


def _export_asset(edited: Path, folder: Path, asset: str, known: dict[str, None], kept: dict[str, None]) -> JobLine:
    """Copy all files of one output, the main one last, so that it never names what is not there."""
    stamp = batch.read_stamp(edited, asset)
    if stamp is None or stamp.status not in ("edited", "unchanged"):
        return JobLine(asset=asset, status="skipped", text="it has no output")
    if not stamp.is_whole(edited):
        return JobLine(asset=asset, status="failed", text="files of its output are gone or changed: apply it again")
    names = sorted(stamp.outputs, key=lambda name: (name == stamp.out, name))
    unknown = [name for name in names if name not in known and (folder / name).exists()]
    if unknown:
        return JobLine(asset=asset, status="failed", text=f"{folder / unknown[0]} is there, and no export wrote it")
    known |= dict.fromkeys(names)
    write_atomically(folder / EXPORT_MARK, "".join(f"{name}\n" for name in known))
    for name in names:
        _copy_file(edited / name, folder / name)
        kept[name] = None
    return JobLine(asset=asset, status="done", text=pluralize(len(names), "file"))


def _copy_file(source: Path, target: Path) -> None:
    if target.is_file() and file_digest(target) == file_digest(source):
        return
    with replace_atomically(target) as draft:
        shutil.copyfile(source, draft)
        draft.chmod(source.stat().st_mode & 0o777)


def _check_folder(session: Session, name: str) -> Path:
    """The folder to write: below the project, or the one that was allowed when the studio was opened."""
    root, allowed = session.project.folder, session.options.export
    folder = plain_path(root / name)
    if allowed and folder == plain_path(allowed):
        return folder
    remedy = "Choose a folder of its own inside of the project, or start the studio with --export DIR."
    real = Path(os.path.realpath(folder))
    if not real.is_relative_to(os.path.realpath(root)) or real == Path(os.path.realpath(root)):
        raise UsageError("outputs are exported below the project only", where=str(folder), remedy=remedy)
    if folder.relative_to(root).parts[0] in _RESERVED:
        raise UsageError("this folder belongs to the project itself", where=str(folder), remedy=remedy)
    return folder


def _read_mark(folder: Path) -> dict[str, None]:
    """The files of earlier exports into a folder. Raises UsageError where it holds anything else only."""
    mark = folder / EXPORT_MARK
    if mark.is_file():
        return dict.fromkeys(mark.read_text(encoding="utf-8", errors="replace").splitlines())
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        remedy = "Choose a new folder, or one of an earlier export."
        raise UsageError("this folder holds something else", where=str(folder), remedy=remedy)
    return {}


def _remove_files(folder: Path, names: Iterable[str]) -> None:
    gone = set(names)
    for name in gone:
        (folder / name).unlink(missing_ok=True)
    left = [name for name in _read_mark(folder) if name not in gone]
    write_atomically(folder / EXPORT_MARK, "".join(f"{name}\n" for name in left))
