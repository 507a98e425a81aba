"""`meshforge prepare`: hulls for what has none, before any program sees the assets of a project."""

from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any

import typer

from meshforge.batch import ExecutionOptions, Replacement
from meshforge.cli import options
from meshforge.cli.console import progress
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, describe_error, escape_name, pluralize
from meshforge.geometry import DecomposeSettings
from meshforge.project import (
    MADE_ANEW,
    REBUILD_DEFAULTS,
    PreparationResult,
    Project,
    RebuildSettings,
    forget_plan,
    format_next,
)
from meshforge.project.prepare import count_copies, count_pieces


@dataclass(frozen=True, slots=True)
class PrepareArguments:
    """What is typed after `meshforge prepare`."""

    context: typer.Context
    project: Annotated[Path, typer.Argument(help="A project folder.")]
    assets: Annotated[
        list[str] | None,
        typer.Argument(help="Assets by their ids, as `status` lists them, or their files; default all."),
    ] = None
    method: Annotated[
        options.EngineMethod | None,
        typer.Option(
            "--decompose",
            help="Make hulls of what has none, by this engine; hull: the convex hull of each collision mesh. "
            "With --rebuild-spanning: the engine of the fine pieces that new hulls are made of; default coacd.",
        ),
    ] = None
    option: options.EngineOptions = None
    max_vertices: options.MaxVertices = None
    only: Annotated[
        list[str] | None,
        typer.Option("--only", help="Only pieces, hulls and bodies of this name or pattern; repeatable."),
    ] = None
    again: Annotated[bool, typer.Option("--again", help="Decompose anew what is decomposed already.")] = False
    hollow: options.Hollow = False
    by: options.By = "whole"
    rebuild_spanning: Annotated[
        bool,
        typer.Option(
            "--rebuild-spanning", help="Make all hulls anew, part by part, of bodies where a hull spans parts."
        ),
    ] = False
    min_confidence: Annotated[
        float | None,
        typer.Option(
            "--min-confidence",
            metavar="P",
            help="Rebuild where a hull spans parts with this probability or more [0.9].",
        ),
    ] = None
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Name bodies that would be rebuilt; write nothing.")] = (
        False
    )
    undo: Annotated[bool, typer.Option("--undo", help="Take back the last thing that was done to each.")] = False
    remove: Annotated[bool, typer.Option("--remove", help="Take back all that was done to each.")] = False
    workers: options.Workers = None
    timeout: options.AssetTimeout = 600.0
    json: options.Json = False


@options.takes(PrepareArguments)
def prepare(given: PrepareArguments) -> None:
    """Decompose non-convex pieces, and what bodies without collision geometry show, into convex hulls.

    The hulls are kept in the project, in prepared/, and take the place of the piece whenever the project reads the
    asset; the asset's own files stay as they are. To cut one hull: meshforge cut.
    Exit code 1 when some pieces could not be decomposed, or something could not be taken back (each named).
    """
    spanning = given.rebuild_spanning
    if (given.method is not None and not spanning) + spanning + given.undo + given.remove != 1:
        what = "--decompose METHOD, --rebuild-spanning, --undo or --remove"
        raise UsageError(f"say what to do, one of these: {what}")
    if not spanning:
        options.refuse_options(given.context, ("min_confidence", "dry_run"), "--rebuild-spanning")
    if given.undo and not given.assets:
        raise UsageError("--undo of which asset?", remedy="Name it; --remove takes back everything, of all assets too.")
    project = Project.open(given.project)
    if spanning:
        raise typer.Exit(_rebuild_spanning(project, given))
    if given.method is None:
        only_with_method = ("option", "max_vertices", "only", "again", "hollow", "by", "workers", "timeout")
        options.refuse_options(given.context, only_with_method, "--decompose METHOD")
        results = _undo_preparation(project, _select_assets(project, given.assets), everything=given.remove)
        if given.remove and not given.assets:
            forget_plan(project)
        raise typer.Exit(print_results(project, results, given.json))
    settings = options.parse_engine_settings(given.method, given.option, given.max_vertices)
    assets = [options.asset_id(asset, project) for asset in given.assets or ()]
    raise typer.Exit(
        decompose_assets(
            project,
            assets or project.assets(),
            settings,
            only=given.only or (),
            again=given.again,
            hollow=given.hollow,
            by=given.by,
            workers=given.workers,
            timeout=given.timeout,
            json=given.json,
        )
    )


