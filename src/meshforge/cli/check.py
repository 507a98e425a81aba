"""`meshforge check`: whether hulls are legal, within an engine's limits, fit, leave free what is free, and rest."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal

import typer

from meshforge import batch
from meshforge.checks import MEASURES, CheckOptions
from meshforge.cli import options
from meshforge.cli.console import NoteLog, progress
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, escape_name, pluralize

Validator = Literal["simcheck", "simready"]
_FEW = 5  # assets whose results one sees at a glance


@dataclass(frozen=True, slots=True)
class CheckArguments:
    """What is typed after `meshforge check`."""

    context: typer.Context
    assets: options.AssetFiles
    engine: Annotated[
        options.EngineName | None,
        typer.Option(
            "--engine",
            help="Also check the limits of this engine, and ask it itself: MuJoCo, or Bullet if pybullet is installed.",
        ),
    ] = None
    fit: Annotated[
        bool, typer.Option("--fit", help="Measure how far hulls stick out of the visual mesh, and what lies bare.")
    ] = False
    clearance: Annotated[
        bool, typer.Option("--clearance", help="Measure what hulls close and open of the space that can be reached.")
    ] = False
    physics: Annotated[bool, typer.Option("--physics", help="Rest each asset on a plane in MuJoCo.")] = False
    pairs: Annotated[
        bool, typer.Option("--pairs", help="Propose pairs of bodies to exclude from contact: see --exclude.")
    ] = False
    second_opinion: Annotated[
        Validator | None,
        typer.Option(
            "--second-opinion",
            help="Also ask another validator: simcheck, or for USD simready. Needs pip install 'meshforge[referees]'.",
        ),
    ] = None
    check: Annotated[
        list[str] | None,
        typer.Option("--check", help="A check of a plug-in, or one of those above by its name. May be repeated."),
    ] = None
    against: Annotated[
        Path | None, typer.Option("--against", help="The asset before an edit, or a folder that mirrors the assets'.")
    ] = None
    cell: Annotated[
        float | None,
        typer.Option(
            "--cell", min=1e-9, help="Side of the cells of --fit and --clearance [m]; default diagonal / 112."
        ),
    ] = None
    pictures: Annotated[
        Path | None, typer.Option("--pictures", help="Folder for heat maps, what is closed, and pairs, as pictures.")
    ] = None
    fix: Annotated[
        bool,
        typer.Option("--fix", help="Fix what is beyond the engine's limits, or has too many vertices; write to --out."),
    ] = False
    out: Annotated[Path | None, typer.Option("-o", "--out", help="Folder for the fixed assets.")] = None
    tolerance: Annotated[
        float | None,
        typer.Option(
            "--tolerance",
            min=0.0,
            help="How far a fixed hull may stick out of the old one [m]; default 1% of the diagonal, or as far as "
            "--max-vertices asks for.",
        ),
    ] = None
    max_vertices: options.MaxVertices = None
    exclude: options.ExcludedPairs = None
    strict: Annotated[bool, typer.Option("--strict", help="Exit with 1 also where there are warnings.")] = False
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files in --out.")] = False
    sarif: options.SarifPath = None
    junit: options.JunitPath = None
    baseline: Annotated[Path | None, typer.Option("--baseline", help="What is known: only new errors fail.")] = None
    update_baseline: Annotated[bool, typer.Option("--update-baseline", help="Write what is found to it.")] = False
    labels: options.LabelsPath = None
    execution: options.ExecutionArguments = options.EXECUTION
    json: options.Json = False


@options.takes(CheckArguments)
def check(given: CheckArguments) -> None:
    """Check that every hull is convex, closed and solid, and keeps to the limits of an engine.

    --fit, --clearance, --physics and --pairs measure more, in seconds an asset. Exit code 1 when something is wrong or
    cannot be read, with --strict also when it is doubtful, with --baseline only where that is not in the file; 2 when
    the command makes no sense. meshforge explain CODE says what a finding means.
    """
    chosen = [kind.name for kind in MEASURES if getattr(given, kind.name)]
    asked = filter(None, [given.engine, given.second_opinion])
    measures = CheckOptions.of([*asked, *chosen, *(given.check or ())], given.cell)
    _refuse_stray_options(given, measures)
    known = batch.Baseline.read(given.baseline, new=given.update_baseline) if given.baseline else None
    task = batch.CheckTask(
        measures,
        given.out,
        given.tolerance,
        given.max_vertices,
        given.overwrite,
        given.against,
        given.pictures,
        exclude=tuple(given.exclude or ()),
    )
    if known:
        task = replace(task, digests_from=known.folder)
    jobs = batch.make_jobs(batch.expand(given.assets), given.labels)
    if len(jobs) > _FEW:
        remark(batch.describe_jobs(jobs))
    unchanged = known.find_unchanged(jobs, task) if known else {}
    fresh = [job for job in jobs if job.id not in unchanged]
    # of one asset, starting a process would take longer than the work
    isolated = measures.is_costly or given.engine in batch.ENGINES_TO_ASK  # an engine may crash
    is_bounded = given.execution.timeout is not None or given.execution.memory is not None
    in_process = len(fresh) == 1 and not isolated and not is_bounded
    execution = (replace(given.execution, workers=0) if in_process else given.execution).to_options()
    done, failed, accepted = [], 0, 0
    log = NoteLog(len(jobs) > 2)
    with progress(len(fresh), "checking") as advance:
        results = batch.check_assets(fresh, task, replace(execution, progress=advance))
        for job in jobs:
            outcome = unchanged.get(job.id) or next(results)
            outcome = known.compare(job, outcome) if known else outcome
            failed += not outcome.is_spotless if given.strict else outcome.has_failed
            accepted += len(outcome.accepted)
            if known or given.sarif or given.junit:
                done.append((job, outcome))
            if given.json:
                print_json(outcome.to_json(), compact=True)
            else:
                typer.echo(_number_notes(log, job.id, _describe_check(outcome)))
        next(results, None)  # ends its workers
    log.print_repeated()
    if not given.json and (len(jobs) > _FEW or known):
        before = f", {pluralize(accepted, 'finding')} known, {len(unchanged):,} not checked again" if known else ""
        what = f"{'new ' * bool(known)}errors{' or warnings' * given.strict}"
        typer.echo(f"{pluralize(len(jobs), 'asset')}, {failed:,} with {what}{before}")
    if given.sarif or given.junit:
        cases = [
            case
            for job, outcome in done
            for case in batch.list_check_cases(job, outcome, measures.names, strict=given.strict)
        ]
        batch.write_build_files(given.sarif, given.junit, "check", cases)
    if known and given.update_baseline:
        known.write(done, task)
    raise typer.Exit(int(failed > 0))


def _refuse_stray_options(given: CheckArguments, measures: CheckOptions) -> None:
    if given.fix and not ((measures.engine or given.max_vertices or given.exclude) and given.out):
        remedy = "meshforge check ASSETS... --engine NAME --fix --out DIR"
        raise UsageError("--fix needs --engine, --max-vertices or --exclude, and --out", remedy=remedy)
    if not given.baseline:
        options.refuse_options(given.context, ("update_baseline",), "--baseline")
    if given.fix:
        options.refuse_with(given.context, ("baseline",), "--fix")
    else:
        options.refuse_options(given.context, ("out", "tolerance", "overwrite", "max_vertices", "exclude"), "--fix")
    if not any(check.has_cells for check in measures.checks):
        options.refuse_options(given.context, ("cell",), "--fit or --clearance")
        if not given.pairs:
            options.refuse_options(given.context, ("pictures",), "--fit, --clearance or --pairs")
    if not any(check.compares for check in measures.checks):
        options.refuse_options(given.context, ("against",), "--clearance or --physics")


def _number_notes(log: NoteLog, asset: str, text: str) -> str:
    """What is printed about an asset, without the notes that were printed on another one."""
    head, *lines = text.split("\n")
    notes = [line for line in lines if line.startswith(("  note: ", "  engine: "))]
    return "\n".join([log.describe(asset, head, notes, start=""), *(line for line in lines if line not in notes)])


def _describe_check(outcome: batch.CheckOutcome) -> str:
    path, lines = escape_name(str(outcome.path)), [*_describe_work(outcome)]
    loaded = outcome.examination.loaded if outcome.examination else None
    if not outcome.findings and len(lines) == bool(loaded):  # nothing else to say
        return f"{path}: legal{f' ({loaded.description})' if loaded else ''}"
    texts = [f"{'known ' * (finding in outcome.accepted)}{finding}" for finding in outcome.findings]
    lines += [line for text in texts for line in text.split("\n")]
    return "\n  ".join([f"{path}:", *lines])


def _describe_work(outcome: batch.CheckOutcome) -> tuple[str, ...]:
    measured = outcome.examination.descriptions if outcome.examination else ()
    return (
        *_describe_changes(outcome),
        *measured,
        *(f"wrote {escape_name(str(picture))}" for picture in outcome.pictures),
    )


def _describe_changes(outcome: batch.CheckOutcome) -> tuple[str, ...]:
    """What was fixed, what was left, and where it was written, a sentence each."""
    if outcome.is_unchanged:
        then = "" if outcome.findings else "; nothing was found then"
        return (f"unchanged since the baseline, not checked again{then}",)
    if (fixed := outcome.fix_result) is None:
        return ()
    return (
        *(f"fixed: {change.description}" for change in fixed.changes),
        *(f"fixed: {escape_name(element)}: each of its hulls is in a file of its own" for element in fixed.parted),
        *(f"fixed: {escape_name(pair)} do not touch any more" for pair in fixed.excluded),
        *fixed.left,
        f"wrote {escape_name(str(outcome.output))}",
    )
