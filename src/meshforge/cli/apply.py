"""`meshforge apply`: run a program on many assets, or a project's program on its own."""

from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Any

import typer

from meshforge import batch
from meshforge.batch import apply as run_program
from meshforge.checks import CheckOptions, Goal
from meshforge.cli import options
from meshforge.cli.apply_work import Alarms, ApplyArguments, ApplyWork, work_of_program, work_of_project
from meshforge.cli.console import NOTHING_WRITTEN, NoteLog, describe_failure, progress
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, escape_name, join_names, pluralize


@options.takes(ApplyArguments)
def apply(given: ApplyArguments) -> None:
    """Run a program on assets; each goes back into its own format below --out, labels beside it.

    Assets that are given beside a project, and those that came to it later, are prepared first as the project's were:
    pieces decomposed, bodies rebuilt of which a hull spans parts, labels taken from the files, names and plug-ins that
    labelled the project, else by likeness. What was guessed is said of each.
    Results that stand out of the family are named at the end; with --json all lines come then.
    A run that was stopped or killed goes on where it was: the same command again. Exit code 1 when some assets failed
    or were held, or where results of a project stand out that are neither demonstrated, accepted nor signed off: they
    are named, and the others are done.
    """
    measures = CheckOptions.of(given.check) if given.check else None
    if measures and not given.report:
        raise UsageError("--check says nothing without --report", remedy="Give it too, or: meshforge check OUT")
    if given.report and given.dry_run:
        raise UsageError("with --dry-run there is nothing to show", remedy="Leave out --report.")
    with ExitStack() as stack:
        work = work_of_project(given, stack) if given.program.is_dir() else work_of_program(given)
        raise typer.Exit(_run(given, work, measures))


def _run(given: ApplyArguments, work: ApplyWork, measures: CheckOptions | None) -> int:
    if len(work.jobs) > 1:
        remark(batch.describe_jobs(work.jobs))
    shown = work.project.reference_measures() if work.project else ()
    summary, started, done = batch.RunSummary(shown=shown), perf_counter(), list[batch.AssetOutcome]()
    errors = dict[str, str | None]()  # of each asset, for builds
    run_options = batch.ApplyOptions(
        given.mass,
        given.link,
        given.dry_run,
        resume=not given.again,
        names=given.names,
        collision=given.collision,
        urdf_capsules=given.urdf_capsules or (work.project is not None and work.project.settings.urdf_capsules),
    )
    log = NoteLog(len(work.jobs) > 2)
    goals = work.project.read_goals() if work.project and not given.dry_run else {}
    for failed in work.new.failed:
        summary.add(failed)
        errors[failed.asset] = failed.error
        done.append(failed) if given.json else typer.echo(describe_failure(failed.asset, failed.error))
    try:
        with progress(len(work.jobs), "editing") as advance:
            execution = replace(given.execution.to_options(), progress=advance)
            for outcome in run_program(
                work.program, work.jobs, work.out, templates=work.templates, options=run_options, execution=execution
            ):
                summary.add(outcome)
                errors[outcome.asset] = outcome.error if isinstance(outcome, batch.Failed) else None
                if given.json:
                    done.append(outcome)
                else:
                    typer.echo(_describe_outcome(outcome, log))
    except BaseException:  # what a run did that cannot go on is told, too
        _print_lines(done, summary.find_alarms(), {}, {})
        raise
    alarms = summary.find_alarms()
    goal_lines, rows, goals_fail, cases = _try_goals(given, work, goals) if goals else ([], {}, False, [])
    if not given.dry_run:
        for asset, why in work.renew_sign_offs(alarms).items():
            remark(f"{escape_name(asset)} is no longer signed off: {why}")
    _print_lines(done, alarms, work.describe_result_statuses() if done else {}, rows)
    if work.new.prepared:
        from meshforge.project import describe_new  # lazy: 170 modules that a program file does not need

        if text := describe_new(list(work.new.prepared.values())):
            remark(text)
    summary.need_review = work.need_review
    for need_review in work.need_review:
        if given.json:
            print_json({**batch.to_json_line(need_review), **work.describe_new(need_review.asset)}, compact=True)
        else:
            typer.echo(f"needs review {escape_name(need_review.asset)}: {need_review.describe()}")
    if not given.json:
        log.print_repeated()
        typer.echo(f"{summary}{NOTHING_WRITTEN if given.dry_run else ''}")
        if alarms:
            typer.echo(batch.describe_alarms(alarms))
        for line in goal_lines:
            typer.echo(line)
    for text in summary.describe_absent_labels(work.program):
        remark(text)
    if given.report:
        _write_report(given.report, work, summary, perf_counter() - started, measures)
    outliers = work.find_outliers(alarms) if given.program.is_dir() and not given.accept_outliers else []
    if given.sarif or given.junit:
        paths = {job.id: job.path for job in work.jobs}
        for asset, error in errors.items():
            is_known, own = asset not in outliers, alarms.get(asset, ())
            cases.append(batch.make_edit_case(asset, paths.get(asset, Path(asset)), error, own, is_known=is_known))
        for one in work.need_review:
            path = paths.get(one.asset, Path(one.asset))
            cases.append(batch.CheckCase(one.asset, path, "edit", skipped=one.describe()))
        batch.write_build_files(given.sarif, given.junit, "apply", cases)
    if outliers:
        remark(f"Look at {join_names(outliers)}, then: {'meshforge review, or ' * bool(work.project)}--accept-outliers")
    return int(summary.counts["failed"] > 0 or bool(work.need_review) or bool(outliers) or goals_fail)


