"""`meshforge decompose`: any mesh into convex hulls."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from meshforge import formats
from meshforge.cli import options
from meshforge.cli.console import fold_notes, progress
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, escape_name, pluralize
from meshforge.geometry import DecomposeSettings

_PICTURE = "advice.png"
_PICTURES = (".png", ".jpg", ".jpeg")
_OF_POINTS = ("classes", "align")


@dataclass(frozen=True, slots=True)
class DecomposeArguments:
    """What is typed after `meshforge decompose`."""

    context: typer.Context
    mesh: Annotated[Path, typer.Argument(help="A mesh file: OBJ, STL, PLY, DAE, GLB.")]
    out: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--out",
            help="The file of hulls to write; its suffix names the format. With --advise a picture, or its folder.",
        ),
    ] = None
    method: Annotated[options.EngineMethod, typer.Option("--decompose", help="The engine.")] = (
        options.EngineMethod.COACD
    )
    option: options.EngineOptions = None
    max_vertices: options.MaxVertices = None
    by: options.By = "whole"
    labels: Annotated[
        Path | None,
        typer.Option(
            "--labels",
            help="With --by labels or --advise: the file of segmented points, if not the one beside the mesh.",
            show_default=False,
        ),
    ] = None
    classes: Annotated[
        str,
        typer.Option(
            "--classes", help="The names of classes 0, 1, ... of segmented points: a,b,c.", show_default=False
        ),
    ] = ""
    align: options.Align = None
    advise: Annotated[
        bool,
        typer.Option(
            "--advise",
            help="Write no hulls: print what three settings come to, as a whole and by parts, and draw them.",
        ),
    ] = False
    hollow: options.Hollow = False
    timeout: options.Seconds = None
    cache: Annotated[bool, typer.Option("--cache/--no-cache", help="Keep results, and use kept ones.")] = True
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace the file if it is there.")] = False
    json: options.Json = False


@options.takes(DecomposeArguments)
def decompose(given: DecomposeArguments) -> None:
    """Decompose a mesh into convex hulls by CoACD or V-HACD; the same input gives the same hulls."""
    settings = options.parse_engine_settings(given.method, given.option, given.max_vertices)
    if given.by != "labels" and not given.advise:
        options.refuse_options(given.context, ("labels", *_OF_POINTS), "--by labels")
    if given.advise:
        options.refuse_with(given.context, ("by",), "--advise, which tries both")
        options.refuse_hull(given.method, "--advise")
        if given.labels is None:
            options.refuse_options(given.context, _OF_POINTS, "--labels FILE")
        _advise(given, settings)
        return
    options.refuse_options(given.context, ("json",), "--advise")
    if given.out is None:
        raise UsageError("nothing says what to write", remedy="Give --out FILE, or --advise for advice on settings.")
    with progress(None, f"{given.method.value} on {given.mesh.name}") as shown:
        made = formats.decompose(
            given.mesh,
            settings,
            by=given.by,
            labels=_segmentation_of(given),
            hollow=given.hollow,
            timeout=given.timeout,
            cache=given.cache,
            progress=shown.show,
        )
    saved = formats.save(made, given.out, overwrite=given.overwrite)
    for note in fold_notes((*(made.asset.notes if made.asset else ()), *saved.notes)):
        remark(f"note: {note}")
    remark(f"wrote {escape_name(str(saved.path))}: {pluralize(len(made.hulls), 'hull')}")


def _advise(given: DecomposeArguments, settings: DecomposeSettings) -> None:
    from meshforge.inspection import advise_decomposition  # lazy: most runs of this command draw nothing

    picture = _picture_path(given.out, given.overwrite)
    with progress(None, f"{given.method.value} on {given.mesh.name}") as shown:
        advice = advise_decomposition(
            given.mesh,
            settings,
            hollow=given.hollow,
            labels=_segmentation_of(given),
            timeout=given.timeout,
            cache=given.cache,
            progress=shown.show,
        )
    if given.json:
        print_json(advice.to_json())
    else:
        typer.echo("\n".join(advice.describe()))
    if picture:
        from meshforge.rendering import write_picture  # lazy: as above

        picture.parent.mkdir(parents=True, exist_ok=True)
        write_picture(picture, advice.draw())
        remark(f"wrote {picture}")


def _segmentation_of(given: DecomposeArguments) -> formats.SegmentationFile | None:
    """The file that says what the parts are; None where no parts by labels are asked for, or no file is beside the
    mesh, which is an error then."""
    beside = formats.points_beside(formats.labels_beside(given.mesh)) if given.by == "labels" else None
    path = given.labels or beside
    classes = tuple(options.split_words(given.classes))
    return formats.SegmentationFile(path, classes, given.align or "check") if path else None


def _picture_path(out: Path | None, overwrite: bool) -> Path | None:
    """Where the picture goes: a file, or one in a folder. Raises UsageError for another kind of file, or one there."""
    if out is None:
        return None
    if out.suffix and out.suffix.lower() not in _PICTURES and not out.is_dir():
        raise UsageError("--advise writes a picture, no hulls", where=str(out), remedy="Give -o FILE.png or a folder.")
    path = out if out.suffix.lower() in _PICTURES else out / _PICTURE
    if path.exists() and not overwrite:
        raise UsageError("the file is there already", where=str(path), remedy="Give another name, or --overwrite.")
    return path
