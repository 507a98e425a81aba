"""`meshforge render`: a picture of an asset's hulls."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, cast

import typer

from meshforge import inspection, rendering
from meshforge.cli.console import progress
from meshforge.cli.options import AssetFile, InProject, LabelsPath, open_asset, takes
from meshforge.cli.terminal import remark
from meshforge.common import UsageError, escape_name


@dataclass(frozen=True, slots=True)
class RenderArguments:
    """What is typed after `meshforge render`."""

    context: typer.Context
    asset: AssetFile
    out: Annotated[Path | None, typer.Option("-o", "--out", help="The PNG or JPEG to write.")] = None
    labels: LabelsPath = None
    project: InProject = None
    color_by: Annotated[
        Literal["hull", "label", "body"] | None,
        typer.Option("--color-by", help="Default: label where there are labels, else hull."),
    ] = None
    views: Annotated[
        str,
        typer.Option(
            "--views",
            help="Comma-separated: iso, iso-back, front, back, left, right, top, bottom, and from a corner "
            "front-right-above, back-left-below and so on.",
        ),
    ] = "iso"
    size: Annotated[str, typer.Option("--size", help="Pixels of the picture.")] = "900x700"
    ghost: Annotated[bool, typer.Option("--ghost", help="Show the visual mesh as a ghost.")] = False
    names: Annotated[
        bool,
        typer.Option("--names", help="Write the names of hulls on them, or their numbers and a list of names below."),
    ] = False


@takes(RenderArguments)
def render(given: RenderArguments) -> None:
    """Draw an asset as a PNG or JPEG, one colour a hull or a label; needs no display."""
    if given.out is None:
        raise UsageError("nothing says what to write", remedy="Give --out FILE.png.")
    rendering.check_picture_path(given.out)  # before the asset is read, which may take its time
    mesh = open_asset(given.asset, given.labels, given.project)
    size = _parse_pixels(given.size)
    views = cast(list[rendering.View], [name.strip() for name in given.views.split(",")])  # which are checked below
    with progress(None, "drawing"):
        inspection.render(
            mesh, given.out, views=views, color_by=given.color_by, size=size, ghost=given.ghost, names=given.names
        )
    remark(f"wrote {escape_name(str(given.out))}")


def _parse_pixels(text: str) -> tuple[int, int]:
    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdecimal() and height.isdecimal()):
        raise UsageError(f"--size {text} is not a size", remedy="Give it as WIDTHxHEIGHT, for example 900x700.")
    return int(width), int(height)
