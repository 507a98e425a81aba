"""The page that `--report` asks for: assets before and after a run as it shows them; and what checks found of assets,
where a hundred thousand need not be kept for that.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from meshforge import batch
from meshforge.checks import CheckOptions, Examination, Finding, Severity
from meshforge.cli.console import progress
from meshforge.cli.review_text import format_standing
from meshforge.cli.terminal import remark
from meshforge.formats import load
from meshforge.language import Program, RuleTrace, to_canonical_frame
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from meshforge.project import AssetStatus, Status

NOTHING_WRITTEN = " (nothing was written)"
_HELD_BACK = "Nothing was written: this is what the program would make of it."


def write_report_page(
    path: Path,
    header: batch.ReportHeader,
    assets: Sequence[batch.ReportAsset],
    program: Program | None = None,
    options: batch.ReportOptions = batch.REPORT_DEFAULTS,
) -> None:
    """Write a report with a progress bar on stderr, and say where it is."""
    with progress(len(assets), "drawing") as advance:
        batch.write_report(path, header, assets, program=program, options=replace(options, progress=advance))
    remark(f"report: {path}")


def compare_outcomes(
    outcomes: Sequence[batch.AssetOutcome],
    program: Program,
    readers: Sequence[batch.MeshReader],
    demonstrated: Collection[str] = (),
    measures: CheckOptions | None = None,
    alarms: Mapping[str, tuple[str, ...]] | None = None,
) -> Iterator[batch.ReportAsset]:
    """Each asset before and after, standing upright where the program orients it; readers: of the assets before.

    measures: what is measured of it after; such assets are shown as they lie, for what they show was not turned.
    alarms: sentences about results that stand out, by asset.
    """
    made = [None if isinstance(outcome, batch.Failed) else partial(load, outcome.out) for outcome in outcomes]
    meshes = batch.read_again([*readers, *made])
    pairs = list(zip(outcomes, meshes[: len(made)], meshes[len(made) :], strict=True))
    todo = [
        (Path(outcome.out), after, measures, before)
        for outcome, before, after in pairs
        if measures and before and after and not isinstance(outcome, batch.Failed)
    ]
    found = batch.execute(_examine, todo, batch.ExecutionOptions(timeout=batch.READ_TIMEOUT))
    for outcome, was, now in pairs:
        name, is_shown = outcome.asset, outcome.asset in demonstrated
        if isinstance(outcome, batch.Failed) or was is None or now is None:
            error = outcome.error if isinstance(outcome, batch.Failed) else "it cannot be read any more"
            yield batch.ReportAsset(name, was, status="failed", error=error, demonstrated=is_shown)
            continue
        checked, notes = None, outcome.notes
        if measures:
            checked, problem = _split_checks(next(found))
            notes = (*notes, *problem)
        else:
            was, pose = to_canonical_frame(was, program.orient, program.contact)
            now = replace(now, hulls=tuple(hull.move(pose) for hull in now.hulls))
        trace = tuple(RuleTrace(line.rule, line.selected, line.made, line.note) for line in outcome.rules)
        told = (alarms or {}).get(name, ())
        yield batch.ReportAsset(name, was, now, trace, batch.status_of(outcome), None, is_shown, notes, checked, told)


def add_standings(
    assets: Iterable[batch.ReportAsset], found: Status, held_back: Collection[str] = ()
) -> list[batch.ReportAsset]:
    """The assets of a project with how sure each result is; alarms of the run take the place of those of a review."""
    known = {asset.id: asset for asset in found.assets}
    return [_add_standing(asset, known[asset.name], asset.name in held_back) for asset in assets]


def _add_standing(shown: batch.ReportAsset, asset: AssetStatus, is_held_back: bool) -> batch.ReportAsset:
    alarms = tuple(doubt.text for doubt in asset.doubts if doubt.kind == "alarm")
    doubts = tuple(doubt.text for doubt in asset.doubts if doubt.kind != "alarm")
    standing = batch.AssetStanding(word_of(asset), format_standing(asset), asset.probability, doubts)
    if shown.error:
        return replace(shown, standing=standing)
    if is_held_back:
        shown = replace(shown, status="held back", notes=(_HELD_BACK, *shown.notes))
    return replace(shown, standing=standing, alarms=shown.alarms or alarms)


def word_of(asset: AssetStatus) -> batch.StandingWord:
    """How an asset of a project stands, in a word."""
    state = asset.sign_off
    return "held" if state == "held" or state == "void" or state == "unknown" else state


def _split_checks(found: Examination | batch.WorkerFailure) -> tuple[Examination | None, tuple[str, ...]]:
    """What was measured, or why it was not."""
    if isinstance(found, batch.WorkerFailure):
        return None, (f"the checks did not come to an end: {found.why}",)
    return found, ()


def _examine(work: tuple[Path, SymbolicMesh, CheckOptions, SymbolicMesh | None]) -> Examination:
    """In a process of its own, since MuJoCo may crash."""
    return batch.examine_file(*work)


def describe_failure(outcome: batch.Failed) -> str:
    """That an asset failed, and why."""
    return f"failed     {outcome.asset}\n    " + outcome.error.replace("\n", "\n    ")


_FROM_JOURNAL = "kept in the journal from an earlier run"


@dataclass(frozen=True, eq=False, slots=True)
class _ReportLine:
    """What there is to show of one asset; fixed: its file where anything was fixed."""

    job: batch.AssetJob
    status: batch.ReportStatus
    error: str | None
    notes: tuple[str, ...]
    checked: Examination | batch.EarlierExamination | None
    fixed: Path | None


class CheckReport:
    """Takes what was found as it comes, keeps the assets that are to be shown, and writes the page."""

    def __init__(self) -> None:
        self._counts: Counter[batch.ReportStatus] = Counter()
        self._lines: batch.TopItems[_ReportLine] = batch.TopItems()

    def add(self, job: batch.AssetJob, examined: batch.CheckOutcome | None, row: Mapping[str, Any]) -> None:
        """One asset more; row: as the journal keeps it, which is all there is where nothing was examined anew."""
        line = _line_of_examined(job, examined) if examined else _line_of_journal(job, row)
        self._counts[line.status] += 1
        self._lines.add(("failed", "errors", "warnings", "clean").index(line.status), line)

    def write(self, path: Path, title: str, measures: CheckOptions, seconds: float) -> None:
        """Write the page; of very many assets it shows some, those with errors first."""
        figures = batch.RunFigures(self._counts, {}, "those that failed or have errors")
        header = batch.ReportHeader(title, _describe_measures(measures), seconds, figures)
        write_report_page(path, header, _to_report_assets(list(self._lines)))


def _line_of_examined(job: batch.AssetJob, examined: batch.CheckOutcome) -> _ReportLine:
    notes = (*describe_changes(examined), *(f"wrote {picture}" for picture in examined.pictures))
    if examined.examination is None:
        return _ReportLine(job, "failed", examined.error, notes, None, None)
    status = _status(finding.severity for finding in examined.examination.findings)
    fixed = examined.output if examined.fix_result and examined.fix_result.changes else None
    return _ReportLine(job, status, None, notes, examined.examination, fixed)


def _line_of_journal(job: batch.AssetJob, row: Mapping[str, Any]) -> _ReportLine:
    """What the journal has of an asset; its heat maps are not measured anew."""
    found = row["found"]
    findings = tuple(Finding(**{**finding, "hulls": tuple(finding["hulls"])}) for finding in found["findings"])
    fix = found.get("fixed")
    kept = batch.EarlierExamination(findings, tuple(row.get("told", ())))
    fixed = Path(fix["out"]) if fix and fix["changes"] else None
    return _ReportLine(job, _status(finding.severity for finding in findings), None, (_FROM_JOURNAL,), kept, fixed)


def _status(severities: Iterable[Severity]) -> batch.ReportStatus:
    found = set(severities)
    return "errors" if "error" in found else "warnings" if found else "clean"


def describe_changes(examined: batch.CheckOutcome) -> tuple[str, ...]:
    """What was fixed, what was left, and where it was written, a sentence each."""
    fixed = examined.fix_result
    if fixed is None:
        return ()
    return (*(f"fixed: {change.description}" for change in fixed.changes), *fixed.left, f"wrote {examined.output}")


def _to_report_assets(lines: Sequence[_ReportLine]) -> list[batch.ReportAsset]:
    """The assets with their meshes, fixed ones before and after."""
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
    """What was looked at."""
    parts = ["legality"]
    parts += [f"limits of {measures.engine}"] if measures.engine else []
    parts += [name for name in ("fit", "clearance", "physics") if getattr(measures, name)]
    parts += measures.plugins
    return f"Checked: {', '.join(parts)}."
