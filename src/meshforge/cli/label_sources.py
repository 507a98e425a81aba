"""`meshforge label` from files, names and a few labelled assets: its options, the preview of a dry run, and the run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import typer

from meshforge.cli.label_report import LabelPrinter

if TYPE_CHECKING:
    from meshforge.batch import ExecutionOptions
    from meshforge.cli.label_report import LabelReport
    from meshforge.labels import LabelFileOptions, LabelOutcome, Proposal, Proposals
    from meshforge.project import Project


_MAX_NAMES = 3  # names of a row that are shown
_MAX_PROBLEMS = 20


@dataclass(frozen=True)
class SourceOptions:
    """The options of `--with names` and `--with file` as they are given; files: those of `--with file` alone."""

    patterns: Sequence[str]
    classes: str
    align: Literal["check", "box", "off"] | None
    points_up: Literal["y", "z"] | None

    def refuse_for(self, source: str) -> None:
        """Raise UsageError for an option that this source of labels does not know."""
        from meshforge.common import UsageError

        of_points = {"--classes": self.classes, "--align": self.align, "--points-up": self.points_up}
        given = next((name for name, value in of_points.items() if value), None)
        if given and source != "file":
            raise UsageError(f"{given} is for --with file", remedy="Leave it out.")
        if self.patterns and source not in ("file", "names"):
            raise UsageError("--pattern is for --with names and --with file", remedy="Leave it out.")

    @property
    def meanings(self) -> tuple[tuple[str, str], ...]:
        """Patterns with the labels that they mean. Raises UsageError for one without a label."""
        return tuple(map(_parse_meaning, self.patterns))

    @property
    def filing(self) -> LabelFileOptions:
        """How files are read."""
        from meshforge.labels import LabelFileOptions, PointAlignment, PointsOptions

        classes = tuple(word.strip() for word in self.classes.split(",")) if self.classes else ()
        return LabelFileOptions(
            self.meanings, PointsOptions(classes, PointAlignment(self.align or "check", self.points_up))
        )


def _parse_meaning(text: str) -> tuple[str, str]:
    from meshforge.common import UsageError

    pattern, sign, label = text.rpartition("=")
    if not sign or not pattern.strip():
        raise UsageError(f"--pattern {text}: it needs a pattern and a label", remedy='Write it so: "*knob*=handle".')
    return pattern.strip(), label.strip()


def preview(
    project: Project,
    source: str,
    labels: Path | None,
    vocabulary: Sequence[str] | None,
    options: SourceOptions,
    spread: ExecutionOptions,
    *,
    json: bool,
) -> None:
    """Show what would be given, with nothing written; vocabulary: the one to be tried, if another."""
    from meshforge.cli.terminal import print_json, progress

    match source:
        case "names":
            found = project.propose_from_names(options.meanings, vocabulary, execution=spread)
        case "propagate":
            found = project.propose_propagated(vocabulary, execution=spread, stage=progress)
        case _:
            found = project.propose_from_files(labels, options.filing, vocabulary, execution=spread)
    if json:
        print_json(_to_json(found))
    else:
        _print_preview(found)


def _to_json(found: Proposals) -> dict[str, Any]:
    return {"take": _rows(found.rows), "leave": _rows(found.left), "keep": found.labelled, "problems": found.problems}


def _rows(rows: Iterable[Proposal]) -> list[dict[str, Any]]:
    return [asdict(row) | {"unsure": row.is_unsure} for row in rows]


def _print_preview(found: Proposals) -> None:
    import typer

    from meshforge.cli.terminal import print_table
    from meshforge.common import pluralize

    columns = ("label", "from", "names", "hulls", "assets", "confidence")
    rows = [*map(_cells, found.rows), *map(_cells, found.left)]
    if rows:
        print_table(columns, rows, right=("hulls", "assets"))
    taken, left = (sum(row.hulls for row in rows) for rows in (found.rows, found.left))
    told = [f"{pluralize(taken, 'label')} would be taken", f"{pluralize(left, 'hull')} left without one"]
    told += [f"{pluralize(found.labelled, 'hull')} would stay as they are"] if found.labelled else []
    typer.echo(f"{'; '.join(told)}. Nothing was written.")
    for problem in found.problems[:_MAX_PROBLEMS]:
        typer.echo(f"    left out: {problem}")
    if len(found.problems) > _MAX_PROBLEMS:
        typer.echo(f"    and {len(found.problems) - _MAX_PROBLEMS} more")


def _cells(row: Proposal) -> tuple[str, str, str, str, str, str]:
    from meshforge.common import join_names

    sure = f"{row.low:.2f}" if f"{row.low:.2f}" == f"{row.high:.2f}" else f"{row.low:.2f} to {row.high:.2f}"
    confidence = "" if row.label is None else f"{sure}{', unsure' if row.is_unsure else ''}"
    names = join_names([name for name in row.names if name], _MAX_NAMES)
    return row.label or "(none)", row.kind, names, f"{row.hulls:,}", f"{row.assets:,}", confidence


def label_from_sources(
    project: Project,
    source: str,
    labels: Path | None,
    given: SourceOptions,
    spread: ExecutionOptions,
    sheets: Path | None,
    page: LabelReport | None,
    *,
    json: bool,
) -> bool:
    """Label a project, and say what came of it; whether some labels could not be taken."""
    from meshforge.cli.label_report import summarize
    from meshforge.cli.terminal import remark

    if len(project.assets()) > 1:
        remark(project.plan_labels())
    telling = LabelPrinter(page, json=json)
    closing = _run_source(project, source, labels, given, spread, telling)
    summarize(project, sheets, page, json=json)
    if closing and not json:
        typer.echo(closing)
    return telling.failed


def _run_source(
    project: Project,
    source: str,
    labels: Path | None,
    given: SourceOptions,
    spread: ExecutionOptions,
    telling: LabelPrinter,
) -> str:
    """Label; a closing sentence."""
    from meshforge.cli.terminal import progress
    from meshforge.common import pluralize

    count = len(project.assets())
    if source == "propagate":
        carried = project.propagate_labels(execution=spread, stage=progress, report=telling)
        return f"If some are wrong, label or correct this one next: {carried.next}" if carried.next else ""
    with progress(count, "labelling") as advance:

        def report(labelled: LabelOutcome) -> None:
            telling(labelled)
            advance()

        if source == "names":
            project.label_from_names(given.meanings, execution=spread, report=report)
            return ""
        bare = count - len(project.label_from_files(labels, given.filing, execution=spread, report=report))
    return f"{pluralize(bare, 'asset')} without a labels file" if bare else ""
