"""`meshforge synthesize`: learn the program of a project from its demonstrations."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from meshforge.cli.options import Json

if TYPE_CHECKING:
    from meshforge.synthesis import Nearest, Outcome


def synthesize(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    budget: Annotated[float, typer.Option("--budget", min=0.1, help="Seconds to search.")] = 120.0,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Show the program, do not keep it.")] = False,
    json: Json = False,
) -> None:
    """Learn the smallest program that does on every demonstrated asset what was shown there.

    Exit code 1 when no program was found; then the nearest one is named, and where it differs.
    """
    from meshforge.cli.output import print_json
    from meshforge.project import Project
    from meshforge.synthesis import Ambiguous, Found, Options, outcome_json

    outcome = Project.open(project).synthesize(accept=not dry_run, options=Options(budget=budget))
    if json:
        print_json(outcome_json(outcome))
    else:
        _print(outcome, project, dry_run)
    raise typer.Exit(int(not isinstance(outcome, Found | Ambiguous)))


def _print(outcome: Outcome, project: Path, dry_run: bool) -> None:
    from typing import assert_never

    from meshforge.cli.output import remark
    from meshforge.synthesis import Ambiguous, Found, NeedsRepair, NoProgram, TimedOut

    match outcome:
        case Found():
            typer.echo(str(outcome.program), nl=False)
            took = f"learned in {sum(outcome.seconds.values()):.2f} s"
            remark(took if dry_run else f"\n{took}, kept as {project / 'program.mf'}\nNext: meshforge apply {project}")
        case NoProgram():
            typer.echo(f"no program found: {outcome.why}\n{_told(outcome.nearest)}")
        case TimedOut():
            typer.echo("the time ran out; --budget SECONDS gives more")
            for rule in outcome.rules:
                typer.echo(f"  learned: {rule}")
            if outcome.nearest:
                typer.echo(_told(outcome.nearest))
        case Ambiguous() | NeedsRepair():
            typer.echo(str(outcome.program))
        case _:
            assert_never(outcome)


def _told(nearest: Nearest) -> str:
    from meshforge.language import show

    lines = [f"nearest for rule {nearest.rule}: {show(nearest.extractor)}; on {nearest.asset} it"]
    lines += [f"  selects too much: {', '.join(nearest.extra)}"] if nearest.extra else []
    lines += [f"  leaves out:       {', '.join(nearest.missing)}"] if nearest.missing else []
    lines += ["Look at the labels of these hulls (meshforge info), or at what was demonstrated there."]
    return "\n".join(lines)
