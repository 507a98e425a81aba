"""`meshforge convert`: between formats, or an unedited write-back within one."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.options import AssetFile


def convert(
    source: AssetFile,
    out: Annotated[Path, typer.Argument(help="The file to write; its suffix names the format.")],
    link: Annotated[bool, typer.Option("--link", help="Hard-link files that are only copied.")] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files that are there already.")] = False,
) -> None:
    """Write an asset in another format, or unchanged in its own; says what the target cannot hold."""
    from meshforge.cli.output import counted, remark
    from meshforge.formats import load, save

    mesh = load(source)
    saved = save(mesh, out, link=link, overwrite=overwrite)
    for note in (*(mesh.asset.notes if mesh.asset else ()), *saved.notes):
        remark(f"note: {note}")
    remark(f"wrote {saved.path}: {counted(len(mesh.hulls), 'hull')}")
