"""`meshforge prepare`: hulls for what has none, before any program sees the assets of a project."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from meshforge.cli.options import (
    AssetTimeout,
    EngineMethod,
    EngineOptions,
    Hollow,
    Json,
    Workers,
    parse_engine_settings,
    refuse_options,
)

if TYPE_CHECKING:
    from meshforge.project import PreparationResult, Project


def prepare(
    context: typer.Context,
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    assets: Annotated[list[str] | None, typer.Argument(help="Ids of assets, as `status` lists them; all.")] = None,
    method: Annotated[
        EngineMethod | None, typer.Option("--decompose", help="Make hulls of what has none, by this engine.")
    ] = None,
    option: EngineOptions = None,
    only: Annotated[
        list[str] | None, typer.Option("--only", help="Only pieces and bodies of this name or pattern; repeatable.")
    ] = None,
    again: Annotated[bool, typer.Option("--again", help="Decompose anew what is decomposed already.")] = False,
    hollow: Hollow = False,
    undo: Annotated[bool, typer.Option("--undo", help="Take back the last thing that was done to each.")] = False,
    remove: Annotated[bool, typer.Option("--remove", help="Take back all that was done to each.")] = False,
    workers: Workers = None,
    timeout: AssetTimeout = 600.0,
    json: Json = False,
) -> None:
    """Decompose opaque pieces, and what bodies without collision geometry show, into convex hulls.

    The hulls are kept in the project, in prepared/, and take the place of the piece whenever the project reads the
    asset; the asset's own files stay as they are. To split one hull: meshforge split.
    Exit code 1 when some pieces could not be decomposed, or something could not be taken back (each named).
    """
    from meshforge.common import UsageError
    from meshforge.project import Project

    if (method is not None) + undo + remove != 1:
        raise UsageError("say what to do: --decompose METHOD, --undo or --remove")
    if undo and not assets:
        raise UsageError("--undo of which asset?", remedy="Name it; --remove takes back everything, of all assets too.")
    opened = Project.open(project)
    if method is None:
        refuse_options(context, ("option", "only", "again", "hollow", "workers", "timeout"), "--decompose METHOD")
        raise typer.Exit(print_all(_undo_preparation(opened, _select_assets(opened, assets), everything=remove), json))
    settings = parse_engine_settings(method, option)
    options = {"only": only or (), "again": again, "hollow": hollow}
    execution = ExecutionOptions(workers=workers, timeout=timeout)
    raise typer.Exit(decompose_assets(opened, assets or opened.assets(), settings, json=json, **options))


def decompose_assets(
    project: Project, assets: Iterable[str], settings: Any, *, json: bool = False, **options: Any
) -> int:
    """Decompose assets of a project and show what became of each; the exit code."""
    from meshforge.cli.terminal import progress

    ids = tuple(dict.fromkeys(assets))
    with progress(len(ids), "decomposing") as advance:
        found = project.decompose(ids, settings, progress=advance, **options)
        return print_all(found, json)


def print_all(found: Iterable[PreparationResult], json: bool = False) -> int:
    """Print what became of assets; 1 where one has a problem, else 0."""
    from meshforge.cli.terminal import print_json

    failed = 0
    for done in found:
        failed |= bool(done.problems)
        if json:
            print_json(asdict(done) | {"hulls": list(done.hulls)}, compact=True)
        else:
            _print_one(done)
    return int(failed)


def _print_one(done: PreparationResult) -> None:
    from meshforge.common import pluralize

    pieces = f"{pluralize(len(done.made), 'piece')} into {pluralize(len(done.hulls), 'hull')}"
    typer.echo(f"{done.asset}: {pieces if done.made else 'taken back' if done.undone else 'nothing new'}")
    for step in done.undone:
        typer.echo(f"    {step}")
    for entry in done.made:
        typer.echo(f"    {entry.what}: {entry.told}")
    for note in done.notes:
        typer.echo(f"    note: {note}")
    for problem in done.problems:
        typer.echo("    failed: " + problem.replace("\n", "\n    "))


def _select_assets(project: Project, assets: list[str] | None) -> tuple[str, ...]:
    """The assets that were named, each once; without names all that something was done to, those that are gone too.

    Raises ProjectError for a name that nothing has.
    """
    kept = project.layout.ids_with_preparation()
    for asset in assets or ():
        if asset not in kept:
            project.path(asset)
    return tuple(dict.fromkeys(assets or kept))


def _undo_preparation(project: Project, assets: Iterable[str], *, everything: bool) -> Iterator[PreparationResult]:
    """What became of assets whose preparation is taken back; one that fails never stops the others."""
    from meshforge.common import describe_error
    from meshforge.project import PreparationResult

    for asset in assets:
        try:
            yield project.unprepare(asset, everything=everything)
        except Exception as error:  # one asset never stops the others
            yield PreparationResult(asset, problems=(describe_error(error, asset),))
