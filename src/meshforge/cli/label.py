"""`meshforge label`: labels for the hulls of a project."""

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from pydantic import ValidationError

from meshforge.batch import ExecutionOptions, describe_jobs
from meshforge.cli import options
from meshforge.cli.console import progress
from meshforge.cli.label_by_hand import label_by_hand, rename_labels
from meshforge.cli.label_report import LabelPrinter, print_changes, print_proposals
from meshforge.cli.label_vlm import label_with_vlm, print_forecast
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, escape_name, first_validation_error
from meshforge.labels import (
    LABELERS,
    AllLabeler,
    FileLabeler,
    Labeler,
    LabelFamily,
    LabelFileOptions,
    LabelResult,
    LikeLabeler,
    LikeMismatchError,
    NameLabeler,
    VlmLabeler,
    approve_host,
    make_labeler,
)
from meshforge.project import Project
from meshforge.store import VlmSettings

_BY_HAND = ("project", "asset", "hulls", "vocabulary", "json")
_ONLY_FOR = {
    "labels": ("file", "all"),
    "classes": ("file", "all"),
    "align": ("file", "all"),
    "pattern": ("names", "file", "all"),
    "model": ("vlm",),
    "base_url": ("vlm",),
    "every_hull": ("vlm",),
    "max_cost": ("vlm",),
    "like": ("like",),
    "words": ("like",),
}
"""The sources of labels that an option is for."""


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
            + "; or the name of a plug-in's labeller. Without it: all.",
        ),
    ] = "all"
    labels: Annotated[
        Path | None,
        typer.Option("--labels", help="A file with labels, or a folder that mirrors the assets; default: beside each."),
    ] = None
    rename: Annotated[
        list[str] | None,
        typer.Option(
            "--rename",
            metavar="LABEL=NAME",
            help="Give a label another name, wherever the project has it; or a class its name: part_a=leg.",
            show_default=False,
        ),
    ] = None
    vocabulary: Annotated[str, typer.Option("--vocabulary", help="Set the labels that hulls can have: a,b,c.")] = ""
    like: Annotated[
        str | None,
        typer.Option("--like", metavar="PROJECT|sample:NAME", help="Take labels of another project or bundled family."),
    ] = None
    words: Annotated[
        list[str] | None,
        typer.Option("--map", metavar="THERE=HERE", help="The label here for one of --like: front=door; repeatable."),
    ] = None
    model: Annotated[str | None, typer.Option("--model", help="The model that --with vlm asks.")] = None
    base_url: Annotated[str | None, typer.Option("--base-url", help="Where it is, for example .../v1.")] = None
    every_hull: Annotated[
        bool | None,
        typer.Option(
            "--every-hull", help="Let --with vlm ask about every hull, not a few whose labels are propagated."
        ),
    ] = None
    max_cost: Annotated[
        float | None, typer.Option("--max-cost", min=0, help="Dollars that --with vlm may spend.", show_default=False)
    ] = None
    approve_host: Annotated[
        str | None,
        typer.Option("--approve-host", metavar="HOST", help="Let pictures and a key be sent to this host from now on."),
    ] = None
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
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Take nothing: show what would be taken, or what vlm would send and cost.")
    ] = False
    execution: options.ExecutionArguments = options.EXECUTION
    json: options.Json = False

    def to_labeler(self, project: Project) -> Labeler:
        """Return what gives the labels. Raises UsageError for an option that it does not know, or a wrong one."""
        typed = dict(options.list_typed(self.context))
        source = "like" if self.like and "source" not in typed else self.source
        labeler = make_labeler(source)
        for name, option in typed.items():
            sources = _ONLY_FOR.get(name, (source,))
            if source not in sources:
                wanted = " and ".join(f"--with {one}" for one in sources)
                raise UsageError(f"{option} is for {wanted}", remedy="Leave it out.")
        meanings = tuple(_parse_meaning("--pattern", text, '"*knob*=handle"') for text in self.pattern or ())
        if isinstance(labeler, LikeLabeler):
            words = dict(_parse_meaning("--map", text, "front=door") for text in self.words or ())
            return LikeLabeler(self.like, words)
        if isinstance(labeler, NameLabeler):
            return NameLabeler(meanings)
        if isinstance(labeler, FileLabeler | AllLabeler):
            classes = tuple(word.strip() for word in self.classes.split(",")) if self.classes else ()
            files = FileLabeler(self.labels, LabelFileOptions(meanings, classes, self.align or "check"))
            return files if isinstance(labeler, FileLabeler) else AllLabeler(files, NameLabeler(meanings))
        if isinstance(labeler, VlmLabeler):
            return VlmLabeler(self._read_vlm_settings(project), (self.base_url,) if self.base_url else ())
        return labeler

    def _read_vlm_settings(self, project: Project) -> VlmSettings:
        names = ("model", "base_url", "every_hull", "max_cost")
        given = {name: value for name in names if (value := getattr(self, name)) is not None}
        try:
            return VlmSettings.model_validate(project.settings.vlm.model_dump() | given)
        except ValidationError as error:
            raise UsageError(first_validation_error(error)) from error


