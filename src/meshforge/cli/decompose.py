"""`meshforge decompose`: any mesh into convex hulls."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from meshforge import formats
from meshforge.cli.options import EngineMethod, EngineOptions, Hollow, Seconds, parse_engine_settings
from meshforge.cli.terminal import remark
from meshforge.common import pluralize


def decompose(
    mesh: Annotated[Path, typer.Argument(help="A mesh file: OBJ, STL, PLY, DAE, GLB.")],
    out: Annotated[Path, typer.Option("-o", "--out", help="The file of hulls to write; its suffix names the format.")],
    method: Annotated[EngineMethod, typer.Option("--decompose", help="The engine.")] = EngineMethod.COACD,
    option: EngineOptions = None,
    hollow: Hollow = False,
    timeout: Seconds = None,
    cache: Annotated[bool, typer.Option("--cache/--no-cache", help="Keep results, and use kept ones.")] = True,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace the file if it is there.")] = False,
) -> None:
    """Decompose a mesh into convex hulls by CoACD or V-HACD; the same input gives the same hulls."""
    settings = parse_engine_settings(method, option)
    console = Console(stderr=True)
    title = f"{method.value} on {mesh.name}"
    with console.status(title) as status:
        made = formats.decompose(
            mesh,
            settings,
            hollow=hollow,
            timeout=timeout,
            cache=cache,
            progress=lambda text: status.update(f"{title}: {text}"),
        )
    saved = formats.save(made, out, overwrite=overwrite)
    for note in (*(made.asset.notes if made.asset else ()), *saved.notes):
        remark(f"note: {note}")
    remark(f"wrote {saved.path}: {pluralize(len(made.hulls), 'hull')}")
