"""`meshforge new`: a project folder for some assets."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from meshforge.cli.options import (
    AssetFiles,
    AssetTimeout,
    EngineMethod,
    EngineOptions,
    Hollow,
    Workers,
    parse_engine_settings,
    refuse_options,
)
from meshforge.cli.prepare import decompose_assets


def new(
    context: typer.Context,
    project: Annotated[str, typer.Argument(help="The folder to make.")],
    assets: AssetFiles,
    vocabulary: Annotated[str, typer.Option("--vocabulary", help="Labels that hulls can have: a,b,c.")] = "",
    orient: Annotated[
        str, typer.Option("--orient", help="How assets are turned first: '+Z: Is(leg) -> Is(panel)'.")
    ] = "",
    method: Annotated[
        EngineMethod | None,
        typer.Option("--decompose", help="Make hulls of opaque pieces, and of bodies without collision geometry."),
    ] = None,
    option: EngineOptions = None,
    hollow: Hollow = False,
    workers: Workers = None,
    timeout: AssetTimeout = 600.0,
) -> None:
    """Make a project folder; the assets stay where they are and are never written to.

    With --decompose, exit code 1 when some pieces could not be decomposed (each named); the project is there.
    """
    from meshforge.common import pluralize
    from meshforge.project import Project

    if method is None:
        refuse_options(context, ("option", "hollow", "workers", "timeout"), "--decompose METHOD")
    settings = parse_engine_settings(method, option) if method else None
    made = Project.create(project, assets, vocabulary=_split_words(vocabulary), orient=orient)
    typer.echo(f"{project}: a project of {pluralize(len(made.assets()), 'asset')}")
    options: dict[str, Any] = {"hollow": hollow, "workers": workers, "timeout": timeout}
    failed = decompose_assets(made, made.assets(), settings, **options) if settings else 0
    typer.echo(f"Next: meshforge status {project}")
    raise typer.Exit(failed)


def _split_words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]