def _parse_meaning(option: str, text: str, example: str) -> tuple[str, str]:
    pattern, sign, label = text.rpartition("=")
    if not sign or not pattern.strip():
        what = "pattern" if option == "--pattern" else "label there"
        raise UsageError(f"{option} {text}: it needs a {what} and a label", remedy=f"Write it so: {example}.")
    return pattern.strip(), label.strip()


@options.takes(LabelArguments)
def label(given: LabelArguments) -> None:
    """Give labels to hulls; what a person labelled is never overwritten by a machine.

    With ASSET and HULLS=LABEL you label by hand (the studio can undo it). Else labels come from all that is there, or
    from what --with says: files, names, what people said, and hulls that look alike, weighed together.
    Labels are written asset by asset; a run that was stopped or killed goes on where it was: the same command again.
    Exit code 1 when some labels could not be taken, or an asset could not be read (each named); the others are done.
    """
    words = options.split_words(given.vocabulary) if given.vocabulary else None
    if given.approve_host:
        approve_host(given.approve_host)
        remark(f"pictures and a key may be sent to {given.approve_host} from now on")
        if given.source != "vlm":
            return
    project = Project.open(given.project)
    if given.rename:
        others = {name for name, _ in options.list_typed(given.context)} - {"project", "rename"}
        options.refuse_with(given.context, others, "--rename")
        rename_labels(project, given.rename)
        return
    if given.asset is not None:
        for name, option in options.list_typed(given.context):
            if name not in _BY_HAND:
                raise UsageError(f"{option} says nothing on labels by hand", remedy="Leave it out, or ASSET.")
        label_by_hand(project, given.asset, given.hulls or (), words, json=given.json)
        return
    labeler, execution = given.to_labeler(project), given.execution.to_options()
    if given.dry_run and isinstance(labeler, VlmLabeler):
        family = LabelFamily(project, project.vocabulary if words is None else tuple(words), execution, progress)
        print_forecast(family, labeler.settings or project.settings.vlm, json=given.json)
    elif given.dry_run:
        found = _run(project, labeler, json=given.json, vocabulary=words, dry_run=True, execution=execution)
        print_proposals(found.proposals, json=given.json)
    else:
        if words is not None:
            project.set_vocabulary(words)
        printer = LabelPrinter(project, json=given.json)
        if isinstance(labeler, VlmLabeler):
            label_with_vlm(project, labeler, execution, printer)
        else:
            _label(project, labeler, execution, printer)
        raise typer.Exit(int(printer.failed))


def _label(project: Project, labeler: Labeler, execution: ExecutionOptions, printer: LabelPrinter) -> None:
    if len(project.assets()) > 1:
        remark(describe_jobs(project.jobs()))
    result = _run(project, labeler, json=printer.json, execution=execution, report=printer.print)
    printer.summarize()
    if not printer.json:
        print_changes(project, labeler, result)
    elif labeler.replaces:
        more = {"alike": result.alike, "next": result.next} if labeler.name in ("all", "propagate") else {}
        print_json({"changes": [asdict(change) for change in result.changes]} | more, compact=True)


def _run(project: Project, labeler: Labeler, *, json: bool, **options: Any) -> LabelResult:
    """Label a project, and print what is to be known of it; of another kind than it should be, which are nearest."""
    try:
        result = project.label(labeler, stage=progress, **options)
    except LikeMismatchError as error:
        if json:
            nearest = [{"family": name, "distance": distance} for name, distance in error.kinds]
            print_json({"refused": error.problem, "nearest": nearest, "remedy": error.remedy}, compact=True)
        raise
    for note in result.notes:
        remark(escape_name(note))
    return result
