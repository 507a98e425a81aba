"""`meshforge convert`: between formats, or an unedited write-back within one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from meshforge.cli.options import AssetFile, Labels

if TYPE_CHECKING:
    from meshforge.formats import Saved
    from meshforge.symbolic import SymbolicMesh


def convert(
    source: AssetFile,
    out: Annotated[Path, typer.Argument(help="The file to write; its suffix names the format.")],
    labels: Labels = None,
    link: Annotated[bool, typer.Option("--link", help="Hard-link files that are only copied.")] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files that are there already.")] = False,
) -> None:
    """Write an asset in another format, or unchanged in its own; says what the target cannot hold.

    Labels go beside it, under the names that the hulls have there.
    """
    from meshforge.cli.output import remark
    from meshforge.formats import load, save
    from meshforge.words import counted

    mesh = load(source, labels=labels)
    saved = save(mesh, out, link=link, overwrite=overwrite)
    for note in (*(mesh.asset.notes if mesh.asset else ()), *saved.notes):
        remark(f"note: {note}")
    if mesh.labels:
        _write_labels(mesh, saved, overwrite)
    remark(f"wrote {saved.path}: {counted(len(mesh.hulls), 'hull')}")


def _write_labels(mesh: SymbolicMesh, saved: Saved, overwrite: bool) -> None:
    from dataclasses import replace

    from meshforge.cli.output import remark
    from meshforge.formats import labels_beside
    from meshforge.symbolic import write_labels

    path = labels_beside(saved.path)
    if path.exists() and not overwrite:
        remark(f"note: {path} is there already and was left as it is")
        return
    renamed = mesh.with_hulls(replace(hull, name=saved.names.get(hull.name, hull.name)) for hull in mesh.hulls)
    write_labels(path, renamed, ())
