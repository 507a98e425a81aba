"""`meshforge explain`: what a finding means, by its code or its rule."""

from typing import Annotated

import typer

from meshforge.common import UsageError, suggest_name
from meshforge.engines import CODES


def explain(
    code: Annotated[
        str | None, typer.Argument(metavar="[CODE]", help="A code such as MF204, or a rule; all codes without it.")
    ] = None,
) -> None:
    """Explain a finding by its code or rule, with why it matters, what to do and an example."""
    if code is None:
        typer.echo("\n".join(f"{row.code}  {row.title}" for row in CODES.values()))
        return
    by_name = {name: row for row in CODES.values() for name in (row.code, *row.rules)}
    found = by_name.get(code) or by_name.get(code.upper())
    if found is None:
        near = suggest_name(code.upper(), CODES) or suggest_name(code, by_name, "")
        raise UsageError(f"there is no code or rule {code!r}", remedy=f"{near} All: meshforge explain".lstrip())
    typer.echo(f"{found.code}: {found.title}\n  rules: {', '.join(found.rules)}\n  why: {found.why}")
    typer.echo(f"  what to do: {found.remedy}\n  example: {found.example}")
