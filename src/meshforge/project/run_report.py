"""The report of a project's outputs: what the program made of each asset, and how sure that is."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from meshforge import batch
from meshforge.checks import CheckOptions
from meshforge.language import Program
from meshforge.project.sign_off_text import format_result_status, format_status
from meshforge.project.status import AssetStatus, Status

if TYPE_CHECKING:
    from meshforge.project.project import Project

_NOT_WRITTEN = "Nothing was written: this is what the program would make of it."
_NOT_WHOLE = "files of its output are gone or changed: apply the program to it again"


@dataclass(frozen=True, eq=False, slots=True)
class RunReport:
    """What `batch.write_report` writes."""

    header: batch.ReportHeader
    assets: list[batch.ReportAsset]
    program: Program


def summarize_outputs(project: Project) -> batch.RunSummary:
    """What runs have made of each asset so far, as if one run had just made all of it."""
    summary, out = batch.RunSummary(shown=project.reference_measures()), project.layout.edited
    for asset in project.assets():
        stamp = batch.read_stamp(out, asset)
        if stamp is None:
            continue
        if stamp.status != "failed" and not stamp.is_whole(out):
            summary.add(batch.Failed(asset, _NOT_WHOLE, 0.0))
        else:
            summary.add(stamp.to_outcome(out))
    return summary


def build_run_report(
    project: Project,
    program: Program,
    out: Path,
    summary: batch.RunSummary,
    *,
    seconds: float | None = None,
    measures: CheckOptions | None = None,
    title: str | None = None,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
) -> RunReport:
    """The report of a run, what needs review first; what was not written is shown as it would be.

    title: by default the name of the project; measures: what is measured of each result. Raises StoppedError where
    `execution.stop` says so.
    """
    found = project.status()
    result_statuses = Counter(map(word_of, found.assets))
    figures = replace(
        batch.RunFigures.of_run(summary), first="those that failed or need review", result_statuses=result_statuses
    )
    back = [need_review.asset for need_review in summary.need_review]
    with TemporaryDirectory() as folder:
        need_review = project.apply(back[: batch.MOST_SHOWN], out=Path(folder)) if back else ()
        doubted = [asset.id for asset in found.open_assets]
        outcomes = batch.choose_outcomes(out, summary, tuple(need_review), doubted)
        readers, alarms = project.readers(outcome.asset for outcome in outcomes), summary.find_alarms()
        demonstrated = frozenset(project.layout.demonstration.ids)
        assets = list(batch.compare_outcomes(outcomes, program, readers, demonstrated, measures, alarms, execution))
    header = batch.ReportHeader(
        title or found.name, seconds=seconds, figures=figures, result_status=format_status(found)
    )
    return RunReport(header, add_result_status(assets, found, back), program)


def add_result_status(
    assets: Iterable[batch.ReportAsset], found: Status, not_written: Collection[str] = ()
) -> list[batch.ReportAsset]:
    """The assets of a project with how sure each result is; alarms of the run take the place of those of a review."""
    known = {asset.id: asset for asset in found.assets}
    return [_add_result_status(asset, known[asset.name], asset.name in not_written) for asset in assets]


def _add_result_status(shown: batch.ReportAsset, asset: AssetStatus, is_not_written: bool) -> batch.ReportAsset:
    alarms = tuple(reason.text for reason in asset.reasons if reason.kind == "alarm")
    reasons = tuple(reason.text for reason in asset.reasons if reason.kind != "alarm")
    result_status = batch.ResultStatus(word_of(asset), format_result_status(asset), asset.probability, reasons)
    if shown.error:
        return replace(shown, result_status=result_status)
    if is_not_written:
        shown = replace(shown, status="not written", notes=(_NOT_WRITTEN, *shown.notes))
    return replace(shown, result_status=result_status, alarms=shown.alarms or alarms)


def word_of(asset: AssetStatus) -> batch.ResultStatusWord:
    """How an asset of a project stands, in a word."""
    state = asset.sign_off
    return "needs review" if state == "needs review" or state == "void" or state == "unknown" else state
