"""`meshforge decompose`: any mesh into convex hulls."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from meshforge import formats
from meshforge.cli import options
from meshforge.cli.console import fold_notes, progress
from meshforge.cli.terminal import remark
from meshforge.common import UsageError, escape_name, pluralize


@dataclass(frozen=True, slots=True)
class DecomposeArguments:
    """What is typed after `meshforge decompose`."""

    mesh: Annotated[Path, typer.Argument(help="A mesh file: OBJ, STL, PLY, DAE, GLB.")]
    out: Annotated[
        Path | None, typer.Option("-o", "--out", help="The file of hulls to write; its suffix names the format.")
    ] = None
    method: Annotated[options.EngineMethod, typer.Option("--decompose", help="The engine.")] = (
        options.EngineMethod.COACD
    )
    option: options.EngineOptions = None
    max_vertices: options.MaxVertices = None
    by: options.By = "whole"
    hollow: options.Hollow = False
    timeout: options.Seconds = None
    cache: Annotated[bool, typer.Option("--cache/--no-cache", help="Keep results, and use kept ones.")] = True
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace the file if it is there.")] = False


@options.takes(DecomposeArguments)
def decompose(given: DecomposeArguments) -> None:
    """Decompose a mesh into convex hulls by CoACD or V-HACD; the same input gives the same hulls."""
    settings = options.parse_engine_settings(given.method, given.option, given.max_vertices)
    if given.out is None:
        raise UsageError("nothing says what to write", remedy="Give --out FILE.")
    with progress(None, f"{given.method.value} on {given.mesh.name}") as shown:
        made = formats.decompose(
            given.mesh,
            settings,
            by=given.by,
            hollow=given.hollow,
            timeout=given.timeout,
            cache=given.cache,
            progress=shown.show,
        )
    saved = formats.save(made, given.out, overwrite=given.overwrite)
    for note in fold_notes((*(made.asset.notes if made.asset else ()), *saved.notes)):
        remark(f"note: {note}")
    remark(f"wrote {escape_name(str(saved.path))}: {pluralize(len(made.hulls), 'hull')}")
