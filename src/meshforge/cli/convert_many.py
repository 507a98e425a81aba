"""`meshforge convert --to`: many assets into one format, as a run without a program, and the page of `--report`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter

import typer

from meshforge import batch
from meshforge.cli.console import NoteLog, progress
from meshforge.cli.report import NOTHING_WRITTEN, describe_failure, write_report_page
from meshforge.cli.terminal import print_json, remark
from meshforge.common import escape_name, pluralize
from meshforge.language import Program


def convert_many(
    sources: Sequence[str],
    out: Path,
    labels: Path | None,
    options: batch.ApplyOptions,
    execution: batch.ExecutionOptions,
    report: Path | None,
    *,
    json: bool,
) -> None:
    """Write all assets below a folder in another format, and leave with exit code 1 where some failed."""
    jobs, summary, started = batch.make_jobs(batch.expand(sources), labels), batch.RunSummary(), perf_counter()
    log = NoteLog(len(jobs) > 2)
    if len(jobs) > 1:
        remark(str(batch.plan_run(jobs, out)))
    with progress(len(jobs), "converting") as advance:
        for outcome in batch.apply(
            Program(), jobs, out, options=options, execution=replace(execution, progress=advance)
        ):
            summary.add(outcome)
            if json:
                print_json(batch.to_json_line(outcome), compact=True)
            else:
                typer.echo(_describe_outcome(outcome, log))
    if not json:
        log.print_repeated()
        typer.echo(str(summary).replace("unchanged", "written", 1) + NOTHING_WRITTEN * options.dry_run)
    if report:
        _write_report(report, f"{out.resolve().name} as {options.to}", jobs, summary, perf_counter() - started)
    raise typer.Exit(int(summary.counts["failed"] > 0))


def _describe_outcome(outcome: batch.AssetOutcome, log: NoteLog) -> str:
    if isinstance(outcome, batch.Failed):
        return describe_failure(outcome)
    word = "skipped" if isinstance(outcome, batch.Skipped) else "written"
    line = f"{word:10} {escape_name(outcome.out)}: {pluralize(outcome.after, 'hull')}"
    return log.describe(outcome.asset, line, outcome.notes)


def _write_report(
    path: Path, title: str, jobs: Sequence[batch.AssetJob], summary: batch.RunSummary, seconds: float
) -> None:
    by_id = {job.id: job for job in jobs}
    readers = [partial(batch.read_job, by_id[outcome.asset]) for outcome in summary.outcomes_to_show]
    shown = batch.compare_outcomes(summary.outcomes_to_show, Program(), readers)
    write_report_page(
        path,
        batch.ReportHeader(
            title,
            "Each asset as it was read, and as what was written of it reads.",
            seconds,
            batch.RunFigures.of_run(summary, {"unchanged": "written"}),
        ),
        [replace(asset, status="written") if asset.status == "unchanged" else asset for asset in shown],
        options=batch.ReportOptions(changes=False),  # the target may have other names
    )
