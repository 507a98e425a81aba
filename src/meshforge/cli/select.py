"""`meshforge select`: what an extractor selects on an asset."""

from collections.abc import Collection
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.hulls import find_absent_labels, labels_of_project
from meshforge.cli.options import AssetFile, InProject, Json, LabelsPath, open_asset
from meshforge.cli.terminal import print_json, remark
from meshforge.common import escape_name
from meshforge.formats import labels_beside, resolve_asset_path
from meshforge.language import parse_extractor
from meshforge.symbolic import read_labels


def select(
    expression: Annotated[str, typer.Argument(help="An extractor, for example 'Attach(Is(handle), Is(drawer))'.")],
    asset: AssetFile,
    labels: LabelsPath = None,
    project: InProject = None,
    json: Json = False,
    picture: Annotated[Path | None, typer.Option("-o", "--out", help="A picture with the selection lit.")] = None,
) -> None:
    """List the hulls that an extractor selects, in the frame the asset comes in."""
    if picture:
        from meshforge.rendering import check_picture_path, render, write_picture  # lazy: 40 modules of a picture

        check_picture_path(picture)
    mesh = open_asset(asset, labels, project)
    extractor = parse_extractor(expression)
    absent = find_absent_labels(extractor, mesh, partial(_read_known_labels, asset, labels, project), str(asset))
    chosen = sorted(extractor.select(mesh))
    names = [mesh.hulls[k].name for k in chosen]
    if picture:
        write_picture(picture, render(mesh, highlight=frozenset(names)))
    if json:
        print_json({"hulls": names})
    else:
        for name in names:
            typer.echo(escape_name(name))
        remark(f"{len(names)} of {len(mesh.hulls)} hulls")
    for label in absent:
        remark(f"no hull here is labelled {label!r}")


def _read_known_labels(asset: Path, labels: Path | None, project: Path | None) -> Collection[str]:
    if project:
        from meshforge.project import Project  # lazy: 500 modules that only --project needs

        return labels_of_project(Project.open(project))
    path = labels or labels_beside(resolve_asset_path(asset))
    return read_labels(path).vocabulary if path.is_file() else ()
