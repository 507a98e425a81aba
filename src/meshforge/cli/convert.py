"""`meshforge convert`: between formats, or an unedited write-back within one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from meshforge.cli.options import AssetFile, Json, Labels

if TYPE_CHECKING:
    from meshforge.asset import Feature
    from meshforge.formats import Loss, Saved
    from meshforge.symbolic import SymbolicMesh


def convert(
    source: AssetFile,
    out: Annotated[Path, typer.Argument(help="The file to write; its suffix names the format.")],
    labels: Labels = None,
    link: Annotated[bool, typer.Option("--link", help="Hard-link files that are only copied.")] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files that are there already.")] = False,
    json: Json = False,
) -> None:
    """Write an asset in another format, or unchanged in its own; says what the target cannot hold.

    Bodies, joints, masses and visuals are carried over where the format has them. Labels go beside the file, under the
    names that the hulls have there.
    """
    from meshforge.cli.output import print_json, remark
    from meshforge.formats import load, save
    from meshforge.words import counted

    mesh = load(source, labels=labels)
    saved = save(mesh, out, link=link, overwrite=overwrite)
    read_notes = mesh.asset.notes if mesh.asset else ()
    if mesh.labels:
        _write_labels(mesh, saved, overwrite)
    if json:
        return print_json(_as_data(source, saved, len(mesh.hulls), read_notes))
    for note in (*read_notes, *saved.notes):
        remark(f"note: {note}")
    held = [counted(feature.count, feature.what.one, feature.what.many) for feature in saved.report.held]
    remark(f"wrote {saved.path}: {', '.join([counted(len(mesh.hulls), 'hull'), *held])}")


def _as_data(source: Path, saved: Saved, hulls: int, notes: Sequence[str]) -> dict[str, Any]:
    """The report as JSON has it."""
    report = saved.report
    return {
        "asset": str(source),
        "out": str(saved.path),
        "hulls": hulls,
        "held": [_row(feature) for feature in report.held],
        "lost": [{**_row(loss), "why": loss.why, "instead": loss.instead} for loss in report.lost],
        "notes": [*notes, *report.remarks],
    }


def _row(thing: Feature | Loss) -> dict[str, Any]:
    return {"what": thing.what.many, "count": thing.count, "names": list(thing.names)}


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
