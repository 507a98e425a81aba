"""`meshforge label` from files, names, a few labelled assets and plug-ins: its options, the preview of a dry run, and
the run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

import typer

from meshforge import batch
from meshforge.cli.console import print_table, progress
from meshforge.cli.label_report import LabelPrinter
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, join_names, pluralize
from meshforge.labels import LabelFileOptions, LabelOutcome, PointAlignment, Proposal, Proposals
from meshforge.project import Project

_MAX_NAMES = 3  # names of a row that are shown
_MAX_PROBLEMS = 20


@dataclass(frozen=True)
class SourceOptions:
    """Where labels come from, by the options of `--with file`, `names` and `propagate` as they are typed."""

    source: str
    labels: Path | None
    patterns: Sequence[str]
    classes: str
    align: Literal["check", "box", "off"] | None
    points_up: Literal["y", "z"] | None

    def refuse_strays(self) -> None:
        """Raise UsageError for an option that the source of labels does not know."""
        of_points = {"--classes": self.classes, "--align": self.align, "--points-up": self.points_up}
        given = next((name for name, value in of_points.items() if value), None)
        if given and self.source != "file":
            raise UsageError(f"{given} is for --with file", remedy="Leave it out.")
        if self.patterns and self.source not in ("file", "names"):
            raise UsageError("--pattern is for --with names and --with file", remedy="Leave it out.")

    @property
    def meanings(self) -> tuple[tuple[str, str], ...]:
        """Patterns with the labels that they mean. Raises UsageError for one without a label."""
        return tuple(map(_parse_meaning, self.patterns))

    @property
    def file_options(self) -> LabelFileOptions:
        """How files are read."""
        classes = tuple(word.strip() for word in self.classes.split(",")) if self.classes else ()
        return LabelFileOptions(self.meanings, classes, PointAlignment(self.align or "check", self.points_up))


def _parse_meaning(text: str) -> tuple[str, str]:
    pattern, sign, label = text.rpartition("=")
    if not sign or not pattern.strip():
        raise UsageError(f"--pattern {text}: it needs a pattern and a label", remedy='Write it so: "*knob*=handle".')
    return pattern.strip(), label.strip()


def preview(
    project: Project,
    options: SourceOptions,
    vocabulary: Sequence[str] | None,
    execution: batch.ExecutionOptions,
    *,
    json: bool,
) -> None:
    """Show what would be taken, with nothing written; vocabulary: the one to be tried, if another."""
    match options.source:
        case "names":
            found = project.propose_from_names(options.meanings, vocabulary, execution=execution)
        case "propagate":
            found = project.propose_propagated(vocabulary, execution=execution, stage=progress)
        case "consensus":
            found = project.propose_consensus(vocabulary, execution=execution, stage=progress)
        case "sources":
            found = project.propose_sources(execution=execution)
        case "file":
            found = project.propose_from_files(options.labels, options.file_options, vocabulary, execution=execution)
        case plugin:
            found = project.propose_by_plugin(plugin, vocabulary, execution=execution)
    if json:
        print_json(_to_json(found))
    else:
        _print_preview(found)


def _to_json(found: Proposals) -> dict[str, Any]:
    return {"take": _rows(found.rows), "leave": _rows(found.left), "keep": found.labelled, "problems": found.problems}


def _rows(rows: Iterable[Proposal]) -> list[dict[str, Any]]:
    return [asdict(row) | {"unsure": row.is_unsure} for row in rows]


def _print_preview(found: Proposals) -> None:
    columns = ("label", "from", "names", "hulls", "assets", "confidence")
    rows = [*map(_cells, found.rows), *map(_cells, found.left)]
    if rows:
        print_table(columns, rows, right=("hulls", "assets"))
    taken, left = (sum(row.hulls for row in rows) for rows in (found.rows, found.left))
    parts = [f"{pluralize(taken, 'label')} would be taken", f"{pluralize(left, 'hull')} left without one"]
    parts += [f"{pluralize(found.labelled, 'hull')} would stay as they are"] if found.labelled else []
    typer.echo(f"{'; '.join(parts)}. Nothing was written.")
    for problem in found.problems[:_MAX_PROBLEMS]:
        typer.echo(f"    left out: {problem}")
    if len(found.problems) > _MAX_PROBLEMS:
        typer.echo(f"    and {len(found.problems) - _MAX_PROBLEMS} more")


def _cells(row: Proposal) -> tuple[str, str, str, str, str, str]:
    sure = f"{row.low:.2f}" if f"{row.low:.2f}" == f"{row.high:.2f}" else f"{row.low:.2f} to {row.high:.2f}"
    confidence = "" if row.label is None else f"{sure}{', unsure' if row.is_unsure else ''}"
    names = join_names([name for name in row.names if name], _MAX_NAMES)
    return row.label or "(none)", row.kind, names, f"{row.hulls:,}", f"{row.assets:,}", confidence


def label_from_sources(
    project: Project, options: SourceOptions, execution: batch.ExecutionOptions, printer: LabelPrinter
) -> None:
    """Label a project, and print what came of it."""
    if len(project.assets()) > 1:
        remark(project.plan_labels())
    closing = _run_source(project, options, execution, printer)
    printer.summarize(project)
    if closing and not printer.json:
        typer.echo(closing)


def _run_source(
    project: Project, options: SourceOptions, execution: batch.ExecutionOptions, printer: LabelPrinter
) -> str:
    count = len(project.assets())
    if options.source == "propagate":
        result = project.propagate_labels(execution=execution, stage=progress, report=printer.print)
        return f"If some are wrong, label or correct this one next: {result.next}" if result.next else ""
    with progress(count, "labelling") as advance:

        def report(outcome: LabelOutcome) -> None:
            printer.print(outcome)
            advance()

        if options.source == "names":
            project.label_from_names(options.meanings, execution=execution, report=report)
            return ""
        if options.source != "file":
            project.label_by_plugin(options.source, execution=execution, report=report)
            return ""
        read = project.label_from_files(options.labels, options.file_options, execution=execution, report=report)
    bare = count - len(read)
    return f"{pluralize(bare, 'asset')} without a labels file" if bare else ""
