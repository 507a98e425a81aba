"""`meshforge check`: whether hulls are legal, within an engine's limits, fit, leave free what is free, and rest."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from meshforge.cli.check_report import CheckReport, describe_changes
from meshforge.cli.options import (
    AssetFiles,
    Backend,
    Json,
    LabelsPath,
    Memory,
    ReportPath,
    Timeout,
    Workers,
    to_execution_options,
)

if TYPE_CHECKING:
    from meshforge.batch import CheckJournal, CheckOutcome


EngineName = Literal["mujoco", "physx-cpu", "physx-gpu", "unreal", "unity", "bullet", "godot"]
_FEW = 5  # assets whose results one sees at a glance


def check(
    assets: AssetFiles,
    engine: Annotated[EngineName | None, typer.Option("--engine", help="Also check the limits of this engine.")] = None,
    fit: Annotated[
        bool, typer.Option("--fit", help="Measure how far hulls stick out of the visual mesh, and what lies bare.")
    ] = False,
    clearance: Annotated[
        bool, typer.Option("--clearance", help="Measure what hulls close and open of the space that can be reached.")
    ] = False,
    physics: Annotated[bool, typer.Option("--physics", help="Rest each asset on a plane in MuJoCo.")] = False,
    against: Annotated[
        Path | None, typer.Option("--against", help="The asset before an edit, or a folder that mirrors the assets'.")
    ] = None,
    cell: Annotated[
        float | None,
        typer.Option(
            "--cell", min=1e-9, help="Side of the cells of --fit and --clearance [m]; default diagonal / 112."
        ),
    ] = None,
    pictures: Annotated[
        Path | None, typer.Option("--pictures", help="Folder for heat maps and pictures of what is closed.")
    ] = None,
    mend: Annotated[
        bool, typer.Option("--fix", help="Mend what is beyond the engine's limits, as far as safe; write to --out.")
    ] = False,
    out: Annotated[Path | None, typer.Option("-o", "--out", help="Folder for the mended assets.")] = None,
    tolerance: Annotated[
        float | None,
        typer.Option(
            "--tolerance",
            min=0.0,
            help="How far a mended hull may stick out of the old one [m]; default 1% of the diagonal.",
        ),
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files in --out.")] = False,
    kept: Annotated[
        Path | None,
        typer.Option(
            "--journal",
            help="Keep what is found in this file as it comes: the same command again checks only what is not in it or "
            "has changed.",
        ),
    ] = None,
    report: ReportPath = None,
    labels: LabelsPath = None,
    workers: Workers = None,
    backend: Backend = "local",
    timeout: Timeout = None,
    memory: Memory = None,
    json: Json = False,
) -> None:
    """Check that every hull is convex, closed and solid, and keeps to the limits of an engine.

    --fit, --clearance and --physics measure more, in seconds an asset. Exit code 1 when a check does not hold or a
    file cannot be read.
    """
    from time import perf_counter

    from meshforge.batch import CheckTask, check_assets, expand, make_jobs, open_journal, plan_run
    from meshforge.checks import CheckOptions
    from meshforge.cli.terminal import print_json, progress, remark
    from meshforge.common import UsageError, pluralize

    if mend and not (engine and out):
        lacking = "--fix needs --engine and --out"
        raise UsageError(lacking, remedy="meshforge check ASSETS... --engine NAME --fix --out DIR")
    _refuse_without({"--out": out, "--tolerance": tolerance, "--overwrite": overwrite or None}, mend, "--fix")
    _refuse_without({"--cell": cell, "--pictures": pictures}, fit or clearance, "--fit or --clearance")
    _refuse_without({"--against": against}, clearance or physics, "--clearance or --physics")
    wanted = CheckTask(
        CheckOptions(engine, fit, clearance, physics, cell), out, tolerance, overwrite, against, pictures
    )
    work = make_jobs(expand(assets), labels)
    if len(work) > _FEW:
        remark(str(plan_run(work, out)))
    if len(work) == 1 and not wanted.measures.is_costly and timeout is None and memory is None:
        workers = 0  # starting a process would take longer than the work
    failed, page, started = 0, CheckReport() if report else None, perf_counter()
    spread = to_execution_options(workers, timeout, memory, backend)
    with open_journal(kept) if kept else nullcontext() as book, progress(len(work), "checking") as advance:
        known = book.inputs if book else {}
        results = check_assets(work, wanted, replace(spread, progress=advance), known=known)
        for job, examined in zip(work, results, strict=True):
            row = _to_row(book, job.id, examined)
            failed += row["failed"]
            if page:
                page.add(job, examined, row)
            if json:
                print_json(row["found"], compact=True)
            else:
                typer.echo(row["said"])
    if not json and len(work) > _FEW:
        typer.echo(f"{pluralize(len(work), 'asset')}, {failed:,} with errors")
    if report and page:
        name = work[0].id if len(work) == 1 else work[0].base.name
        page.write(report, f"Checks of {name}", wanted.measures, perf_counter() - started)
    raise typer.Exit(int(failed > 0))


def _refuse_without(given: dict[str, object], allowed: bool, without: str) -> None:
    """Raise UsageError for an option that was given without the one that it belongs to."""
    from meshforge.common import UsageError

    for option, value in given.items():
        if value is not None and not allowed:
            raise UsageError(f"{option} says nothing without {without}", remedy="Give it too, or leave this one out.")


def _to_row(book: CheckJournal | None, asset: str, examined: CheckOutcome | None) -> dict[str, Any]:
    """What is to be printed about an asset: out of the journal where nothing changed, else kept there from now on."""
    if examined is None:
        assert book is not None
        return book.read_row(asset)
    row = {
        "failed": examined.has_failed,
        "found": examined.to_json(),
        "said": _describe_examined(examined),
        "told": list(_describe_work(examined)),
    }
    if book and examined.inputs:
        book.add(asset, examined.inputs, row)
    return row


def _describe_examined(examined: CheckOutcome) -> str:
    path, found = examined.path, examined.examination
    if found is None:
        return f"{path}: cannot be read\n  " + (examined.error or "").replace("\n", "\n  ")
    lines = [*_describe_work(examined)]
    for finding in found.findings:
        lines.append(f"{finding.severity}: {finding.message}")
        lines += [f"  {finding.remedy}"] if finding.remedy else []
    return "\n  ".join([f"{path}:", *lines]) if lines else f"{path}: legal"


def _describe_work(examined: CheckOutcome) -> tuple[str, ...]:
    """What was mended, measured and written, a sentence each."""
    measured = examined.examination.descriptions if examined.examination else ()
    return (*describe_changes(examined), *measured, *(f"wrote {picture}" for picture in examined.pictures))
