"""`meshforge label`: labels for the hulls of a project."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.options import Json

if TYPE_CHECKING:
    from meshforge.project import Labelled, Project


def label(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    source: Annotated[
        Literal["file", "names", "propagate"],
        typer.Option(
            "--with",
            help="Where labels come from: file takes over labels files, names reads them off the names of hulls and "
            "bodies, propagate carries those of a few assets to all others.",
        ),
    ] = "file",
    labels: Annotated[
        Path | None,
        typer.Option("--labels", help="A labels file, or a folder that mirrors the assets; default: beside each."),
    ] = None,
    vocabulary: Annotated[str, typer.Option("--vocabulary", help="Set the labels that hulls can have: a,b,c.")] = "",
    sheets: Annotated[
        Path | None,
        typer.Option(
            "--sheets",
            help="A folder for contact sheets of all assets; without it, one of those with most that is in doubt is "
            "written into the project's `pictures`.",
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Give labels to hulls; what a person labelled is never overwritten by a machine.

    Exit code 1 when some labels could not be taken (each named).
    """
    from meshforge.cli.label_summary import summarise
    from meshforge.cli.output import print_json
    from meshforge.errors import UsageError
    from meshforge.project import Project

    if labels and source != "file":
        raise UsageError(f"--labels names labels files, which --with {source} does not read", remedy="Leave one out.")
    opened = Project.open(project)
    if vocabulary:
        opened.set_vocabulary([word.strip() for word in vocabulary.split(",") if word.strip()])
    reports, closing = _labelled(opened, source, labels)
    for report in reports:
        if json:
            print_json(asdict(report), compact=True)
            continue
        typer.echo(f"{report.asset}: {_told(report)}")
        for problem in report.problems:
            typer.echo(f"    left out: {problem}")
    summarise(opened, sheets, json=json)
    if closing and not json:
        typer.echo(closing)
    raise typer.Exit(int(any(report.problems for report in reports)))


def _labelled(project: Project, source: str, labels: Path | None) -> tuple[Sequence[Labelled], str]:
    """What became of the labels of each asset, and a closing sentence."""
    from meshforge.cli.output import progress
    from meshforge.words import counted

    match source:
        case "names":
            return project.label_from_names(), ""
        case "propagate":
            with progress(len(project.assets()), "reading") as advance:
                carried = project.propagate_labels(progress=advance)
            helpful = f"If some are wrong, label or correct this one next: {carried.next}" if carried.next else ""
            return carried.reports, helpful
        case _:
            reports = project.label_from_files(labels)
            bare = len(project.assets()) - len(reports)
            return reports, f"{counted(bare, 'asset')} without a labels file" if bare else ""


def _told(report: Labelled) -> str:
    from meshforge.words import counted

    parts = [f"{counted(report.taken, 'label')} taken"]
    parts += [f"{report.same} there already"] if report.same else []
    parts += [f"{report.kept} kept as a person gave them"] if report.kept else []
    parts += [f"{report.unsure} unsure"] if report.unsure else []
    parts += [f"{counted(report.unlabelled, 'hull')} without a label"] if report.unlabelled else []
    return ", ".join(parts)
