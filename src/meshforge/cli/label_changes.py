"""What a dry run of `meshforge label` would take, and how labels were replaced, as people and programs read it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from typing import Any

import typer

from meshforge.cli.console import print_table
from meshforge.cli.terminal import print_json
from meshforge.common import join_names, pluralize
from meshforge.labels import LabelChange, Labeler, LabelResult, Proposal, Proposals
from meshforge.project import Project

_MAX_NAMES = 3  # names of a row that are shown
_MAX_LINES = 20  # problems, and pairs of labels, that are shown


def print_proposals(found: Proposals, *, json: bool) -> None:
    """Print what would be taken, with nothing written."""
    if json:
        proposed = {"take": _to_json(found.rows), "leave": _to_json(found.left)}
        print_json({**proposed, "keep": found.labelled, "problems": found.problems})
        return
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


def _to_json(rows: Iterable[Proposal]) -> list[dict[str, Any]]:
    return [asdict(row) | {"unsure": row.is_unsure} for row in rows]


def _cells(row: Proposal) -> tuple[str, str, str, str, str, str]:
    sure = f"{row.low:.2f}" if f"{row.low:.2f}" == f"{row.high:.2f}" else f"{row.low:.2f} to {row.high:.2f}"
    confidence = "" if row.label is None else f"{sure}{', unsure' if row.is_unsure else ''}"
    names = join_names([name for name in row.names if name], _MAX_NAMES)
    return row.label or "(none)", row.kind, names, f"{row.hulls:,}", f"{row.assets:,}", confidence


def print_changes(project: Project, labeler: Labeler, result: LabelResult) -> None:
    """Print which labels were replaced, which may be two names of one part, and what to label next."""
    if labeler.replaces:
        _print_replaced(result)
    for one, other in result.alike:
        words = ",".join(word for word in project.vocabulary if word != other)
        command = f"meshforge label {project.folder} --with consensus --vocabulary {words}"
        typer.echo(
            f"{one} and {other} are on hulls that look alike, and hardly an asset has both. "
            f"If they are one part, leave one of them out: {command}"
        )
    if result.next:
        typer.echo(f"If some are wrong, label or correct this one next: {result.next}")
    if bare := len(project.assets()) - len(result.outcomes):
        typer.echo(f"{pluralize(bare, 'asset')} without a labels file")


def _print_replaced(result: LabelResult) -> None:
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


def _describe_change(one: LabelChange) -> str:
    return f"    {one.was} -> {one.label}: {pluralize(one.hulls, 'hull')} in {pluralize(one.assets, 'asset')}"
