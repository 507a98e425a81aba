"""`meshforge label`: labels for the hulls of a project."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.options import Json

if TYPE_CHECKING:
    from meshforge.project import Labelled


def label(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    source: Annotated[
        Literal["file"], typer.Option("--with", help="Where labels come from: file takes over labels files.")
    ] = "file",
    labels: Annotated[
        Path | None,
        typer.Option("--labels", help="A labels file, or a folder that mirrors the assets; default: beside each."),
    ] = None,
    vocabulary: Annotated[str, typer.Option("--vocabulary", help="Set the labels that hulls can have: a,b,c.")] = "",
    json: Json = False,
) -> None:
    """Give labels to hulls; what a person labelled is never overwritten by a machine.

    Exit code 1 when some labels could not be taken (each named).
    """
    from meshforge.cli.output import print_json
    from meshforge.project import Project
    from meshforge.words import counted

    opened = Project.open(project)
    if vocabulary:
        opened.set_vocabulary([word.strip() for word in vocabulary.split(",") if word.strip()])
    reports = opened.label_from_files(labels)
    for report in reports:
        if json:
            print_json(asdict(report), compact=True)
            continue
        typer.echo(f"{report.asset}: {_told(report)}")
        for problem in report.problems:
            typer.echo(f"    left out: {problem}")
    bare = len(opened.assets()) - len(reports)
    if bare and not json:
        typer.echo(f"{counted(bare, 'asset')} without a labels file")
    raise typer.Exit(int(any(report.problems for report in reports)))


def _told(report: Labelled) -> str:
    from meshforge.words import counted

    parts = [f"{counted(report.taken, 'label')} taken"]
    parts += [f"{report.same} there already"] if report.same else []
    parts += [f"{report.kept} kept as a person gave them"] if report.kept else []
    parts += [f"{counted(report.unlabelled, 'hull')} without a label"] if report.unlabelled else []
    return ", ".join(parts)
