"""What `meshforge label` reports: a line for each asset, the summary of a project's labels, and the page of
`--report`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from time import perf_counter
from typing import Any

import typer

from meshforge import batch
from meshforge.cli.console import print_table, progress
from meshforge.cli.report import write_report_page
from meshforge.cli.terminal import print_json, remark
from meshforge.common import MeshForgeError, escape_name, pluralize
from meshforge.labels import Labeler, LabelOutcome, Tally
from meshforge.project import Project

_DOUBTFUL = "Doubtful assets have hulls without a label, or with an unsure one."
_MAX_PROBLEMS = 20  # of one asset that are shown
_RANKS: tuple[batch.LabelStatus, ...] = ("problems", "doubtful", "labelled")

_MAX_ON_SHEET = 24
"""Assets on the sheet that is made without being asked for: those with most that is in doubt."""
_SOURCE_WORDS = {
    "user": "people",
    "repair": "people, repairs confirmed",
    "file": "files",
    "name": "names",
    "propagated": "propagation",
    "consensus": "consensus",
    "split": "splits of hulls",
    "vlm": "a model",
    "edit": "edits",
    "plugin": "plug-ins",
}


class LabelReport:
    """The page of `--report`: takes what became of assets as it comes."""

    def __init__(self, path: Path, labeler: Labeler) -> None:
        self._path, self._started = path, perf_counter()
        about = labeler.about or f"labels by the plug-in {labeler.name}"
        self._about = [f"{about[0].upper()}{about[1:]}."]
        self._outcomes: dict[str, LabelOutcome] = {}
        self._problems: dict[str, Sequence[str]] = {}
        self._notes: dict[str, Sequence[str]] = {}

    def add(self, outcome: LabelOutcome, notes: Sequence[str] = ()) -> None:
        """Add an asset, and what else there is to say about it."""
        self._outcomes[outcome.asset] = outcome
        self._problems[outcome.asset] = outcome.problems
        self._notes[outcome.asset] = notes

    def remark(self, text: str) -> None:
        """Add a sentence about the whole run."""
        self._about.append(text)

    def write(self, project: Project, tally: Tally) -> None:
        """Write the page; of very many assets it shows some, those with problems first, then those most in doubt."""
        for asset, why in tally.unreadable:
            if not self._problems.get(asset):
                self._problems[asset] = (why,)
        doubtful = dict(tally.doubtful)
        status = {asset: self._status(asset, doubtful) for asset in project.assets()}
        order = sorted(status, key=lambda asset: (_RANKS.index(status[asset]), -doubtful.get(asset, 0)))[
            : batch.MOST_PICTURED
        ]
        assets = [
            batch.ReportAsset(
                asset,
                mesh,
                mesh,
                (),
                status[asset],
                self._error(asset),
                notes=self._notes_on(asset, doubtful) if mesh else (),
            )
            for asset, mesh in zip(order, batch.read_again(project.readers(order)), strict=True)
        ]
        header = batch.ReportHeader(
            f"Labels of {project.settings.name}",
            " ".join([*self._about, *([_DOUBTFUL] if doubtful else [])]),
            perf_counter() - self._started,
            self._figures(status, tally),
        )
        write_report_page(self._path, header, assets, options=batch.ReportOptions(vocabulary=project.vocabulary))

    def _status(self, asset: str, doubtful: Mapping[str, int]) -> batch.LabelStatus:
        if self._problems.get(asset):
            return "problems"
        return "doubtful" if asset in doubtful else "labelled"

    def _figures(self, status: Mapping[str, batch.LabelStatus], tally: Tally) -> batch.RunFigures:
        outcomes, unsure = self._outcomes.values(), sum(share.unsure for share in tally.shares)
        numbers = {
            "hulls": tally.hulls,
            "labels taken": sum(outcome.taken for outcome in outcomes),
            "kept as people gave them": sum(outcome.kept for outcome in outcomes),
            "unsure": unsure,
            "without a label": tally.unlabelled,
        }
        more = {name: (f"{n:,}", None) for name, n in numbers.items() if n or name in ("hulls", "labels taken")}
        return batch.RunFigures(Counter(status.values()), more, "those with problems or labels in doubt")

    def _error(self, asset: str) -> str | None:
        problems = self._problems.get(asset, ())
        more = len(problems) - _MAX_PROBLEMS
        lines = [*problems[:_MAX_PROBLEMS], *([f"and {more:,} more"] if more > 0 else [])]
        return "\n".join(lines) or None

    def _notes_on(self, asset: str, doubtful: Mapping[str, int]) -> tuple[str, ...]:
        outcome, lacking = self._outcomes.get(asset), doubtful.get(asset)
        line = _describe_outcome(outcome) if outcome else "given no labels this time"
        if not outcome and lacking:
            line += f", {pluralize(lacking, 'hull')} without a label or unsure"
        return (line, *self._notes.get(asset, ()))


class LabelPrinter:
    """Prints what became of each asset, and how many labels there are in the end.

    sheets: a folder for contact sheets of all assets; without it, those with most in doubt are drawn into the project's
    `pictures`. page: the report that is to be written, too. failed: whether any labels could not be taken.
    """

    def __init__(self, sheets: Path | None, page: LabelReport | None, *, json: bool) -> None:
        self.json = json
        self.failed = False
        self._sheets, self._page = sheets, page

    def print(self, outcome: LabelOutcome, more: dict[str, Any] | None = None, notes: Sequence[str] = ()) -> None:
        """Print what became of an asset; more: what JSON has besides; notes: lines below it, for people."""
        self.failed |= bool(outcome.problems)
        if self._page:
            self._page.add(outcome, notes)
        if self.json:
            print_json(asdict(outcome) | (more or {}), compact=True)
            return
        typer.echo(f"{escape_name(outcome.asset)}: {_describe_outcome(outcome)}")
        for problem in outcome.problems:
            typer.echo("    left out: " + problem.replace("\n", "\n    "))
        for note in notes:
            typer.echo(f"    {note}")

    def remark(self, text: str) -> None:
        """Add a sentence about the whole run to the report."""
        if self._page:
            self._page.remark(text)

    def summarize(self, project: Project) -> None:
        """Print how many labels there are, and write the contact sheets and the report."""
        tally = project.tally_labels()
        assets = project.assets()
        order = list(dict.fromkeys([*(asset for asset, _ in tally.doubtful), *assets]))
        shown = assets if self._sheets else order[:_MAX_ON_SHEET]
        written: Sequence[Path] = ()
        try:
            with progress(len(shown), "drawing") as advance:
                written = project.draw_labels(self._sheets or project.folder / "pictures", shown, advance)
        except MeshForgeError as error:  # labels are written: pictures that nobody asked for are no reason to fail
            if self._sheets:
                raise
            remark(f"no pictures of the labels: {error}")
        if self.json:
            print_json({"labels": asdict(tally), "sheets": [str(path) for path in written]}, compact=True)
        else:
            some = "" if len(shown) == len(assets) else f", the {len(shown)} assets with most that is in doubt"
            _print_summary(tally, written, some)
        if self._page:
            self._page.write(project, tally)


def _print_summary(tally: Tally, written: Sequence[Path], some: str) -> None:
    rows = [(_SOURCE_WORDS[share.source], share.sure, share.likely, share.unsure) for share in tally.shares]
    columns = ("labels from", "sure", "likely", "unsure")
    typer.echo()
    print_table(columns, [*rows, ("no label", "", "", tally.unlabelled)], right=columns[1:])
    typer.echo()
    for path in written[:1]:
        more = f" and {len(written) - 1} more" if len(written) > 1 else ""
        typer.echo(f"pictures: {path}{more}{some}")


def _describe_outcome(outcome: LabelOutcome) -> str:
    parts = [f"{pluralize(outcome.taken, 'label')} taken"]
    parts += [f"{outcome.same} there already"] if outcome.same else []
    parts += [f"{outcome.kept} kept as a person gave them"] if outcome.kept else []
    parts += [f"{outcome.unsure} unsure"] if outcome.unsure else []
    parts += [f"{pluralize(outcome.unlabelled, 'hull')} without a label"] if outcome.unlabelled else []
    return ", ".join(parts)
