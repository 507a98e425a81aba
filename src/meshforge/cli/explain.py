"""`meshforge explain`: what a finding means, by its code or its rule."""

from typing import Annotated

import typer

from meshforge.common import UsageError, suggest_name
from meshforge.engines.codes import CODES, RuleCode


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
    typer.echo(_describe_code(found))


def _describe_code(row: RuleCode) -> str:
    return "\n".join(
        [
            f"{row.code}: {row.title}",
            f"  rule{'s' * (len(row.rules) > 1)}: {', '.join(row.rules)}",
            f"  why: {row.why}",
            f"  what to do: {row.remedy}",
            f"  example: {row.example}",
        ]
    )