def _rebuild_spanning(project: Project, given: PrepareArguments) -> int:
    """Rebuild bodies of which a hull spans parts, and print what became of each asset; the exit code."""
    this = "--rebuild-spanning"
    options.refuse_with(given.context, ("option", "max_vertices", "again", "hollow", "by"), this)
    if given.method is options.EngineMethod.HULL:
        raise UsageError(f"--decompose hull divides nothing: it does not go with {this}", remedy="Try coacd or vhacd.")
    results = project.rebuild_spanning(
        [options.asset_id(asset, project) for asset in given.assets] if given.assets else None,
        RebuildSettings(
            REBUILD_DEFAULTS.min_confidence if given.min_confidence is None else given.min_confidence,
            "vhacd" if given.method is options.EngineMethod.VHACD else "coacd",
            tuple(given.only or ()),
        ),
        dry_run=given.dry_run,
        execution=ExecutionOptions(workers=given.workers, timeout=given.timeout),
        stage=progress,
    )
    return print_results(project, results, given.json)


def decompose_assets(
    project: Project,
    assets: Iterable[str],
    settings: DecomposeSettings,
    *,
    workers: int | None,
    timeout: float,
    json: bool = False,
    **more: Any,
) -> int:
    """Decompose assets of a project and print what became of each; the exit code. more: of `Project.decompose`."""
    ids = tuple(dict.fromkeys(assets))
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory(ignore_cleanup_errors=True)))
        advance = stack.enter_context(progress(len(ids), "decomposing", partial(count_pieces, folder)))
        execution = ExecutionOptions(workers=workers, timeout=timeout, progress=advance)
        results = project.decompose(ids, settings, execution=execution, pieces=folder, **more)
        return print_results(project, results, json)


def print_results(project: Project, results: Iterable[PreparationResult], json: bool = False) -> int:
    """Print what became of assets, and what writes it; 1 where one has a problem, else 0."""
    failed, made = False, list[Replacement]()
    for result in results:
        failed |= bool(result.problems)
        made += result.made
        if json:
            print_json(asdict(result) | {"hulls": list(result.hulls)}, compact=True)
        else:
            _print_one(result)
    if copies := 0 if json else count_copies(made):
        typer.echo(f"{pluralize(copies, 'equal copy', 'equal copies')} got the hulls of the first")
    if made and not json:
        is_old, has_program = project.program_state().outdated, project.layout.program.exists()
        remark(format_next("forgot" if is_old else "prepared" if has_program else "prepared all", project.folder))
    return int(failed)


def _print_one(result: PreparationResult) -> None:
    typer.echo(f"{escape_name(result.asset)}: {_describe_change(result)}")
    for step in result.undone:
        typer.echo(f"    {step}")
    entries = result.made or result.planned
    for entry in (entry for entry in entries if entry.remark != MADE_ANEW):
        is_named = entry.remark.startswith(f"{entry.what} ")
        typer.echo(f"    {entry.remark}" if is_named else f"    {entry.what}: {entry.remark}")
    if anew := sum(entry.remark == MADE_ANEW for entry in entries):
        typer.echo(f"    {pluralize(anew, 'other')} {MADE_ANEW}")
    for note in result.notes:
        typer.echo(f"    note: {note}")
    for problem in result.problems:
        typer.echo("    failed: " + problem.replace("\n", "\n    "))


def _describe_change(result: PreparationResult) -> str:
    """`2 pieces into 6 hulls`; what was taken back or is planned; or nothing new."""
    entries = result.made or result.planned
    if not entries:
        return "taken back" if result.undone else "nothing new"
    hulls = sum(len(entry.made) for entry in entries)
    remark = f"{pluralize(len(entries), 'piece')} into {pluralize(hulls, 'hull')}"
    return remark if result.made else f"nothing written; would turn {remark}"


def _select_assets(project: Project, assets: list[str] | None) -> tuple[str, ...]:
    """The assets that were named, each once; without names all that something was done to, those that are gone too.

    Raises ProjectError for a name that nothing has.
    """
    kept = project.layout.preparation.ids
    named = [asset if asset in kept else options.asset_id(asset, project) for asset in assets or ()]
    return tuple(dict.fromkeys(named or kept))


def _undo_preparation(project: Project, assets: Iterable[str], *, everything: bool) -> Iterator[PreparationResult]:
    for asset in assets:
        try:
            yield project.unprepare(asset, everything=everything)
        except Exception as error:  # one asset never stops the others
            yield PreparationResult(asset, problems=(describe_error(error, asset),))
