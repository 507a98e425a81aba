"""`meshforge label` from files, names and a few labelled assets: each asset is told as soon as it is labelled."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from meshforge.batch import Spread
    from meshforge.cli.label.proposals import GivenOptions
    from meshforge.cli.label.report import LabelReport
    from meshforge.project import Labelled, Project


class Telling:
    """Prints what became of each asset; page: the report that takes it, too; failed: whether any labels could not be
    taken."""

    def __init__(self, page: LabelReport | None = None, *, json: bool) -> None:
        self._json = json
        self._page = page
        self.failed = False

    def __call__(self, report: Labelled, more: dict[str, Any] | None = None) -> None:
        from meshforge.cli.output import print_json

        self.failed |= bool(report.problems)
        if self._page:
            self._page.add(report)
        if self._json:
            print_json(asdict(report) | (more or {}), compact=True)
            return
        typer.echo(f"{report.asset}: {told(report)}")
        for problem in report.problems:
            typer.echo("    left out: " + problem.replace("\n", "\n    "))


def label(
    project: Project,
    source: str,
    labels: Path | None,
    given: GivenOptions,
    spread: Spread,
    sheets: Path | None,
    page: LabelReport | None,
    *,
    json: bool,
) -> bool:
    """Label a project, and say what came of it; whether some labels could not be taken."""
    from meshforge.cli.label.summary import summarise
    from meshforge.cli.output import remark

    if len(project.assets()) > 1:
        remark(project.plan_labels())
    telling = Telling(page, json=json)
    closing = _labelled(project, source, labels, given, spread, telling)
    summarise(project, sheets, page, json=json)
    if closing and not json:
        typer.echo(closing)
    return telling.failed


def _labelled(
    project: Project, source: str, labels: Path | None, given: GivenOptions, spread: Spread, telling: Telling
) -> str:
    """Label; a closing sentence."""
    from meshforge.cli.output import progress
    from meshforge.words import counted

    count = len(project.assets())
    if source == "propagate":
        carried = project.propagate_labels(spread=spread, stage=progress, report=telling)
        return f"If some are wrong, label or correct this one next: {carried.next}" if carried.next else ""
    with progress(count, "labelling") as advance:

        def report(labelled: Labelled) -> None:
            telling(labelled)
            advance()

        if source == "names":
            project.label_from_names(given.meanings, spread=spread, report=report)
            return ""
        bare = count - len(project.label_from_files(labels, given.filing, spread=spread, report=report))
    return f"{counted(bare, 'asset')} without a labels file" if bare else ""


def told(report: Labelled) -> str:
    """What became of the labels of an asset."""
    from meshforge.words import counted

    parts = [f"{counted(report.taken, 'label')} taken"]
    parts += [f"{report.same} there already"] if report.same else []
    parts += [f"{report.kept} kept as a person gave them"] if report.kept else []
    parts += [f"{report.unsure} unsure"] if report.unsure else []
    parts += [f"{counted(report.unlabelled, 'hull')} without a label"] if report.unlabelled else []
    return ", ".join(parts)
