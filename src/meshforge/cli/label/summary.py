"""What a project's labels are by now: a table of where they come from and how sure they are, and pictures of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from meshforge.cli.label.report import LabelReport
    from meshforge.project import Project, Tally

_SHOWN = 24
"""Assets on the sheet that is made without being asked for: those with most that is in doubt."""
_SAID = {
    "user": "people",
    "repair": "people, repairs confirmed",
    "file": "files",
    "name": "names",
    "propagated": "carried over",
    "vlm": "a model",
    "edit": "edits",
}


def summarise(project: Project, sheets: Path | None, page: LabelReport | None, *, json: bool) -> None:
    """Print how many labels there are, and write contact sheets; sheets: a folder for those of all assets.

    page: a report that is to be written, too.
    """
    from meshforge.cli.output import print_json, progress

    found = project.tally_labels()
    folder = sheets or project.folder / "pictures"
    order = list(dict.fromkeys([*(asset for asset, _ in found.doubtful), *project.assets()]))
    shown = project.assets() if sheets else order[:_SHOWN]
    with progress(len(shown), "drawing") as advance:
        written = project.draw_labels(folder, shown, advance)
    some = "" if len(shown) == len(project.assets()) else f", the {len(shown)} assets with most that is in doubt"
    if json:
        print_json({"labels": asdict(found), "sheets": [str(path) for path in written]}, compact=True)
    else:
        _say(found, written, some)
    if page:
        page.write(project, found)


def _say(found: Tally, written: Sequence[Path], some: str) -> None:
    _print(found)
    for path in written[:1]:
        more = f" and {len(written) - 1} more" if len(written) > 1 else ""
        typer.echo(f"pictures: {path}{more}{some}")


def _print(found: Tally) -> None:
    from meshforge.cli.output import table

    rows = [(_SAID[share.source], share.sure, share.likely, share.unsure) for share in found.shares]
    columns = ("labels from", "sure", "likely", "unsure")
    typer.echo()
    table(columns, [*rows, ("no label", "", "", found.unlabelled)], right=columns[1:])
    typer.echo()
