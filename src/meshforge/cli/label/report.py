"""The page about the labels of a project: each asset in the colours of its labels, and what became of those given."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.batch import Figures, Labelling
    from meshforge.project import Labelled, Project, Tally

_ABOUT = {
    "file": "Labels taken over from files.",
    "names": "Labels read off the names of hulls and bodies.",
    "propagate": "Labels of a few assets carried to all others.",
    "vlm": "Labels by a vision-language model.",
}
_DOUBTFUL = "Doubtful assets have hulls without a label, or with an unsure one."
_PROBLEMS = 20  # of one asset that are shown
_RANKS: tuple[Labelling, ...] = ("problems", "doubtful", "labelled")


class LabelReport:
    """Takes what became of assets as it comes, and writes the page; source: where labels come from, as of `--with`."""

    def __init__(self, path: Path, source: str) -> None:
        self._path, self._started = path, perf_counter()
        self._about = [_ABOUT[source]]
        self._reports: dict[str, Labelled] = {}
        self._problems: dict[str, Sequence[str]] = {}
        self._notes: dict[str, Sequence[str]] = {}

    def add(self, report: Labelled) -> None:
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
        from meshforge.batch import ReportAsset, read_again
        from meshforge.batch.report import PICTURED
        from meshforge.cli.report import report

        for asset, why in tally.unreadable:
            if not self._problems.get(asset):
                self._problems[asset] = (why,)
        doubtful = dict(tally.doubtful)
        status = {asset: self._status(asset, doubtful) for asset in project.assets()}
        order = sorted(status, key=lambda asset: (_RANKS.index(status[asset]), -doubtful.get(asset, 0)))[:PICTURED]
        report(
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

    def _status(self, asset: str, doubtful: Mapping[str, int]) -> Labelling:
        if self._problems.get(asset):
            return "problems"
        return "doubtful" if asset in doubtful else "labelled"

    def _figures(self, status: Mapping[str, Labelling], tally: Tally) -> Figures:
        from meshforge.batch import Figures

        reports, unsure = self._reports.values(), sum(share.unsure for share in tally.shares)
        numbers = {
            "hulls": tally.hulls,
            "labels taken": sum(report.taken for report in reports),
            "kept as people gave them": sum(report.kept for report in reports),
            "unsure": unsure,
            "without a label": tally.unlabelled,
        }
        more = {name: (f"{n:,}", None) for name, n in numbers.items() if n or name in ("hulls", "labels taken")}
        return Figures(Counter(status.values()), more, "those with problems or labels in doubt")

    def _error(self, asset: str) -> str | None:
        problems = self._problems.get(asset, ())
        more = len(problems) - _PROBLEMS
        lines = [*problems[:_PROBLEMS], *([f"and {more:,} more"] if more > 0 else [])]
        return "\n".join(lines) or None

    def _notes_on(self, asset: str, doubtful: Mapping[str, int]) -> tuple[str, ...]:
        from meshforge.cli.label.given import told
        from meshforge.words import counted

        report, lacking = self._reports.get(asset), doubtful.get(asset)
        given = told(report) if report else "given no labels this time"
        if not report and lacking:
            given += f", {counted(lacking, 'hull')} without a label or unsure"
        return (given, *self._notes.get(asset, ()))
