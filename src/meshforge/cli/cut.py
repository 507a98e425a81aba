"""`meshforge cut`: one hull of an asset made two along a plane, before any program sees it."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli import options
from meshforge.cli.hulls import LISTING, find_hulls, is_number
from meshforge.cli.prepare import print_results
from meshforge.common import UsageError
from meshforge.project import Project


@dataclass(frozen=True, slots=True)
class CutArguments:
    """What is typed after `meshforge cut`."""

    project: Annotated[Path, typer.Argument(help="A project folder.")]
    asset: Annotated[str, typer.Argument(help="The id of an asset, as `status` lists it.")]
    hull: Annotated[
        str, typer.Argument(help="A hull by its name or number (#5), as `info ASSET --project PROJECT` lists it.")
    ]
    at: Annotated[
        str, typer.Option("--at", metavar="X,Y,Z", help="A point of the cutting plane [m], in the asset's own frame.")
    ]
    across: Annotated[
        str, typer.Option("--across", metavar="X,Y,Z", help="The direction across the plane; part #1 is on that side.")
    ]
    json: options.Json = False


@options.takes(CutArguments)
def cut(given: CutArguments) -> None:
    """Cut a hull in two along a plane.

    The plane is given in metres in the frame that the asset comes in (root frame, joints at zero), as `info` shows it.
    The parts are called HULL#0 and HULL#1 and take over its label. Take it back with: meshforge prepare --undo.
    To make all hulls of bodies anew in which hulls span parts: meshforge prepare --rebuild-spanning.
    """
    project = Project.open(given.project)
    asset = options.asset_id(given.asset, project)
    hull = given.hull
    if is_number(hull):
        (hull,) = find_hulls(hull, project.mesh(asset).index, "HULL", f"{LISTING} --project {given.project}")
    result = project.cut(asset, hull, _parse_vector(given.at, "--at"), _parse_vector(given.across, "--across"))
    print_results(project, [result], given.json)


def _parse_vector(text: str, option: str) -> tuple[float, float, float]:
    try:
        x, y, z = map(float, text.split(","))
    except ValueError:
        raise UsageError(f"{option} {text}: three numbers are needed, with commas between") from None
    return x, y, z
