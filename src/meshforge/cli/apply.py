"""`meshforge apply`: run a program on many assets, or a project's program on its own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.options import Json, Labels, Workers

if TYPE_CHECKING:
    from meshforge.batch import Outcome


def apply(
    program: Annotated[Path, typer.Argument(help="A program file (*.mf) or a project folder.")],
    assets: Annotated[list[str] | None, typer.Argument(help="Files, folders or globs; not with a project.")] = None,
    out: Annotated[
        Path | None, typer.Option("-o", "--out", help="Folder for the edited assets; a project has its own, edited/.")
    ] = None,
    labels: Labels = None,
    workers: Workers = None,
    mass: Annotated[
        Literal["keep", "recompute"], typer.Option("--mass", help="Masses that a format derives from geometry.")
    ] = "keep",
    link: Annotated[bool, typer.Option("--link", help="Hard-link files that are only copied.")] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Say what would be done, write nothing.")] = False,
    fresh: Annotated[bool, typer.Option("--fresh", help="Do again what an earlier run has done.")] = False,
    json: Json = False,
) -> None:
    """Run a program on assets; each goes back into its own format below --out, labels beside it.

    Exit code 1 when some assets failed: they are named, and the others are done.
    """
    from meshforge.batch import Failed, json_line
    from meshforge.cli.output import print_json, progress

    options = {"workers": workers, "mass": mass, "link": link, "dry_run": dry_run, "resume": not fresh}
    work = _of_project(program, assets, labels) if program.is_dir() else _of_program(program, assets, out, labels)
    outcomes = []
    with progress(work.total, "editing") as advance:
        for outcome in work.run(out=out, progress=advance, **options):
            outcomes.append(outcome)
            if json:
                print_json(json_line(outcome), compact=True)
    if not json:
        report(outcomes, dry_run=dry_run)
    raise typer.Exit(int(any(isinstance(outcome, Failed) for outcome in outcomes)))


@dataclass(frozen=True, slots=True)
class _Work:
    """How many assets there are, and what runs the program on them."""

    total: int
    run: Callable[..., Iterator[Outcome]]


def _of_project(folder: Path, assets: list[str] | None, labels: Path | None) -> _Work:
    from meshforge.errors import UsageError
    from meshforge.project import Project

    if assets or labels:
        raise UsageError(
            "a project has its own assets and labels",
            remedy=f"For other assets: meshforge apply {folder / 'program.mf'} ASSETS... --out DIR",
        )
    project = Project.open(folder)
    return _Work(len(project.assets()), project.apply)


def _of_program(path: Path, assets: list[str] | None, out: Path | None, labels: Path | None) -> _Work:
    from meshforge.batch import apply as run
    from meshforge.batch import expand, jobs, load_templates, template_folders
    from meshforge.errors import UsageError
    from meshforge.language import Program

    if not assets or out is None:
        lacking = "assets" if not assets else "--out DIR"
        raise UsageError(f"{lacking} is missing", remedy="meshforge apply PROGRAM ASSETS... --out DIR")
    program = Program.read(path)
    templates = load_templates(program, template_folders(path))
    work = jobs(expand(assets), labels)
    return _Work(len(work), partial(run, program, work, templates=templates))


def report(outcomes: Sequence[Outcome], *, dry_run: bool = False) -> None:
    """One line an asset, then the counts."""
    from meshforge.batch import Failed, status
    from meshforge.words import counted

    for outcome in outcomes:
        if isinstance(outcome, Failed):
            typer.echo(f"failed     {outcome.asset}\n    " + outcome.error.replace("\n", "\n    "))
            continue
        typer.echo(f"{status(outcome):10} {outcome.asset}: {outcome.before} -> {counted(outcome.after, 'hull')}")
        for line in (*(f"rule {r.rule}: {r.note}" for r in outcome.rules if r.note), *outcome.notes, *outcome.flags):
            typer.echo(f"    note: {line}")
    done = [outcome for outcome in outcomes if not isinstance(outcome, Failed)]
    counts = Counter(status(outcome) for outcome in outcomes)
    typer.echo(
        f"{counted(len(outcomes), 'asset')}: {', '.join(f'{n} {word}' for word, n in counts.items())}; "
        f"hulls {sum(o.before for o in done)} -> {sum(o.after for o in done)}"
        + (" (nothing was written)" if dry_run else "")
    )
