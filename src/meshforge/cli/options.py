"""Options that several commands share, so that they read alike everywhere."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

if TYPE_CHECKING:
    from meshforge.batch import Spread


def _gibibytes(text: str) -> int:
    """Bytes of a number of GiB."""
    try:
        number = float(text)
    except ValueError:
        number = 0
    if not 0 < number < 1e6:
        raise typer.BadParameter(f"{text!r} is no number of GiB above 0")
    return int(number * (1 << 30))


Json = Annotated[bool, typer.Option("--json", help="Print JSON for scripts.")]
Labels = Annotated[
    Path | None,
    typer.Option("--labels", help="Labels file; for several assets a folder that mirrors theirs.", show_default=False),
]
Workers = Annotated[int | None, typer.Option("--workers", min=1, help="Processes; default one a core.")]
DryRun = Annotated[bool, typer.Option("--dry-run", help="Say what would be done, write nothing.")]
Report = Annotated[
    Path | None, typer.Option("--report", help="An HTML page with pictures of each asset, failures first.")
]
Backend = Annotated[
    Literal["local", "ray"], typer.Option("--backend", help="Where the work is done: here, or on a Ray cluster.")
]
Timeout = Annotated[
    float | None,
    typer.Option("--timeout", min=0, help="Seconds for one asset, 0 for no bound; default 600.", show_default=False),
]
Memory = Annotated[
    int | None,
    typer.Option(
        "--memory",
        metavar="GIB",
        parser=_gibibytes,
        help="Memory for one asset; default an even share of the machine's.",
        show_default=False,
    ),
]
InProject = Annotated[
    Path | None,
    typer.Option("--project", help="Show ASSET as this project prepares and labels it; ASSET may be its id there."),
]
AssetFile = Annotated[Path, typer.Argument(help="A file with collision hulls, or a folder of mesh files.")]
AssetFiles = Annotated[list[str], typer.Argument(help="Files, folders or globs of assets.")]


def spread_of(
    workers: int | None = None,
    timeout: float | None = None,
    memory: int | None = None,
    backend: Literal["local", "ray"] = "local",
) -> Spread:
    """How work is spread by these options."""
    from meshforge.batch import TIMEOUT, Spread

    return Spread(workers, TIMEOUT if timeout is None else timeout or None, memory, backend=backend)
