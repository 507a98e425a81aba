"""The page that `--report` asks for: with a progress bar; and what checks found of assets, where a hundred thousand
need not be kept for that."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from meshforge import batch
from meshforge.checks import CheckOptions, Examination
from meshforge.cli.console import progress
from meshforge.cli.terminal import remark
from meshforge.common import escape_name
from meshforge.formats import load
from meshforge.language import Program

NOTHING_WRITTEN = " (nothing was written)"


def write_report_page(
    path: Path,
    header: batch.ReportHeader,
    assets: Sequence[batch.ReportAsset],
    program: Program | None = None,
) -> None:
    """Write a report with a progress bar on stderr, and say where it is."""
    with progress(len(assets), "drawing") as advance:
        batch.write_report(path, header, assets, program=program, options=batch.ReportOptions(progress=advance))
    remark(f"report: {escape_name(str(path))}")


def describe_failure(outcome: batch.Failed) -> str:
    """Return that an asset failed, and why."""
    return f"failed     {escape_name(outcome.asset)}\n    " + outcome.error.replace("\n", "\n    ")


@dataclass(frozen=True, eq=False, slots=True)
class _ReportLine:
    """What there is to show of one asset; fixed: its file where anything was fixed."""

    job: batch.AssetJob
    status: batch.ReportStatus
    error: str | None
    notes: tuple[str, ...]
    checked: Examination | None
    fixed: Path | None


class CheckReport:
    """Takes what was found as it comes, keeps the assets that are to be shown, and writes the page."""

    def __init__(self) -> None:
        self._counts: Counter[batch.ReportStatus] = Counter()
        self._lines: list[_ReportLine] = []

    def add(self, job: batch.AssetJob, examined: batch.CheckOutcome) -> None:
        """Add one asset."""
        line = _to_line(job, examined)
        self._counts[line.status] += 1
        self._lines.append(line)
        if len(self._lines) >= 2 * batch.MOST_SHOWN:
            self._lines = self._list_first()

    def write(self, path: Path, title: str, measures: CheckOptions, seconds: float) -> None:
        """Write the page; of very many assets it shows some, those with errors first."""
        figures = batch.RunFigures(self._counts, {}, "those that failed or have errors")
        header = batch.ReportHeader(title, _describe_measures(measures), seconds, figures)
        write_report_page(path, header, _to_report_assets(self._list_first()))

    def _list_first(self) -> list[_ReportLine]:
        """Those that are to be shown, those that failed or have errors first, then in the order in which they came."""
        order = ("failed", "errors", "warnings", "clean")
        return sorted(self._lines, key=lambda line: order.index(line.status))[: batch.MOST_SHOWN]


def _to_line(job: batch.AssetJob, examined: batch.CheckOutcome) -> _ReportLine:
    notes = (*describe_changes(examined), *(f"wrote {picture}" for picture in examined.pictures))
    if examined.examination is None:
        return _ReportLine(job, "failed", examined.error, notes, None, None)
    found = {finding.severity for finding in examined.examination.findings}
    status: batch.ReportStatus = "errors" if "error" in found else "warnings" if found else "clean"
    fixed = examined.output if examined.fix_result and examined.fix_result.changes else None
    return _ReportLine(job, status, None, notes, examined.examination, fixed)


def describe_changes(examined: batch.CheckOutcome) -> tuple[str, ...]:
    """Return what was fixed, what was left, and where it was written, a sentence each."""
    fixed = examined.fix_result
    if examined.is_unchanged:
        then = "" if examined.findings else "; nothing was found then"
        return (f"unchanged since the baseline, not checked again{then}",)
    if fixed is None:
        return ()
    return (
        *(f"fixed: {change.description}" for change in fixed.changes),
        *(f"fixed: {escape_name(element)}: each of its hulls is in a file of its own" for element in fixed.parted),
        *fixed.left,
        f"wrote {escape_name(str(examined.output))}",
    )


def _to_report_assets(lines: Sequence[_ReportLine]) -> list[batch.ReportAsset]:
    before: list[batch.MeshReader | None] = [
        None if line.error else partial(batch.read_job, line.job) for line in lines
    ]
    after: list[batch.MeshReader | None] = [partial(load, line.fixed) if line.fixed else None for line in lines]
    meshes = batch.read_again([*before, *after])
    shown = []
    for line, was, now in zip(lines, meshes[: len(lines)], meshes[len(lines) :], strict=True):
        gone = () if was or line.error else ("it cannot be read any more, so there is no picture",)
        shown.append(
            batch.ReportAsset(
                line.job.id,
                was,
                now or was,
                status=line.status,
                error=line.error,
                notes=(*line.notes, *gone),
                checked=line.checked,
            )
        )
    return shown


def _describe_measures(measures: CheckOptions) -> str:
    limits = [f"limits of {measures.engine}"] if measures.engine else []
    parts = ["legality", *limits, *(name for name in measures.names if name != measures.engine)]
    return f"Checked: {', '.join(parts)}."
