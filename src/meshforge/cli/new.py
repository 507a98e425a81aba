"""`meshforge new`: a project folder for some assets."""

from dataclasses import dataclass
from typing import Annotated, Literal

import typer

from meshforge.cli import options
from meshforge.cli.prepare import decompose_assets
from meshforge.common import pluralize
from meshforge.project import Project, format_next


@dataclass(frozen=True, slots=True)
class NewArguments:
    """What is typed after `meshforge new`."""

    context: typer.Context
    project: Annotated[str, typer.Argument(help="The folder to make.")]
    assets: options.AssetFiles
    vocabulary: Annotated[str, typer.Option("--vocabulary", help="Labels that hulls can have: a,b,c.")] = ""
    orient: Annotated[
        str, typer.Option("--orient", help="How assets are turned first: '+Z: Is(leg) -> Is(panel)'.")
    ] = ""
    up: Annotated[
        Literal["Y", "Z"] | None,
        typer.Option("--up", help="The axis that points up in pictures, where files do not say: OBJ, STL, PLY."),
    ] = None
    method: Annotated[
        options.EngineMethod | None,
        typer.Option("--decompose", help="Make hulls of non-convex pieces, and of bodies without collision geometry."),
    ] = None
    option: options.EngineOptions = None
    max_vertices: options.MaxVertices = None
    hollow: options.Hollow = False
    by: options.By = "whole"
    workers: options.Workers = None
    timeout: options.AssetTimeout = 600.0


@options.takes(NewArguments)
def new(given: NewArguments) -> None:
    """Make a project folder; the assets stay where they are and are never written to.

    With --decompose, exit code 1 when some pieces could not be decomposed (each named); the project is there.
    """
    if given.method is None:
        options.refuse_options(
            given.context, ("option", "max_vertices", "hollow", "by", "workers", "timeout"), "--decompose METHOD"
        )
    settings = options.parse_engine_settings(given.method, given.option, given.max_vertices) if given.method else None
    vocabulary = options.split_words(given.vocabulary)
    project = Project.create(given.project, given.assets, vocabulary=vocabulary, orient=given.orient, up=given.up or "")
    assets = project.assets()
    typer.echo(f"{given.project}: a project of {pluralize(len(assets), 'asset')}")
    failed = 0
    if settings:
        failed = decompose_assets(
            project, assets, settings, hollow=given.hollow, by=given.by, workers=given.workers, timeout=given.timeout
        )
    typer.echo(format_next("made", given.project))
    raise typer.Exit(failed)