def _try_goals(
    given: ApplyArguments, work: ApplyWork, goals: Mapping[str, Goal]
) -> tuple[list[str], dict[str, dict[str, Any]], bool, list[batch.CheckCase]]:
    """What comes of the goals of a project on its own assets: lines, JSON by asset, whether one fails, cases."""
    from meshforge.cli.goal import describe_goals, have_failed, list_rows  # lazy: as above

    assert work.project
    with progress(len(work.jobs), "trying goals") as advance:
        execution = replace(given.execution.to_options(), progress=advance, timeout=batch.GOAL_EXECUTION.timeout)
        found = list(work.project.try_goals(goals, execution=execution))
    accepted = work.project.read_accepted_goals()
    return (
        describe_goals(goals, found, accepted),
        {one.asset: {"goals": list_rows(one)} for one in found},
        have_failed(goals, found, accepted=accepted),
        [
            case
            for one in found
            for case in batch.list_goal_cases(work.project.path(one.asset), one, accepted.get(one.asset, ()))
        ],
    )


def _print_lines(done: Iterable[batch.AssetOutcome], alarms: Alarms, *more: Mapping[str, Mapping[str, Any]]) -> None:
    for outcome in done:
        line = batch.to_json_line(outcome, alarms.get(outcome.asset, ()))
        for own in more:
            line |= own.get(outcome.asset, {})
        print_json(line, compact=True)


def _describe_outcome(outcome: batch.AssetOutcome, log: NoteLog) -> str:
    if isinstance(outcome, batch.Failed):
        return describe_failure(outcome.asset, outcome.error)
    rules = (f"rule {effect.rule}: {effect.note}" for effect in outcome.rules if effect.note)
    hulls = f"{outcome.before} -> {pluralize(outcome.after, 'hull')}"
    line = f"{outcome.status:10} {escape_name(outcome.asset)}: {hulls}"
    return log.describe(outcome.asset, line, (*rules, *outcome.notes, *outcome.flags))


def _write_report(
    path: Path, work: ApplyWork, summary: batch.RunSummary, seconds: float, measures: CheckOptions | None
) -> None:
    if work.project:
        from meshforge.project import build_run_report  # lazy: 170 modules that a program file does not need

        made = build_run_report(work.project, work.program, work.out, summary, seconds=seconds, measures=measures)
        header, assets, program = made.header, made.assets, made.program
    else:
        outcomes = batch.choose_outcomes(work.out, summary)
        readers, alarms = work.readers(outcome.asset for outcome in outcomes), summary.find_alarms()
        assets = list(batch.compare_outcomes(outcomes, work.program, readers, (), measures, alarms))
        header = batch.ReportHeader(work.out.resolve().name, seconds=seconds, figures=batch.RunFigures.of_run(summary))
        program = work.program
    with progress(len(assets), "drawing") as advance:
        batch.write_report(path, header, assets, program=program, options=batch.ReportOptions(progress=advance))
    remark(f"report: {escape_name(str(path))}")
