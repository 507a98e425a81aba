"""Options that several commands share, so that they read alike everywhere."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Json = Annotated[bool, typer.Option("--json", help="Print JSON for scripts.")]
Labels = Annotated[
    Path | None,
    typer.Option("--labels", help="Labels file; for several assets a folder that mirrors theirs.", show_default=False),
]
Workers = Annotated[int | None, typer.Option("--workers", min=1, help="Processes; default one a core.")]
InProject = Annotated[
    Path | None,
    typer.Option("--project", help="Show ASSET as this project prepares and labels it; ASSET may be its id there."),
]
AssetFile = Annotated[Path, typer.Argument(help="A file with collision hulls, or a folder of mesh files.")]
AssetFiles = Annotated[list[str], typer.Argument(help="Files, folders or globs of assets.")]
