"""What `meshforge label` reports: a line for each asset, the summary of a project's labels, and the page of
`--report`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from meshforge.batch import LabelStatus, RunFigures
    from meshforge.labels import LabelOutcome, Tally
    from meshforge.project import Project


_ABOUT = {
    "file": "Labels taken over from files.",
    "names": "Labels read off the names of hulls and bodies.",
    "propagate": "Labels of a few assets carried to all others.",
    "vlm": "Labels by a vision-language model.",
}
_DOUBTFUL = "Doubtful assets have hulls without a label, or with an unsure one."
_MAX_PROBLEMS = 20  # of one asset that are shown
_RANKS: tuple[LabelStatus, ...] = ("problems", "doubtful", "labelled")

_MAX_ON_SHEET = 24
"""Assets on the sheet that is made without being asked for: those with most that is in doubt."""
_SOURCE_WORDS = {
    "user": "people",
    "repair": "people, repairs confirmed",
    "file": "files",
    "name": "names",
    "propagated": "carried over",
    "vlm": "a model",
    "edit": "edits",
}


class LabelReport:
    """Takes what became of assets as it comes, and writes the page; source: where labels come from, as of `--with`."""

    def __init__(self, path: Path, source: str) -> None:
        self._path, self._started = path, perf_counter()
        self._about = [_ABOUT[source]]
        self._reports: dict[str, LabelOutcome] = {}
        self._problems: dict[str, Sequence[str]] = {}
        self._notes: dict[str, Sequence[str]] = {}

    def add(self, report: LabelOutcome) -> None:
        """One asset more."""
        self._reports[report.asset] = report
        self._problems[report.asset] = report.problems

    def remark(self, text: str) -> None:
        """What there is to say about all of it: a sentence."""
        self._about.append(text)

    def note(self, asset: str, notes: Sequence[str]) -> None:
        """What else there is to say about an asset."""
        if notes:
            self._notes[asset] = notes

    def write(self, project: Project, tally: Tally) -> None:
        """Write the page; of very many assets it shows some, those with problems first, then those most in doubt."""
        from meshforge.batch import MOST_PICTURED, ReportAsset, read_again
        from meshforge.cli.report import write_report_page

        for asset, why in tally.unreadable:
            if not self._problems.get(asset):
                self._problems[asset] = (why,)
        doubtful = dict(tally.doubtful)
        status = {asset: self._status(asset, doubtful) for asset in project.assets()}
        order = sorted(status, key=lambda asset: (_RANKS.index(status[asset]), -doubtful.get(asset, 0)))[:MOST_PICTURED]
        write_report_page(
            self._path,
            [
                ReportAsset(
                    asset,
                    mesh,
                    mesh,
                    (),
                    status[asset],
                    self._error(asset),
                    notes=self._notes_on(asset, doubtful) if mesh else (),
                )
                for asset, mesh in zip(order, read_again(project.readers(order)), strict=True)
            ],
            title=f"Labels of {project.settings.name}",
            about=" ".join([*self._about, *([_DOUBTFUL] if doubtful else [])]),
            vocabulary=project.vocabulary,
            figures=self._figures(status, tally),
            seconds=perf_counter() - self._started,
        )

    def _status(self, asset: str, doubtful: Mapping[str, int]) -> LabelStatus:
        if self._problems.get(asset):
            return "problems"
        return "doubtful" if asset in doubtful else "labelled"

    def _figures(self, status: Mapping[str, LabelStatus], tally: Tally) -> RunFigures:
        from meshforge.batch import RunFigures

        reports, unsure = self._reports.values(), sum(share.unsure for share in tally.shares)
        numbers = {
            "hulls": tally.hulls,
            "labels taken": sum(report.taken for report in reports),
            "kept as people gave them": sum(report.kept for report in reports),
            "unsure": unsure,
            "without a label": tally.unlabelled,
        }
        more = {name: (f"{n:,}", None) for name, n in numbers.items() if n or name in ("hulls", "labels taken")}
        return RunFigures(Counter(status.values()), more, "those with problems or labels in doubt")

    def _error(self, asset: str) -> str | None:
        problems = self._problems.get(asset, ())
        more = len(problems) - _MAX_PROBLEMS
        lines = [*problems[:_MAX_PROBLEMS], *([f"and {more:,} more"] if more > 0 else [])]
        return "\n".join(lines) or None

    def _notes_on(self, asset: str, doubtful: Mapping[str, int]) -> tuple[str, ...]:
        from meshforge.common import pluralize

        report, lacking = self._reports.get(asset), doubtful.get(asset)
        given = describe_labels(report) if report else "given no labels this time"
        if not report and lacking:
            given += f", {pluralize(lacking, 'hull')} without a label or unsure"
        return (given, *self._notes.get(asset, ()))


def summarize(project: Project, sheets: Path | None, page: LabelReport | None, *, json: bool) -> None:
    """Print how many labels there are, and write contact sheets; sheets: a folder for those of all assets.

    page: a report that is to be written, too.
    """
    from meshforge.cli.terminal import print_json, progress

    found = project.tally_labels()
    folder = sheets or project.folder / "pictures"
    order = list(dict.fromkeys([*(asset for asset, _ in found.doubtful), *project.assets()]))
    shown = project.assets() if sheets else order[:_MAX_ON_SHEET]
    with progress(len(shown), "drawing") as advance:
        written = project.draw_labels(folder, shown, advance)
    some = "" if len(shown) == len(project.assets()) else f", the {len(shown)} assets with most that is in doubt"
    if json:
        print_json({"labels": asdict(found), "sheets": [str(path) for path in written]}, compact=True)
    else:
        _print_summary(found, written, some)
    if page:
        page.write(project, found)


def _print_summary(found: Tally, written: Sequence[Path], some: str) -> None:
    _print_table(found)
    for path in written[:1]:
        more = f" and {len(written) - 1} more" if len(written) > 1 else ""
        typer.echo(f"pictures: {path}{more}{some}")


def _print_table(found: Tally) -> None:
    from meshforge.cli.terminal import print_table

    rows = [(_SOURCE_WORDS[share.source], share.sure, share.likely, share.unsure) for share in found.shares]
    columns = ("labels from", "sure", "likely", "unsure")
    typer.echo()
    print_table(columns, [*rows, ("no label", "", "", found.unlabelled)], right=columns[1:])
    typer.echo()


class LabelPrinter:
    """Prints what became of each asset; page: the report that takes it, too; failed: whether any labels could not be
    taken."""

    def __init__(self, page: LabelReport | None = None, *, json: bool) -> None:
        self._json = json
        self._page = page
        self.failed = False

    def __call__(self, report: LabelOutcome, more: dict[str, Any] | None = None) -> None:
        from meshforge.cli.terminal import print_json

        self.failed |= bool(report.problems)
        if self._page:
            self._page.add(report)
        if self._json:
            print_json(asdict(report) | (more or {}), compact=True)
            return
        typer.echo(f"{report.asset}: {describe_labels(report)}")
        for problem in report.problems:
            typer.echo("    left out: " + problem.replace("\n", "\n    "))


def describe_labels(report: LabelOutcome) -> str:
    """What became of the labels of an asset."""
    from meshforge.common import pluralize

    parts = [f"{pluralize(report.taken, 'label')} taken"]
    parts += [f"{report.same} there already"] if report.same else []
    parts += [f"{report.kept} kept as a person gave them"] if report.kept else []
    parts += [f"{report.unsure} unsure"] if report.unsure else []
    parts += [f"{pluralize(report.unlabelled, 'hull')} without a label"] if report.unlabelled else []
    return ", ".join(parts)
