"""`meshforge select`: what an extractor selects on an asset."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.options import AssetFile, Json, Labels


def select(
    expression: Annotated[str, typer.Argument(help="An extractor, for example 'Attach(Is(handle), Is(drawer))'.")],
    asset: AssetFile,
    labels: Labels = None,
    json: Json = False,
    picture: Annotated[Path | None, typer.Option("-o", "--out", help="A PNG with the selection lit.")] = None,
) -> None:
    """List the hulls that an extractor selects, in the frame the asset comes in."""
    from meshforge.cli.output import print_json, remark
    from meshforge.formats import load
    from meshforge.language import parse_extractor
    from meshforge.views import render, write_png

    mesh = load(asset, labels=labels)
    chosen = sorted(parse_extractor(expression).select(mesh))
    names = [mesh.hulls[k].name for k in chosen]
    if json:
        print_json({"hulls": names})
    else:
        for name in names:
            typer.echo(name)
        remark(f"{len(names)} of {len(mesh.hulls)} hulls")
    if picture:
        write_png(picture, render(mesh, highlight=frozenset(names)))
