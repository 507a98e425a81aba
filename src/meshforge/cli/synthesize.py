"""`meshforge synthesize`: learn the program of a project from its demonstrations."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal

import typer

from meshforge import synthesis
from meshforge.cli import synthesize_text
from meshforge.cli.console import progress
from meshforge.cli.options import Json, takes
from meshforge.cli.terminal import catch_interrupt, print_json, remark
from meshforge.common import UsageError
from meshforge.labels import propose_class_names
from meshforge.project import learn_program, select_assets
from meshforge.store import MeshCache, Store


@dataclass(frozen=True, slots=True)
class SynthesizeArguments:
    """What is typed after `meshforge synthesize`."""

    project: Annotated[Path, typer.Argument(help="A project folder.")]
    strategy: Annotated[
        Literal["default", "paper"], typer.Option("--strategy", help="paper: by the algorithms of the paper.")
    ] = "default"
    layers: Annotated[
        Literal["S", "S+T", "S+G", "S+T+G"],
        typer.Option("--layers", help="What rules may ask for: labels (S), touching (T), directions (G)."),
    ] = "S+T+G"
    extractors: Annotated[
        list[str] | None,
        typer.Option("--with", help="A plug-in's extractor that rules may use from now on.", metavar="NAME"),
    ] = None
    no_repair: Annotated[bool, typer.Option("--no-repair", help="Take all labels for right.")] = False
    budget: Annotated[float, typer.Option("--budget", min=0.1, help="Seconds to search.")] = 120.0
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Show what is learned; keep nothing.")] = False
    json: Json = False


@takes(SynthesizeArguments)
def synthesize(given: SynthesizeArguments) -> None:
    """Learn the smallest program that does on every demonstrated asset what was shown there.

    Ctrl-C ends the search. Exit code 1 when no program was found; then the nearest one is named, and where it differs.
    What the demonstrations leave open, and labels that are probably wrong, `meshforge review` asks about.
    """
    project = replace(Store.open(given.project), cache=MeshCache())
    asked = tuple(given.extractors or ())
    if asked and given.strategy == "paper":
        raise UsageError("--with does not go with --strategy paper, which knows the extractors of the paper only")
    if asked and not given.dry_run:
        project.add_extractors(asked)
    options = synthesis.Options(
        extractors=asked if given.dry_run else (),
        strategy=given.strategy,
        layers=given.layers,
        repair=not given.no_repair,
        budget=given.budget,
    )
    meshes = dict(project.meshes_by_id(select_assets(project)))
    with progress(None, "learning"), catch_interrupt() as stop:
        outcome = learn_program(project, accept=not given.dry_run, options=options, stop=stop, meshes=meshes)
        stopped = stop()
    if given.json:
        print_json(synthesis.outcome_to_json(outcome))
    else:
        feedback = project.feedback()
        _print_outcome(
            outcome,
            synthesize_text.LearningContext(
                given.project,
                assets=len(project.assets()),
                in_use=len(select_assets(project)),
                readable=len(meshes),
                answers=len(feedback.answers) - len(outcome.stale),
                repairs=sum(fix.accepted for fix in feedback.fixes.values()),
                kept=not given.dry_run,
                stopped=stopped,
                classes=propose_class_names(project),
            ),
        )
    raise typer.Exit(int(outcome.program is None))


def _print_outcome(outcome: synthesis.LearningOutcome, about: synthesize_text.LearningContext) -> None:
    typer.echo(synthesize_text.format_result(outcome, about))
    more = synthesize_text.format_remarks(outcome, about)
    if more:
        remark(f"\n{more}")
