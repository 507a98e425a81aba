"""`meshforge label` from names and files: its options, and what would be taken, shown before it is."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from meshforge.batch import Spread
    from meshforge.project import Filing, Project, Proposal, Proposals

_NAMES = 3  # names of a row that are shown
_PROBLEMS = 20


@dataclass(frozen=True)
class GivenOptions:
    """The options of `--with names` and `--with file` as they are given; files: those of `--with file` alone."""

    patterns: Sequence[str]
    classes: str
    align: Literal["check", "box", "off"] | None
    points_up: Literal["y", "z"] | None

    def refuse_for(self, source: str) -> None:
        """Raise UsageError for an option that this source of labels does not know."""
        from meshforge.errors import UsageError

        of_points = {"--classes": self.classes, "--align": self.align, "--points-up": self.points_up}
        given = next((name for name, value in of_points.items() if value), None)
        if given and source != "file":
            raise UsageError(f"{given} is for --with file", remedy="Leave it out.")
        if self.patterns and source not in ("file", "names"):
            raise UsageError("--pattern is for --with names and --with file", remedy="Leave it out.")

    @property
    def meanings(self) -> tuple[tuple[str, str], ...]:
        """Patterns with the labels that they mean. Raises UsageError for one without a label."""
        return tuple(map(_meaning, self.patterns))

    @property
    def filing(self) -> Filing:
        """How files are read."""
        from meshforge.perception.segments import Placing
        from meshforge.project import Filing, Reading

        classes = tuple(word.strip() for word in self.classes.split(",")) if self.classes else ()
        return Filing(self.meanings, Reading(classes, Placing(self.align or "check", self.points_up)))


def _meaning(text: str) -> tuple[str, str]:
    from meshforge.errors import UsageError

    pattern, sign, label = text.rpartition("=")
    if not sign or not pattern.strip():
        raise UsageError(f"--pattern {text}: it needs a pattern and a label", remedy='Write it so: "*knob*=handle".')
    return pattern.strip(), label.strip()


def propose(
    project: Project,
    source: str,
    labels: Path | None,
    vocabulary: Sequence[str] | None,
    options: GivenOptions,
    spread: Spread,
    *,
    json: bool,
) -> None:
    """Show what would be given, with nothing written; vocabulary: the one to be tried, if another."""
    from meshforge.cli.output import print_json, progress

    match source:
        case "names":
            found = project.propose_from_names(options.meanings, vocabulary, spread=spread)
        case "propagate":
            found = project.propose_propagated(vocabulary, spread=spread, stage=progress)
        case _:
            found = project.propose_from_files(labels, options.filing, vocabulary, spread=spread)
    if json:
        print_json(_as_json(found))
    else:
        _show(found)


def _as_json(found: Proposals) -> dict[str, Any]:
    return {"take": _rows(found.rows), "leave": _rows(found.left), "keep": found.labelled, "problems": found.problems}


def _rows(rows: Iterable[Proposal]) -> list[dict[str, Any]]:
    return [asdict(row) | {"unsure": row.is_unsure} for row in rows]


def _show(found: Proposals) -> None:
    import typer

    from meshforge.cli.output import table
    from meshforge.words import counted

    columns = ("label", "from", "names", "hulls", "assets", "confidence")
    rows = [*map(_cells, found.rows), *map(_cells, found.left)]
    if rows:
        table(columns, rows, right=("hulls", "assets"))
    taken, left = (sum(row.hulls for row in rows) for rows in (found.rows, found.left))
    told = [f"{counted(taken, 'label')} would be taken", f"{counted(left, 'hull')} left without one"]
    told += [f"{counted(found.labelled, 'hull')} would stay as they are"] if found.labelled else []
    typer.echo(f"{'; '.join(told)}. Nothing was written.")
    for problem in found.problems[:_PROBLEMS]:
        typer.echo(f"    left out: {problem}")
    if len(found.problems) > _PROBLEMS:
        typer.echo(f"    and {len(found.problems) - _PROBLEMS} more")


def _cells(row: Proposal) -> tuple[str, str, str, str, str, str]:
    from meshforge.words import listed

    sure = f"{row.low:.2f}" if f"{row.low:.2f}" == f"{row.high:.2f}" else f"{row.low:.2f} to {row.high:.2f}"
    confidence = "" if row.label is None else f"{sure}{', unsure' if row.is_unsure else ''}"
    names = listed([name for name in row.names if name], _NAMES)
    return row.label or "(none)", row.kind, names, f"{row.hulls:,}", f"{row.assets:,}", confidence
