"""`meshforge decompose`: any mesh into convex hulls."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console

from meshforge.cli.options import EngineMethod, EngineOptions, Hollow, Seconds, parse_engine_settings
from meshforge.cli.terminal import remark
from meshforge.common import pluralize
from meshforge.formats import read_triangles, save
from meshforge.geometry import EngineControl, Polytope, Pose, cache_folder
from meshforge.geometry import decompose as run_engine
from meshforge.symbolic import Asset, Body, Document, Geom


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
    surfaces = read_triangles(mesh)
    starts = np.cumsum([0, *(len(s.vertices) for s in surfaces)])
    console = Console(stderr=True)
    title = f"{method.value} on {mesh.name}"
    with console.status(title) as status:
        hulls = run_engine(
            np.concatenate([s.vertices for s in surfaces]),
            np.concatenate([s.faces + start for s, start in zip(surfaces, starts, strict=False)]),
            settings,
            close=not hollow,
            cache=cache_folder() if cache else None,
            note=lambda text: remark(f"note: {text}"),
            control=EngineControl(lambda text: status.update(f"{title}: {text}"), timeout=timeout),
        )
    saved = save(_to_asset(mesh, hulls), out, overwrite=overwrite)
    for note in saved.notes:
        remark(f"note: {note}")
    remark(f"wrote {saved.path}: {pluralize(len(hulls), 'hull')}")


def _to_asset(mesh: Path, hulls: list[Polytope]) -> Asset:
    """The hulls as an asset of one body, to be written in any format."""
    width = len(str(len(hulls) - 1))
    geoms = tuple(Geom(f"hull_{k:0{width}}", "body", hull) for k, hull in enumerate(hulls))
    return Asset(mesh, "decomposition", (Body("body", Pose.identity()),), geoms, Document())
