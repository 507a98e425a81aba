"""`meshforge render`: a picture of an asset's hulls."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.opening import opened
from meshforge.cli.options import AssetFile, InProject, Labels

if TYPE_CHECKING:
    from meshforge.views import View


def render(
    asset: AssetFile,
    out: Annotated[Path, typer.Option("-o", "--out", help="The PNG to write.")],
    labels: Labels = None,
    project: InProject = None,
    color_by: Annotated[
        Literal["hull", "label", "body", "confidence"] | None,
        typer.Option("--color-by", help="Default: label where there are labels, else hull."),
    ] = None,
    views: Annotated[
        str, typer.Option("--views", help="Comma-separated: iso, iso-back, front, back, left, right, top, bottom.")
    ] = "iso",
    size: Annotated[str, typer.Option("--size", help="Pixels of the picture.")] = "900x700",
    ghost: Annotated[bool, typer.Option("--ghost", help="Show the visual mesh as a ghost.")] = False,
    names: Annotated[bool, typer.Option("--names", help="Number the hulls.")] = False,
) -> None:
    """Draw an asset as a PNG, one colour a hull or a label; needs no display."""
    from meshforge.cli.output import remark
    from meshforge.views import render as picture
    from meshforge.views import write_png

    mesh = opened(asset, labels, project)
    visuals = tuple(mesh.asset.visuals) if ghost and mesh.asset else None
    image = picture(
        mesh,
        views=_views(views),
        color_by=color_by or ("label" if mesh.labels else "hull"),
        size=_pixels(size),
        ghost=visuals,
        labels=names,
    )
    write_png(out, image)
    remark(f"wrote {out}")


def _views(text: str) -> list[View]:
    from meshforge.errors import UsageError
    from meshforge.views import VIEWS

    known: dict[str, View] = {view: view for view in VIEWS}
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in known:
            raise UsageError(f"there is no view {name!r}", remedy=f"Views: {', '.join(VIEWS)}.")
    return [known[name] for name in names]


def _pixels(text: str) -> tuple[int, int]:
    from meshforge.errors import UsageError

    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdigit() and height.isdigit() and 16 <= int(width) <= 8192 and 16 <= int(height) <= 8192):
        raise UsageError(f"--size {text} is not a size", remedy="Give it as WIDTHxHEIGHT, for example 900x700.")
    return int(width), int(height)
