"""`meshforge convert`: between formats, or an unedited write-back within one; of one asset, or of very many."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

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
    from meshforge.batch import ApplyOptions, AssetJob, AssetOutcome, ExecutionOptions, RunSummary
    from meshforge.formats import EngineName, Loss, SaveResult
    from meshforge.symbolic import Feature, SymbolicMesh


def convert(
    paths: Annotated[
        list[str],
        typer.Argument(
            metavar="ASSET... OUT",
            help="An asset and the file to write, whose suffix names the format; with --to, many and a folder.",
        ),
    ],
    to: Annotated[
        str | None, typer.Option("--to", metavar="SUFFIX", help="Write all assets in this format, as .usda, below OUT.")
    ] = None,
    names: Annotated[
        Literal["unreal", "godot", "unity"] | None,
        typer.Option("--names", help="Call what collides as this engine knows it: glTF for all, OBJ for unreal."),
    ] = None,
    labels: LabelsPath = None,
    link: Annotated[bool, typer.Option("--link", help="Hard-link files that are only copied.")] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files that are there already.")] = False,
    dry_run: DryRun = False,
    report: ReportPath = None,
    workers: Workers = None,
    backend: Backend = "local",
    timeout: Timeout = None,
    memory: Memory = None,
    json: Json = False,
) -> None:
    """Write an asset in another format, or unchanged in its own; says what the target cannot hold.

    Bodies, joints, masses and visuals are carried over where the format has them. Labels go beside the file, under the
    names that the hulls have there. With --to, folders and globs are taken, too, OUT mirrors their tree, a run that was
    stopped goes on where it was, and the exit code is 1 when some failed.
    """
    from meshforge.batch import ApplyOptions
    from meshforge.common import UsageError

    if len(paths) < 2:
        raise UsageError("there is nothing to write to", remedy="meshforge convert ASSET OUT")
    *sources, out = paths
    if to is None:
        if dry_run:
            raise UsageError("--dry-run is for --to", remedy="meshforge convert ASSETS... OUT --to SUFFIX --dry-run")
        if report:
            raise UsageError("--report is for --to", remedy="meshforge convert ASSETS... OUT --to SUFFIX --report FILE")
        if len(sources) > 1:
            raise UsageError("several assets and no format", remedy="meshforge convert ASSETS... OUT --to SUFFIX")
        return _convert_one(Path(sources[0]), Path(out), labels, names, link=link, overwrite=overwrite, json=json)
    if report and dry_run:
        raise UsageError(NOTHING_TO_SHOW, remedy="Leave out --report.")
    if overwrite:
        raise UsageError("--overwrite is for one asset", remedy="Outputs of an earlier run are replaced as it is.")
    suffix = _parse_suffix(to)
    options = ApplyOptions(link=link, dry_run=dry_run, to=suffix, names=names)
    execution = to_execution_options(workers, timeout, memory, backend)
    _convert_many(sources, Path(out), suffix, labels, options, execution, report, json=json)
    return None


def _parse_suffix(to: str) -> str:
    """The suffix of a format that can be written. Raises UsageError."""
    from meshforge.common import UsageError
    from meshforge.formats import FORMATS

    suffix = f".{to.lower().lstrip('.')}"
    known = [own for found in FORMATS if found.writable for own in found.suffixes]
    if suffix not in known:
        raise UsageError(f"nothing is written as {suffix}", remedy=f"Formats: {', '.join(known)}.")
    return suffix


def _convert_many(
    sources: Sequence[str],
    out: Path,
    suffix: str,
    labels: Path | None,
    options: ApplyOptions,
    execution: ExecutionOptions,
    report: Path | None,
    *,
    json: bool,
) -> None:
    from time import perf_counter

    from meshforge.batch import RunSummary, apply, expand, plan_run, to_json_line
    from meshforge.batch import make_jobs as jobs_of
    from meshforge.cli.terminal import print_json, progress, remark
    from meshforge.language import Program

    jobs, summary, started = jobs_of(expand(sources), labels), RunSummary(), perf_counter()
    if len(jobs) > 1:
        remark(str(plan_run(jobs, out)))
    with progress(len(jobs), "converting") as advance:
        for outcome in apply(Program(), jobs, out, options=options, execution=replace(execution, progress=advance)):
            summary.add(outcome)
            if json:
                print_json(to_json_line(outcome), compact=True)
            else:
                typer.echo(_describe_outcome(outcome))
    if not json:
        typer.echo(str(summary).replace("unchanged", "written", 1) + NOTHING_WRITTEN * options.dry_run)
    if report:
        write_convert_report(report, out, suffix, jobs, summary, perf_counter() - started)
    raise typer.Exit(int(summary.counts["failed"] > 0))


def _describe_outcome(outcome: AssetOutcome) -> str:
    from meshforge.batch import Failed, Skipped
    from meshforge.common import pluralize

    if isinstance(outcome, Failed):
        return describe_failure(outcome)
    word = "skipped" if isinstance(outcome, Skipped) else "written"
    line = f"{word:10} {outcome.out}: {pluralize(outcome.after, 'hull')}"
    return "\n".join([line, *(f"    note: {note}" for note in outcome.notes)])


def _convert_one(
    source: Path, out: Path, labels: Path | None, names: EngineName | None, *, link: bool, overwrite: bool, json: bool
) -> None:
    from meshforge.cli.terminal import print_json, remark
    from meshforge.common import pluralize
    from meshforge.formats import load, save

    mesh = load(source, labels=labels)
    saved = save(mesh, out, link=link, overwrite=overwrite, names=names)
    read_notes = mesh.asset.notes if mesh.asset else ()
    if mesh.labels:
        _write_labels(mesh, saved, overwrite)
    if json:
        return print_json(_to_json(source, saved, len(mesh.hulls), read_notes))
    for note in (*read_notes, *saved.notes):
        remark(f"note: {note}")
    held = [pluralize(feature.count, feature.kind.one, feature.kind.many) for feature in saved.report.held]
    remark(f"wrote {saved.path}: {', '.join([pluralize(len(mesh.hulls), 'hull'), *held])}")
    return None


def _to_json(source: Path, saved: SaveResult, hulls: int, notes: Sequence[str]) -> dict[str, Any]:
    """The report as JSON has it."""
    report = saved.report
    return {
        "asset": str(source),
        "out": str(saved.path),
        "hulls": hulls,
        "held": [_to_row(feature) for feature in report.held],
        "lost": [{**_to_row(loss), "why": loss.why, "instead": loss.instead} for loss in report.lost],
        "notes": [*notes, *report.remarks],
    }


def _to_row(thing: Feature | Loss) -> dict[str, Any]:
    return {"what": thing.kind.many, "count": thing.count, "names": list(thing.names)}


def _write_labels(mesh: SymbolicMesh, saved: SaveResult, overwrite: bool) -> None:
    from dataclasses import replace

    from meshforge.cli.terminal import remark
    from meshforge.formats import labels_beside
    from meshforge.symbolic import write_labels

    path = labels_beside(saved.path)
    if path.exists() and not overwrite:
        remark(f"note: {path} is there already and was left as it is")
        return
    renamed = mesh.with_hulls(replace(hull, name=saved.names.get(hull.name, hull.name)) for hull in mesh.hulls)
    write_labels(path, renamed, ())


def write_convert_report(
    path: Path, out: Path, suffix: str, jobs: Sequence[AssetJob], summary: RunSummary, seconds: float
) -> None:
    """Write it; out: the folder, and suffix the format, that all were written in."""
    from meshforge.batch import RunFigures, read_job
    from meshforge.cli.report import compare_outcomes, write_report_page
    from meshforge.language import Program

    known = {job.id: job for job in jobs}
    readers = [partial(read_job, known[outcome.asset]) for outcome in summary.outcomes_to_show]
    shown = compare_outcomes(summary.outcomes_to_show, Program(), readers)
    write_report_page(
        path,
        [replace(asset, status="written") if asset.status == "unchanged" else asset for asset in shown],
        title=f"{out.resolve().name} as {suffix}",
        about="Each asset as it was read, and as what was written of it reads.",
        figures=RunFigures.of_run(summary, {"unchanged": "written"}),
        seconds=seconds,
        changes=False,  # the target may have other names
    )
