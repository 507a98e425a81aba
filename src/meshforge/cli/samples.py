"""`meshforge samples`: families of assets to try MeshForge on."""

from pathlib import Path
from typing import Annotated

import typer

from meshforge.common import UsageError, pluralize, quote_path
from meshforge.samples import FAMILIES, family_of, write_family


def samples(
    family: Annotated[str | None, typer.Argument(help="A family, as the list has it.", show_default=False)] = None,
    folder: Annotated[
        Path | None, typer.Argument(metavar="DIR", help="The folder to write to, new or empty.", show_default=False)
    ] = None,
) -> None:
    """Write a family of assets to try things on, with labels beside them; without arguments, list the families.

    Files that are there already must be the same; nothing is replaced.
    """
    if family is None:
        width = max(len(known.name) for known in FAMILIES)
        for known in FAMILIES:
            typer.echo(f"{known.name:{width}}  {known.about}")
        typer.echo("Write one with: meshforge samples FAMILY DIR")
        return
    wanted = family_of(family)
    if folder is None:
        raise UsageError("there is no folder to write to", remedy=f"meshforge samples {wanted.name} DIR")
    written = write_family(wanted, folder)
    done = f"wrote {pluralize(written, 'file')}" if written else "all files are there already"
    typer.echo(f"{folder}: {wanted.about}; {done}")
    typer.echo(f"Next: meshforge new {wanted.name} {quote_path(folder.absolute() / wanted.pattern)}")
