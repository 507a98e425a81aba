"""`meshforge render`: a picture of an asset's hulls."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.opening import opened
from meshforge.cli.options import AssetFile, InProject, Labels
from meshforge.cli.part_pictures import write_part_pictures

if TYPE_CHECKING:
    from meshforge.views import View

_LABELLING = "labelling"


def render(
    asset: AssetFile,
    out: Annotated[
        Path, typer.Option("-o", "--out", help="The PNG to write; for `--views labelling` it may be a folder.")
    ],
    labels: Labels = None,
    project: InProject = None,
    color_by: Annotated[
        Literal["hull", "label", "body", "confidence"] | None,
        typer.Option("--color-by", help="Default: label where there are labels, else hull."),
    ] = None,
    views: Annotated[
        str,
        typer.Option(
            "--views",
            help="Comma-separated: iso, iso-back, front, back, left, right, top, bottom, and from a corner "
            "front-right-above, back-left-below and so on; or `labelling`: views chosen so that each hull is seen and "
            "numbered in one, each beside the asset as it looks.",
        ),
    ] = "iso",
    size: Annotated[
        str | None,
        typer.Option("--size", help="Pixels of the picture, by default 900x700; for labelling of each, 1024x1024."),
    ] = None,
    ghost: Annotated[bool, typer.Option("--ghost", help="Show the visual mesh as a ghost.")] = False,
    names: Annotated[bool, typer.Option("--names", help="Number the hulls.")] = False,
) -> None:
    """Draw an asset as a PNG, one colour a hull or a label; needs no display."""
    from meshforge.cli.output import remark
    from meshforge.views import render as picture
    from meshforge.views import write_png

    if views.strip() == _LABELLING:
        _check_labelling(color_by, ghost, names)
        side = _side(size or "1024x1024")
        remark(f"wrote {write_part_pictures(opened(asset, labels, project), out, side)}")
        return
    mesh = opened(asset, labels, project)
    visuals = tuple(mesh.asset.visuals) if ghost and mesh.asset else None
    image = picture(
        mesh,
        views=_views(views),
        color_by=color_by or ("label" if mesh.labels else "hull"),
        size=_pixels(size or "900x700"),
        ghost=visuals,
        labels=names,
    )
    write_png(out, image)
    remark(f"wrote {out}")


def _check_labelling(color_by: str | None, ghost: bool, names: bool) -> None:
    from meshforge.errors import UsageError

    for given, option in ((color_by, "--color-by"), (ghost, "--ghost"), (names, "--names")):
        if given:
            raise UsageError(
                f"{option} does not go with --views {_LABELLING}, which has its own colours and numbers",
                remedy="Leave it out.",
            )


def _side(text: str) -> int:
    from meshforge.errors import UsageError

    width, height = _pixels(text)
    if width != height:
        raise UsageError(f"pictures for labelling are square, {text} is not", remedy=f"Give --size {width}x{width}.")
    return width


def _views(text: str) -> list[View]:
    from meshforge.errors import UsageError
    from meshforge.views import VIEWS

    known: dict[str, View] = {view: view for view in VIEWS}
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in known:
            raise UsageError(f"there is no view {name!r}", remedy=f"Views: {', '.join(VIEWS)}; or {_LABELLING}.")
    return [known[name] for name in names]


def _pixels(text: str) -> tuple[int, int]:
    from meshforge.errors import UsageError

    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdigit() and height.isdigit() and 16 <= int(width) <= 8192 and 16 <= int(height) <= 8192):
        raise UsageError(f"--size {text} is not a size", remedy="Give it as WIDTHxHEIGHT, for example 900x700.")
    return int(width), int(height)
