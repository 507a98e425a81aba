"""What `meshforge label` reports: a line for each asset, the summary of a project's labels; how labels were replaced,
and what a dry run would take."""

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import asdict
from typing import Any

import typer

from meshforge.cli.console import print_table
from meshforge.cli.terminal import print_json
from meshforge.common import escape_name, join_names, pluralize
from meshforge.labels import Labeler, LabelOutcome, LabelResult, Proposal, Proposals, Tally
from meshforge.project import SOURCE_WORDS, Project

_MAX_NAMES = 8  # hulls without a label in a row
_FEW_NAMES = 3  # of hulls whose names say a label
_MAX_LINES = 20  # problems of one asset, and pairs of labels, that are shown


class LabelPrinter:
    """Prints what became of each asset, and how many labels there are in the end.

    failed: whether any labels could not be taken.
    """

    def __init__(self, project: Project, *, json: bool) -> None:
        self.json = json
        self.failed = False
        self._project = project

    def print(self, outcome: LabelOutcome) -> None:
        """Print what became of an asset."""
        self.failed |= bool(outcome.problems)
        if self.json:
            print_json(asdict(outcome), compact=True)
            return
        typer.echo(f"{escape_name(outcome.asset)}: {_describe_outcome(outcome)}")
        for problem in outcome.problems:
            typer.echo("    left out: " + problem.replace("\n", "\n    "))
        for note in _describe_open(outcome):
            typer.echo(f"    {note}")

    def summarize(self) -> None:
        """Print how many labels there are."""
        tally = self._project.tally_labels()
        if self.json:
            print_json({"labels": asdict(tally)}, compact=True)
        else:
            _print_tally(tally)


def _print_tally(tally: Tally) -> None:
    rows = [(SOURCE_WORDS[share.source], share.sure, share.likely, share.unsure) for share in tally.shares]
    columns = ("labels from", "sure", "likely", "unsure")
    typer.echo()
    print_table(columns, [*rows, ("no label", "", "", tally.unlabelled)], right=columns[1:])
    if found := tally.describe_contradictions():
        typer.echo(f"\n{escape_name(found)}")
    typer.echo()


def _describe_outcome(outcome: LabelOutcome) -> str:
    parts = [f"{pluralize(outcome.taken, 'label')} taken"]
    parts += [f"{outcome.same} there already"] if outcome.same else []
    parts += [f"{outcome.kept} kept as a person gave them"] if outcome.kept else []
    parts += [f"{outcome.unsure} unsure"] if outcome.unsure else []
    parts += [f"{pluralize(outcome.unlabelled, 'hull')} without a label"] if outcome.unlabelled else []
    return ", ".join(parts)


def _describe_open(outcome: LabelOutcome) -> list[str]:
    by_reason: dict[str, list[str]] = defaultdict(list)
    for hull, why in outcome.open.items():
        by_reason[why].append(hull)
    return [f"no label: {join_names(hulls, _MAX_NAMES)} ({why})" for why, hulls in by_reason.items()]


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
    names = join_names([name for name in row.names if name], _FEW_NAMES)
    return row.label or "(none)", row.kind, names, f"{row.hulls:,}", f"{row.assets:,}", confidence


def print_changes(project: Project, labeler: Labeler, result: LabelResult) -> None:
    """Print which labels were replaced, which may be two names of one part, and what to label next."""
    if labeler.replaces:
        _print_replaced(result)
    for one, other in result.alike:
        words = ",".join(word for word in project.vocabulary if word != other)
        command = f"meshforge label {project.folder} --with propagate --vocabulary {words}"
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
        typer.echo(f"    {one.was} -> {one.label}: {pluralize(one.hulls, 'hull')} in {pluralize(one.assets, 'asset')}")
    if len(replaced) > _MAX_LINES:
        typer.echo(f"    and {len(replaced) - _MAX_LINES} more pairs of labels")
