"""`meshforge label`: labels for the hulls of a project."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.options import Json

if TYPE_CHECKING:
    from meshforge.cli.label_proposals import GivenOptions
    from meshforge.project import Labelled, Project


def label(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    source: Annotated[
        Literal["file", "names", "propagate", "vlm"],
        typer.Option(
            "--with",
            help="Where labels come from: file takes over labels files, names reads them off the names of hulls and "
            "bodies, propagate carries those of a few assets to all others, vlm asks a vision-language model.",
        ),
    ] = "file",
    labels: Annotated[
        Path | None,
        typer.Option("--labels", help="A file with labels, or a folder that mirrors the assets; default: beside each."),
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
    model: Annotated[str | None, typer.Option("--model", help="The model that --with vlm asks.")] = None,
    base_url: Annotated[str | None, typer.Option("--base-url", help="Where it is, for example .../v1.")] = None,
    mode: Annotated[
        Literal["cheap", "balanced", "exact"] | None,
        typer.Option("--mode", help="How many pictures and questions --with vlm takes for a hull.", show_default=False),
    ] = None,
    max_cost: Annotated[
        float | None, typer.Option("--max-cost", min=0, help="Dollars that --with vlm may spend.", show_default=False)
    ] = None,
    pattern: Annotated[
        list[str] | None,
        typer.Option(
            "--pattern",
            metavar="PATTERN=LABEL",
            help='What names mean, a glob "*knob*=handle" or "/^d[0-9]+$/=drawer", with no label for none; before '
            "those of [names] in meshforge.toml. May be given several times.",
            show_default=False,
        ),
    ] = None,
    classes: Annotated[
        str,
        typer.Option(
            "--classes",
            help="The names of classes 0, 1, ... of segmented points: a,b,c, or `vocabulary` for those of the project.",
            show_default=False,
        ),
    ] = "",
    align: Annotated[
        Literal["check", "box", "off"] | None,
        typer.Option(
            "--align",
            help="Segmented points lie where the asset does (check, the default), or are scaled and moved so that the "
            "boxes fit (box), or are taken as they are (off).",
            show_default=False,
        ),
    ] = None,
    points_up: Annotated[
        Literal["y", "z"] | None,
        typer.Option("--points-up", help="The axis that points up among segmented points.", show_default=False),
    ] = None,
    dry_run: Annotated[
        bool,
        typer.Option(
            "--dry-run", help="Take nothing: show what names or files would give, or what vlm would send and cost."
        ),
    ] = False,
    json: Json = False,
) -> None:
    """Give labels to hulls; what a person labelled is never overwritten by a machine.

    Exit code 1 when some labels could not be taken (each named).
    """
    from meshforge.cli import label_proposals, label_vlm
    from meshforge.cli.label_summary import summarise
    from meshforge.cli.output import print_json
    from meshforge.errors import UsageError
    from meshforge.project import Project

    if labels and source != "file":
        raise UsageError(f"--labels names labels files, which --with {source} does not read", remedy="Leave one out.")
    options = label_vlm.VlmOptions(model, base_url, mode, max_cost)
    if source != "vlm" and options.given:
        raise UsageError(f"{options.given} is for --with vlm", remedy="Leave it out.")
    if source == "propagate" and dry_run:
        raise UsageError("--dry-run is for --with names, file and vlm", remedy="Leave it out.")
    given = label_proposals.GivenOptions(pattern or (), classes, align, points_up)
    given.refuse_for(source)
    opened = Project.open(project)
    words = [word.strip() for word in vocabulary.split(",") if word.strip()] if vocabulary else None
    if dry_run and source != "vlm":
        label_proposals.propose(opened, source, labels, words, given, json=json)
        return
    if dry_run:
        label_vlm.foretell(opened, options, words, json=json)
        return
    if words is not None:
        opened.set_vocabulary(words)
    asked = label_vlm.ask(opened, options) if source == "vlm" else None
    reports, closing = (asked.reports, "") if asked else _labelled(opened, source, labels, given)
    for report in reports:
        if json:
            print_json(asdict(report) | (label_vlm.as_json(asked, report.asset) if asked else {}), compact=True)
            continue
        typer.echo(f"{report.asset}: {_told(report)}")
        for problem in report.problems:
            typer.echo(f"    left out: {problem}")
        if asked:
            label_vlm.say_open(asked, report.asset)
    summarise(opened, sheets, json=json)
    if closing and not json:
        typer.echo(closing)
    if asked:
        label_vlm.close(opened, asked, json=json)
    raise typer.Exit(int(any(report.problems for report in reports) or bool(asked and asked.ended)))


def _labelled(
    project: Project, source: str, labels: Path | None, given: GivenOptions
) -> tuple[Sequence[Labelled], str]:
    """What became of the labels of each asset, and a closing sentence."""
    from meshforge.cli.output import progress
    from meshforge.words import counted

    match source:
        case "names":
            return project.label_from_names(given.meanings), ""
        case "propagate":
            with progress(len(project.assets()), "reading") as advance:
                carried = project.propagate_labels(progress=advance)
            helpful = f"If some are wrong, label or correct this one next: {carried.next}" if carried.next else ""
            return carried.reports, helpful
        case _:
            reports = project.label_from_files(labels, given.filing)
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
