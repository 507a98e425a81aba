"""`meshforge apply`: run a program on many assets, or a project's program on its own."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.options import (
    NOTHING_TO_SHOW,
    Backend,
    DryRun,
    Json,
    LabelsPath,
    Memory,
    ReportPath,
    Timeout,
    Workers,
    to_execution_options,
)
from meshforge.cli.report import NOTHING_WRITTEN, describe_failure

if TYPE_CHECKING:
    from meshforge.batch import AssetJob, AssetOutcome, MeshReader, RunSummary
    from meshforge.checks import CheckOptions
    from meshforge.language import Program


def apply(
    program: Annotated[Path, typer.Argument(help="A program file (*.mf) or a project folder.")],
    assets: Annotated[list[str] | None, typer.Argument(help="Files, folders or globs; not with a project.")] = None,
    out: Annotated[
        Path | None, typer.Option("-o", "--out", help="Folder for the edited assets; a project has its own, edited/.")
    ] = None,
    labels: LabelsPath = None,
    workers: Workers = None,
    backend: Backend = "local",
    timeout: Timeout = None,
    memory: Memory = None,
    mass: Annotated[
        Literal["keep", "recompute"], typer.Option("--mass", help="Masses that a format derives from geometry.")
    ] = "keep",
    link: Annotated[bool, typer.Option("--link", help="Hard-link files that are only copied.")] = False,
    dry_run: DryRun = False,
    fresh: Annotated[bool, typer.Option("--fresh", help="Do again what an earlier run has done.")] = False,
    report: ReportPath = None,
    check: Annotated[
        list[str] | None,
        typer.Option(
            "--check",
            help="fit, clearance, physics or an engine: checks for the report, of what it shows. May be repeated.",
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Run a program on assets; each goes back into its own format below --out, labels beside it.

    A run that was stopped or killed goes on where it was: the same command again. Exit code 1 when some assets failed:
    they are named, and the others are done.
    """
    from time import perf_counter

    from meshforge.batch import ApplyOptions, RunSummary, plan_run, to_json_line
    from meshforge.cli.terminal import print_json, progress, remark
    from meshforge.common import UsageError

    measures = _parse_measures(check) if check else None
    if measures and not report:
        raise UsageError("--check says nothing without --report", remedy="Give it too, or: meshforge check OUT")
    if report and dry_run:
        raise UsageError(NOTHING_TO_SHOW, remedy="Leave out --report.")
    work = (
        _work_of_project(program, assets, labels, out)
        if program.is_dir()
        else _work_of_program(program, assets, out, labels)
    )
    if len(work.jobs) > 1:
        remark(str(plan_run(work.jobs, work.out)))
    summary, started = RunSummary(), perf_counter()
    options = ApplyOptions(mass, link, dry_run, resume=not fresh)
    execution = to_execution_options(workers, timeout, memory, backend)
    with progress(len(work.jobs), "editing") as advance:
        for outcome in work.run(out=work.out, options=options, execution=replace(execution, progress=advance)):
            summary.add(outcome)
            if json:
                print_json(to_json_line(outcome), compact=True)
            else:
                typer.echo(describe_outcome(outcome))
    if not json:
        typer.echo(f"{summary}{NOTHING_WRITTEN if dry_run else ''}")
    if report:
        _write_report(report, work, summary, perf_counter() - started, measures)
    raise typer.Exit(int(summary.counts["failed"] > 0))


def _parse_measures(names: Sequence[str]) -> CheckOptions:
    from meshforge.checks import ENGINES, CheckOptions
    from meshforge.common import UsageError

    known = ("fit", "clearance", "physics", *ENGINES)
    if odd := [name for name in names if name not in known]:
        raise UsageError(f"there is no check {odd[0]!r}", remedy=f"There are {', '.join(known)}.")
    engines = [name for name in names if name in ENGINES]
    if len(engines) > 1:
        raise UsageError(f"two engines for one report: {', '.join(engines)}", remedy="Choose one of them.")
    return CheckOptions(next(iter(engines), None), "fit" in names, "clearance" in names, "physics" in names)


@dataclass(frozen=True, slots=True)
class _ApplyWork:
    """What is to be run on what. readers: of assets before the run, by id; demonstrated: those that somebody edited."""

    program: Program
    jobs: Sequence[AssetJob]
    out: Path
    run: Callable[..., Iterator[AssetOutcome]]
    readers: Callable[[Iterable[str]], Sequence[MeshReader]]
    demonstrated: Collection[str] = ()


def _work_of_project(folder: Path, assets: list[str] | None, labels: Path | None, out: Path | None) -> _ApplyWork:
    from meshforge.batch import apply as run
    from meshforge.common import UsageError
    from meshforge.project import Project

    if assets or labels:
        raise UsageError(
            "a project has its own assets and labels",
            remedy=f"For other assets: meshforge apply {folder / 'program.mf'} ASSETS... --out DIR",
        )
    project = Project.open(folder)
    program, jobs, templates = project.work()
    return _ApplyWork(
        program,
        jobs,
        out or project.layout.edited,
        partial(run, program, jobs, templates=templates),
        project.readers,
        frozenset(project.layout.ids_with("demonstrations")),
    )


def _work_of_program(path: Path, assets: list[str] | None, out: Path | None, labels: Path | None) -> _ApplyWork:
    from meshforge.batch import apply as run
    from meshforge.batch import expand, load_templates, make_jobs, read_job, template_folders
    from meshforge.common import UsageError
    from meshforge.language import Program

    if not assets or out is None:
        lacking = "assets" if not assets else "--out DIR"
        raise UsageError(f"{lacking} is missing", remedy="meshforge apply PROGRAM ASSETS... --out DIR")
    program = Program.read(path)
    templates = load_templates(program, template_folders(path))
    work = make_jobs(expand(assets), labels)
    known = {job.id: job for job in work}
    return _ApplyWork(
        program,
        work,
        out,
        partial(run, program, work, templates=templates),
        lambda assets: [partial(read_job, known[asset]) for asset in assets],
    )


def describe_outcome(outcome: AssetOutcome) -> str:
    """What became of an asset: a line, and its notes below it."""
    from meshforge.batch import Failed, status_of
    from meshforge.common import pluralize

    if isinstance(outcome, Failed):
        return describe_failure(outcome)
    notes = (*(f"rule {r.rule}: {r.note}" for r in outcome.rules if r.note), *outcome.notes, *outcome.flags)
    line = f"{status_of(outcome):10} {outcome.asset}: {outcome.before} -> {pluralize(outcome.after, 'hull')}"
    return "\n".join([line, *(f"    note: {note}" for note in notes)])


def _write_report(
    path: Path, work: _ApplyWork, summary: RunSummary, seconds: float, measures: CheckOptions | None
) -> None:
    from meshforge.batch import RunFigures
    from meshforge.cli.report import compare_outcomes, write_report_page

    readers = work.readers(outcome.asset for outcome in summary.outcomes_to_show)
    write_report_page(
        path,
        list(compare_outcomes(summary.outcomes_to_show, work.program, readers, work.demonstrated, measures)),
        title=work.out.resolve().name,
        program=work.program,
        figures=RunFigures.of_run(summary),
        seconds=seconds,
    )
