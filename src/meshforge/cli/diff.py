"""`meshforge diff`: what an edit changed."""

from pathlib import Path
from typing import Annotated

import typer

from meshforge import inspection
from meshforge.cli.console import progress
from meshforge.cli.options import Json
from meshforge.cli.terminal import print_json, remark


def diff(
    before: Annotated[Path, typer.Argument(help="The asset as it was.")],
    after: Annotated[Path, typer.Argument(help="The asset as it is now.")],
    out: Annotated[
        Path | None, typer.Option("-o", "--out", help="A picture: before beside after, with what changed marked.")
    ] = None,
    json: Json = False,
) -> None:
    """Compare two assets hull by hull: removed, made, changed, kept, with counts and volumes."""
    with progress(None, "comparing"):
        found = inspection.diff(before, after, out)
    if out:
        remark(f"wrote {out}")
    if json:
        print_json({"before": str(before), "after": str(after), **found.to_json()})
    else:
        typer.echo(str(found))
