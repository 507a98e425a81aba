"""`meshforge new`: a project folder for some assets."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.options import AssetFiles


def new(
    project: Annotated[Path, typer.Argument(help="The folder to make.")],
    assets: AssetFiles,
    vocabulary: Annotated[str, typer.Option("--vocabulary", help="Labels that hulls can have: a,b,c.")] = "",
    orient: Annotated[
        str, typer.Option("--orient", help="How assets are turned first: '+Z: Is(leg) -> Is(panel)'.")
    ] = "",
) -> None:
    """Make a project folder; the assets stay where they are and are never written to."""
    from meshforge.project import Project
    from meshforge.words import counted

    made = Project.create(project, assets, vocabulary=_words(vocabulary), orient=orient)
    typer.echo(f"{project}: a project of {counted(len(made.assets()), 'asset')}")
    typer.echo(f"Next: meshforge status {project}")


def _words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]
