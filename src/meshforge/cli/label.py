"""`meshforge label`: labels for the hulls of a project."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli import options
from meshforge.cli.label_by_hand import label_by_hand, refuse_sources
from meshforge.cli.label_report import LabelPrinter, LabelReport
from meshforge.cli.label_sources import SourceOptions, label_by, preview
from meshforge.cli.label_vlm import VLM, VlmOptions, forecast, label_with_vlm
from meshforge.cli.terminal import remark
from meshforge.common import UsageError
from meshforge.labels import LABELERS, approve_host
from meshforge.project import Project


@dataclass(frozen=True, slots=True)
class LabelArguments:
    """What is typed after `meshforge label`."""

    context: typer.Context
    project: Annotated[Path, typer.Argument(help="A project folder.")]
    asset: Annotated[
        str | None,
        typer.Argument(help="An asset to label by hand: its id, as `status` lists it, its file or a part of its name."),
    ] = None
    hulls: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="HULLS=LABEL",
            help="Labels by hand: hulls by name, number (#5) or pattern of whole names ('BODY/*' are all hulls of a "
            "body), with commas between, and their label; no label takes it away, and the last one counts: '*=panel' "
            "'geom9,#10=handle'.",
        ),
    ] = None
    source: Annotated[
        str,
        typer.Option(
            "--with",
            metavar=f"[{'|'.join(LABELERS.built_in)}|PLUGIN]",
            help="Where labels come from: "
            + "; ".join(f"{name}: {kind.about}" for name, kind in LABELERS.built_in.items())
            + "; or the name of a plug-in's labeller.",
        ),
    ] = "file"
    labels: Annotated[
        Path | None,
        typer.Option("--labels", help="A file with labels, or a folder that mirrors the assets; default: beside each."),
    ] = None
    vocabulary: Annotated[str, typer.Option("--vocabulary", help="Set the labels that hulls can have: a,b,c.")] = ""
    sheets: Annotated[
        Path | None,
        typer.Option(
            "--sheets",
            help="A folder for contact sheets of all assets; without it, one of those with most that is in doubt is "
            "written into the project's `pictures`.",
        ),
    ] = None
    vlm: VlmOptions = VLM
    pattern: Annotated[
        list[str] | None,
        typer.Option(
            "--pattern",
            metavar="PATTERN=LABEL",
            help='What names of hulls, bodies, meshes and materials mean, a glob "*knob*=handle" or '
            '"/^d[0-9]+$/=drawer", with no label for none; that of a body counts for all its hulls; before '
            "those of [names] in meshforge.toml. May be given several times.",
            show_default=False,
        ),
    ] = None
    classes: Annotated[
        str,
        typer.Option(
            "--classes",
            help="The names of classes 0, 1, ... of segmented points: a,b,c, or `vocabulary` for those of the project.",
            show_default=False,
        ),
    ] = ""
    align: options.Align = None
    points_up: options.PointsUp = None
    dry_run: Annotated[
        bool,
        typer.Option("--dry-run", help="Take nothing: show what would be taken, or what vlm would send and cost."),
    ] = False
    report: options.ReportPath = None
    execution: options.ExecutionArguments = options.EXECUTION
    json: options.Json = False


@options.takes(LabelArguments)
def label(given: LabelArguments) -> None:
    """Give labels to hulls; what a person labelled is never overwritten by a machine.

    With ASSET and HULLS=LABEL you label by hand (the studio can undo it), else labels come from what --with says.
    Labels are written asset by asset; a run that was stopped or killed goes on where it was: the same command again.
    Exit code 1 when some labels could not be taken, or an asset could not be read (each named); the others are done.
    """
    source, words = given.source, options.split_words(given.vocabulary) if given.vocabulary else None
    if given.vlm.approve_host:
        approve_host(given.vlm.approve_host)
        remark(f"pictures and a key may be sent to {given.vlm.approve_host} from now on")
        if source != "vlm":
            return
    if given.asset is not None:
        refuse_sources(given.context)
        label_by_hand(Project.open(given.project), given.asset, given.hulls or (), words, json=given.json)
        return
    sources = SourceOptions(source, given.labels, given.pattern or (), given.classes, given.align, given.points_up)
    labeler = sources.to_labeler()
    if source != "vlm" and given.vlm.first_option:
        raise UsageError(f"{given.vlm.first_option} is for --with vlm", remedy="Leave it out.")
    if given.report and given.dry_run:
        raise UsageError(options.NOTHING_TO_SHOW, remedy="Leave out --report.")
    project = Project.open(given.project)
    execution = given.execution.to_options()
    if given.dry_run and source == "vlm":
        forecast(project, given.vlm, words, execution, json=given.json)
        return
    if given.dry_run:
        preview(project, labeler, words, execution, json=given.json)
        return
    if words is not None:
        project.set_vocabulary(words)
    page = LabelReport(given.report, labeler) if given.report else None
    printer = LabelPrinter(given.sheets, page, json=given.json)
    if source == "vlm":
        label_with_vlm(project, given.vlm, execution, printer)
    else:
        label_by(project, labeler, execution, printer)
    raise typer.Exit(int(printer.failed))
