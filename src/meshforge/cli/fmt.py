"""`meshforge fmt`: a program in its canonical form."""

from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.terminal import print_exact
from meshforge.common import write_atomically
from meshforge.language import Program


def fmt(
    program: Annotated[Path, typer.Argument(help="A program file, *.mf.")],
    in_place: Annotated[bool, typer.Option("--in-place", "-i", help="Rewrite the file instead of printing.")] = False,
    check: Annotated[bool, typer.Option("--check", help="Only say, by exit code 1, whether it would change.")] = False,
) -> None:
    """Print a program in its canonical form, comments kept."""
    text = str(Program.read(program))
    changed = text != program.read_text(encoding="utf-8")
    if check:
        typer.echo(f"{program}: {'would change' if changed else 'canonical'}")
        raise typer.Exit(int(changed))
    if not in_place:
        print_exact(text)
    elif changed:
        write_atomically(program, text)
