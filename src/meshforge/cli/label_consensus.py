"""`meshforge label --with consensus` and `--with sources`: which labels went for which, in words and as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

import typer

from meshforge import batch
from meshforge.cli.console import progress
from meshforge.cli.label_report import LabelPrinter
from meshforge.cli.terminal import print_json, remark
from meshforge.common import pluralize
from meshforge.labels import LabelChange, LabelOutcome
from meshforge.project import Project

_MAX_CHANGES = 20


def label_by_consensus(project: Project, execution: batch.ExecutionOptions, printer: LabelPrinter) -> None:
    """Give hulls the labels that all sources together speak for, and print what came of it."""
    remark(project.plan_labels())
    result = project.label_by_consensus(execution=execution, stage=progress, report=printer.print)
    printer.summarize(project)
    if printer.json:
        print_json({**_to_json(result.changes), "alike": result.alike, "next": result.next}, compact=True)
        return
    _print_changes(result.changes)
    if not result.free:
        typer.echo("People labelled every hull: nothing is left to do.")
    elif not result.changes:
        typer.echo("Every hull keeps its label.")
    for pair in result.alike:
        typer.echo(_describe_alike(project, pair))
    if result.next:
        typer.echo(f"If some are wrong, label or correct this one next: {result.next}")


def restore_sources(project: Project, execution: batch.ExecutionOptions, printer: LabelPrinter) -> None:
    """Put what sources said in the place of labels that were inferred, and print what came of it."""
    with progress(len(project.assets()), "labelling") as advance:

        def report(outcome: LabelOutcome) -> None:
            printer.print(outcome)
            advance()

        result = project.restore_sources(execution=execution, report=report)
    printer.summarize(project)
    if printer.json:
        print_json(_to_json(result.changes), compact=True)
        return
    _print_changes(result.changes)
    if not result.changes:
        typer.echo("Every hull keeps its label.")


def _to_json(changes: Sequence[LabelChange]) -> dict[str, object]:
    return {"changes": [asdict(change) for change in changes]}


def _print_changes(changes: Sequence[LabelChange]) -> None:
    new = sum(one.hulls for one in changes if one.was is None)
    gone = sum(one.hulls for one in changes if one.label is None)
    replaced = [one for one in changes if one.was is not None and one.label is not None]
    count = sum(one.hulls for one in replaced)
    parts = [f"{pluralize(new, 'hull')} got a label"] if new else []
    parts += [f"{pluralize(gone, 'hull')} lost a label that was inferred"] if gone else []
    parts += [f"{pluralize(count, 'label')} {'was' if count == 1 else 'were'} replaced"] if count else []
    if parts:
        typer.echo(f"{'; '.join(parts)}{':' if replaced else '.'}")
    for one in replaced[:_MAX_CHANGES]:
        typer.echo(f"    {one.was} -> {one.label}: {pluralize(one.hulls, 'hull')} in {pluralize(one.assets, 'asset')}")
    if len(replaced) > _MAX_CHANGES:
        typer.echo(f"    and {len(replaced) - _MAX_CHANGES} more pairs of labels")


def _describe_alike(project: Project, pair: tuple[str, str]) -> str:
    one, other = pair
    words = ",".join(word for word in project.vocabulary if word != other)
    command = f"meshforge label {project.folder} --with consensus --vocabulary {words}"
    return (
        f"{one} and {other} are on hulls that look alike, and hardly an asset has both. If they are one part, leave "
        f"one of them out: {command}"
    )
