"""`meshforge select`: what an extractor selects on an asset."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.options import AssetFile, InProject, Json, LabelsPath, open_asset
from meshforge.cli.terminal import print_json, remark
from meshforge.common import suggest_among
from meshforge.language import labels_of, parse_extractor


def select(
    expression: Annotated[str, typer.Argument(help="An extractor, for example 'Attach(Is(handle), Is(drawer))'.")],
    asset: AssetFile,
    labels: LabelsPath = None,
    project: InProject = None,
    json: Json = False,
    picture: Annotated[Path | None, typer.Option("-o", "--out", help="A PNG with the selection lit.")] = None,
) -> None:
    """List the hulls that an extractor selects, in the frame the asset comes in."""
    mesh = open_asset(asset, labels, project)
    extractor = parse_extractor(expression)
    here = sorted({hull.label for hull in mesh.hulls if hull.label})
    for label in labels_of(extractor):
        if label not in here:  # an asset need not have every label of its family, so this is no error
            remark(f"no hull here is labelled {label!r}. {suggest_among(label, here, 'Labels here:')}")
    chosen = sorted(extractor.select(mesh))
    names = [mesh.hulls[k].name for k in chosen]
    if picture:
        from meshforge.rendering import render, write_png  # lazy: 40 modules that only a picture needs

        write_png(picture, render(mesh, highlight=frozenset(names)))
    if json:
        print_json({"hulls": names})
    else:
        for name in names:
            typer.echo(name)
        remark(f"{len(names)} of {len(mesh.hulls)} hulls")
