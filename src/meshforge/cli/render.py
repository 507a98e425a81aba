"""`meshforge render`: a picture of an asset's hulls."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.options import AssetFile, Labels


class ColorBy(StrEnum):
    """What the colours of a picture mean."""

    HULL = "hull"
    LABEL = "label"
    BODY = "body"
    CONFIDENCE = "confidence"


def render(
    asset: AssetFile,
    out: Annotated[Path, typer.Option("-o", "--out", help="The PNG to write.")],
    labels: Labels = None,
    color_by: Annotated[
        ColorBy | None, typer.Option("--color-by", help="Default: label where there are labels, else hull.")
    ] = None,
    views: Annotated[
        str, typer.Option("--views", help="Comma-separated: iso, iso-back, front, back, left, right, top, bottom.")
    ] = "iso",
    size: Annotated[str, typer.Option("--size", help="Pixels of one view.")] = "900x700",
    ghost: Annotated[bool, typer.Option("--ghost", help="Show the visual mesh as a ghost.")] = False,
    names: Annotated[bool, typer.Option("--names", help="Number the hulls.")] = False,
) -> None:
    """Draw an asset as a PNG, one colour a hull or a label; needs no display."""
    from meshforge.cli.output import remark
    from meshforge.formats import load
    from meshforge.views import render as picture
    from meshforge.views import write_png

    mesh = load(asset, labels=labels)
    chosen = color_by.value if color_by else ("label" if mesh.labels else "hull")
    visuals = mesh.asset.visuals if ghost and mesh.asset else ()
    image = picture(
        mesh,
        views=tuple(name.strip() for name in views.split(",")),
        color_by=chosen,
        size=_pixels(size),
        ghost=visuals,
        labels=names,
    )
    write_png(out, image)
    remark(f"wrote {out}")


def _pixels(text: str) -> tuple[int, int]:
    from meshforge.errors import UsageError

    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdigit() and height.isdigit() and 16 <= int(width) <= 8192 and 16 <= int(height) <= 8192):
        raise UsageError(f"--size {text} is not a size", remedy="Give it as WIDTHxHEIGHT, for example 900x700.")
    return int(width), int(height)
