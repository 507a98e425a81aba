"""`meshforge label` from files, names, other assets and plug-ins: its options, a dry run, and the run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

import typer

from meshforge import batch, labels
from meshforge.cli.console import print_table, progress
from meshforge.cli.label_report import LabelPrinter
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, join_names, pluralize
from meshforge.project import Project

_MAX_NAMES = 3  # names of a row that are shown
_MAX_LINES = 20  # problems, and pairs of labels, that are shown


@dataclass(frozen=True)
class SourceOptions:
    """Where labels come from, by the options of `--with file` and `names` as they are typed."""

    source: str
    files: Path | None
    patterns: Sequence[str]
    classes: str
    align: Literal["check", "box", "off"] | None
    points_up: Literal["y", "z"] | None

    def to_labeler(self) -> labels.Labeler:
        """The labeler with its options. Raises UsageError for an option that it does not know, or a wrong one."""
        labeler = labels.make_labeler(self.source)
        self._refuse_strays()
        if isinstance(labeler, labels.NameLabeler):
            return labels.NameLabeler(self.meanings)
        if isinstance(labeler, labels.FileLabeler):
            classes = tuple(word.strip() for word in self.classes.split(",")) if self.classes else ()
            placing = labels.PointAlignment(self.align or "check", self.points_up)
            return labels.FileLabeler(self.files, labels.LabelFileOptions(self.meanings, classes, placing))
        return labeler

    def _refuse_strays(self) -> None:
        if self.files and self.source != "file":
            problem = f"--labels names labels files, which --with {self.source} does not read"
            raise UsageError(problem, remedy="Leave one out.")
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


def _parse_meaning(text: str) -> tuple[str, str]:
    pattern, sign, label = text.rpartition("=")
    if not sign or not pattern.strip():
        raise UsageError(f"--pattern {text}: it needs a pattern and a label", remedy='Write it so: "*knob*=handle".')
    return pattern.strip(), label.strip()


def preview(
    project: Project,
    labeler: labels.Labeler,
    vocabulary: Sequence[str] | None,
    execution: batch.ExecutionOptions,
    *,
    json: bool,
) -> None:
    """Show what would be taken, with nothing written; vocabulary: the one to be tried, if another."""
    found = project.label(labeler, vocabulary=vocabulary, dry_run=True, execution=execution, stage=progress).proposals
    if json:
        print_json(_to_json(found))
    else:
        _print_preview(found)


def _to_json(found: labels.Proposals) -> dict[str, Any]:
    return {"take": _rows(found.rows), "leave": _rows(found.left), "keep": found.labelled, "problems": found.problems}


def _rows(rows: Iterable[labels.Proposal]) -> list[dict[str, Any]]:
    return [asdict(row) | {"unsure": row.is_unsure} for row in rows]


def _print_preview(found: labels.Proposals) -> None:
    columns = ("label", "from", "names", "hulls", "assets", "confidence")
    rows = [*map(_cells, found.rows), *map(_cells, found.left)]
    if rows:
        print_table(columns, rows, right=("hulls", "assets"))
    taken, left = (sum(row.hulls for row in rows) for rows in (found.rows, found.left))
    parts = [f"{pluralize(taken, 'label')} would be taken", f"{pluralize(left, 'hull')} left without one"]
    parts += [f"{pluralize(found.labelled, 'hull')} would stay as they are"] if found.labelled else []
    typer.echo(f"{'; '.join(parts)}. Nothing was written.")
    for problem in found.problems[:_MAX_LINES]:
        typer.echo(f"    left out: {problem}")
    if len(found.problems) > _MAX_LINES:
        typer.echo(f"    and {len(found.problems) - _MAX_LINES} more")


def _cells(row: labels.Proposal) -> tuple[str, str, str, str, str, str]:
    sure = f"{row.low:.2f}" if f"{row.low:.2f}" == f"{row.high:.2f}" else f"{row.low:.2f} to {row.high:.2f}"
    confidence = "" if row.label is None else f"{sure}{', unsure' if row.is_unsure else ''}"
    names = join_names([name for name in row.names if name], _MAX_NAMES)
    return row.label or "(none)", row.kind, names, f"{row.hulls:,}", f"{row.assets:,}", confidence


def label_by(
    project: Project, labeler: labels.Labeler, execution: batch.ExecutionOptions, printer: LabelPrinter
) -> None:
    """Label a project, and print what came of it."""
    if len(project.assets()) > 1:
        remark(project.plan_labels())
    result = project.label(labeler, execution=execution, stage=progress, report=printer.print)
    printer.summarize(project)
    if printer.json:
        if labeler.replaces:
            more = {"alike": result.alike, "next": result.next} if labeler.name == "consensus" else {}
            print_json({"changes": [asdict(change) for change in result.changes]} | more, compact=True)
        return
    if labeler.replaces:
        _print_changes(result)
    for pair in result.alike:
        typer.echo(_describe_alike(project, pair))
    if result.next:
        typer.echo(f"If some are wrong, label or correct this one next: {result.next}")
    if bare := len(project.assets()) - len(result.outcomes):
        typer.echo(f"{pluralize(bare, 'asset')} without a labels file")


def _print_changes(result: labels.LabelResult) -> None:
    new = sum(one.hulls for one in result.changes if one.was is None)
    gone = sum(one.hulls for one in result.changes if one.label is None)
    replaced = [one for one in result.changes if one.was is not None and one.label is not None]
    count = sum(one.hulls for one in replaced)
    parts = [f"{pluralize(new, 'hull')} got a label"] if new else []
    parts += [f"{pluralize(gone, 'hull')} lost a label that was inferred"] if gone else []
    parts += [f"{pluralize(count, 'label')} {'was' if count == 1 else 'were'} replaced"] if count else []
    if parts:
        typer.echo(f"{'; '.join(parts)}{':' if replaced else '.'}")
    elif not result.free:
        typer.echo("People labelled every hull: nothing is left to do.")
    else:
        typer.echo("Every hull keeps its label.")
    for one in replaced[:_MAX_LINES]:
        typer.echo(_describe_change(one))
    if len(replaced) > _MAX_LINES:
        typer.echo(f"    and {len(replaced) - _MAX_LINES} more pairs of labels")


def _describe_change(one: labels.LabelChange) -> str:
    return f"    {one.was} -> {one.label}: {pluralize(one.hulls, 'hull')} in {pluralize(one.assets, 'asset')}"


def _describe_alike(project: Project, pair: tuple[str, str]) -> str:
    one, other = pair
    words = ",".join(word for word in project.vocabulary if word != other)
    command = f"meshforge label {project.folder} --with consensus --vocabulary {words}"
    return (
        f"{one} and {other} are on hulls that look alike, and hardly an asset has both. If they are one part, leave "
        f"one of them out: {command}"
    )
