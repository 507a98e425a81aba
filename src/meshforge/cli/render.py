"""`meshforge render`: a picture of an asset's hulls, or numbered pictures in which a person or a model names its
parts."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import typer

from meshforge import inspection, rendering
from meshforge.cli.console import progress
from meshforge.cli.options import AssetFile, InProject, LabelsPath, open_asset, refuse_with, takes
from meshforge.cli.terminal import remark
from meshforge.common import UsageError, escape_name, pluralize
from meshforge.symbolic import SymbolicMesh

_LABELLING = "labelling"

_SHEET_COLUMNS = 4  # a numbered picture and its plain one, twice


@dataclass(frozen=True, slots=True)
class RenderArguments:
    """What is typed after `meshforge render`."""

    context: typer.Context
    asset: AssetFile
    out: Annotated[
        Path | None,
        typer.Option("-o", "--out", help="The PNG or JPEG to write; for `--views labelling` it may be a folder."),
    ] = None
    turntable: Annotated[
        Path | None,
        typer.Option("--turntable", help="A GIF to write, in place of a picture: the camera goes once round."),
    ] = None
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
            "front-right-above, back-left-below and so on; or `labelling`: views chosen so that each hull is seen and "
            "numbered in one, each beside the asset as it looks.",
        ),
    ] = "iso"
    size: Annotated[
        str | None,
        typer.Option(
            "--size",
            help="Pixels of the picture, by default 900x700; for labelling of each, 1024x1024; of a turntable 480x400.",
        ),
    ] = None
    ghost: Annotated[bool, typer.Option("--ghost", help="Show the visual mesh as a ghost.")] = False
    names: Annotated[
        bool,
        typer.Option("--names", help="Write the names of hulls on them, or their numbers and a list of names below."),
    ] = False


@takes(RenderArguments)
def render(given: RenderArguments) -> None:
    """Draw an asset as a PNG or JPEG, or as a GIF that turns, one colour a hull or a label; needs no display."""
    if given.turntable:
        _write_turntable(given, given.turntable)
        return
    if given.out is None:
        raise UsageError("nothing says what to write", remedy="Give --out FILE.png, or --turntable FILE.gif.")
    if given.views.strip() == _LABELLING:
        other = f"--views {_LABELLING}, which has its own colours and numbers"
        refuse_with(given.context, ("color_by", "ghost", "names"), other)
        if _is_sheet(given.out):
            rendering.check_picture_path(given.out)
        side = _parse_side(given.size or "1024x1024")
        mesh = open_asset(given.asset, given.labels, given.project)
        with progress(None, "drawing"):
            wrote = write_part_pictures(mesh, given.out, side)
        remark(f"wrote {wrote}")
        return
    rendering.check_picture_path(given.out)  # before the asset is read, which may take its time
    mesh = open_asset(given.asset, given.labels, given.project)
    views, size = _parse_views(given.views), _parse_pixels(given.size or "900x700")
    with progress(None, "drawing"):
        inspection.render(
            mesh, given.out, views=views, color_by=given.color_by, size=size, ghost=given.ghost, names=given.names
        )
    remark(f"wrote {escape_name(str(given.out))}")


def _write_turntable(given: RenderArguments, path: Path) -> None:
    """Write the GIF. Raises UsageError for what does not go with one, and where it cannot be written."""
    refuse_with(given.context, ("out", "views", "ghost", "names"), "--turntable")
    if path.suffix.lower() != ".gif":
        raise UsageError("a turntable is a GIF", where=str(path), remedy="Give it a name that ends in .gif.")
    size = _parse_pixels(given.size or "480x400")
    mesh = open_asset(given.asset, given.labels, given.project)
    color_by = given.color_by or ("label" if mesh.labels else "hull")
    with progress(None, "drawing"):
        rendering.write_gif(
            path,
            [image for (image,) in rendering.draw_turn([mesh], rendering.list_turns(), size=size, color_by=color_by)],
        )
    remark(f"wrote {escape_name(str(path))}")


def _parse_side(text: str) -> int:
    width, height = _parse_pixels(text)
    if width != height:
        raise UsageError(f"pictures for labelling are square, {text} is not", remedy=f"Give --size {width}x{width}.")
    return width


def _parse_views(text: str) -> list[rendering.View]:
    known: dict[str, rendering.View] = {view: view for view in rendering.VIEWS}
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in known:
            raise UsageError(
                f"there is no view {name!r}", remedy=f"Views: {', '.join(rendering.VIEWS)}; or {_LABELLING}."
            )
    return [known[name] for name in names]


def _parse_pixels(text: str) -> tuple[int, int]:
    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdigit() and height.isdigit() and 16 <= int(width) <= 8192 and 16 <= int(height) <= 8192):
        raise UsageError(f"--size {text} is not a size", remedy="Give it as WIDTHxHEIGHT, for example 900x700.")
    return int(width), int(height)


def _is_sheet(out: Path) -> bool:
    """Whether all pictures for labelling go on one sheet, not each into a file of a folder."""
    return bool(out.suffix) and not out.is_dir()


def write_part_pictures(mesh: SymbolicMesh, out: Path, size: int) -> str:
    """Write what `shots` shows, on one sheet, or one by one where `out` is a folder or has no suffix.

    size: pixels along each picture's sides. Returns what is written, in words. Raises UsageError for a mesh without
    hulls, and where it cannot be written.
    """
    taken = rendering.draw_labeling_pictures(mesh, size=size)
    if not taken:
        raise UsageError(
            "there are no hulls to be named", remedy="`meshforge decompose` makes hulls, and `new --decompose` too."
        )
    if _is_sheet(out):
        rendering.write_picture(
            out,
            rendering.make_contact_sheet(
                [image for shot in taken for image in (shot.marked, shot.plain)], columns=_SHEET_COLUMNS
            ),
        )
        return f"{out}: {pluralize(len(taken), 'picture')}, each with its plain one"
    for k, shot in enumerate(taken, 1):
        stem = "-".join([f"{k:02}", *shot.name.replace(",", " ").split()])
        rendering.write_png(out / f"{stem}.png", shot.marked)
        rendering.write_png(out / f"{stem}-plain.png", shot.plain)
    return f"{pluralize(len(taken), 'picture')} to {out}, each with its plain one"
