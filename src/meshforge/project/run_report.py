"""How sure the results of a project are, in sentences: for `review`, `status`, `apply`, exports and the report of its
outputs, which is built here."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from meshforge import batch
from meshforge.common import format_share, join_names
from meshforge.project.status import Status
from meshforge.signoff import ExclusionReason, ResultStatus
from meshforge.signoff.question import NOT_OF_FAMILY, NOT_SOLVED

if TYPE_CHECKING:
    from meshforge.checks import CheckOptions
    from meshforge.language import Program
    from meshforge.project.project import Project
    from meshforge.project.review import ProjectReview


MOST_LISTED = 12
"""Lines on assets that need review, one for each reason."""


def format_counts(
    signed_off: int, total: int, need_review: int, excluded: Sequence[ExclusionReason], threshold: float
) -> str:
    """Return the sentence that says how far a family is signed off; total: assets, but for those not of the family."""
    others = excluded.count(NOT_OF_FAMILY)
    if not total:
        return f"Nothing is signed off: all {others} assets are excluded." if others else "There is no asset."
    are, were = ("is", "was") if signed_off == 1 else ("are", "were")
    some = f"{signed_off} of {total} {are} at least {100 * threshold:g}% sure, or {were} looked at"
    counts = ((reason, excluded.count(reason)) for reason in (NOT_SOLVED, NOT_OF_FAMILY))
    away = "".join(f", {count} excluded: {reason}" for reason, count in counts if count)
    if need_review:
        return f"{some}{away}; look at {'this one' if need_review == 1 else f'these {need_review}'}:"
    return f"{some}{away}." if signed_off else f"Nothing is signed off{away}."


def format_review(found: ProjectReview, need_review: int = MOST_LISTED) -> str:
    """Return how the family stands: counts, then why assets need review, the least probable first, at most so many."""
    one = found.assessment
    names = one.need_review
    lines = [format_counts(len(one.signed_off), len(one.assets), len(names), [*one.excluded.values()], one.threshold)]
    lines += _format_assets([(name, one.assets[name]) for name in names], need_review, " (all with --json)")
    lines += _format_goals((name, one.assets[name]) for name in one.assets if name not in {*names, *one.excluded})
    if names and one.question is None:
        lines.append(
            "Nothing is left to ask: show the edit on one of these (meshforge demonstrate), or say what is right there."
        )
    return "\n".join(lines)


def format_status(found: Status) -> str:
    """Return how far a project is signed off by its last review, and what is not, the least sure first."""
    waits = found.count(lambda asset: asset.result_status.state == "sure")
    done = waits + found.count(lambda asset: asset.result_status.state == "signed off")
    excluded = [asset.result_status.excluded for asset in found.assets if asset.result_status.excluded]
    excluded += [NOT_OF_FAMILY] * len(found.not_of_family)
    lines = [format_counts(done, len(found.assets), len(found.open_assets), excluded, found.threshold)]
    if waits:
        lines.append(f"  {waits} of them will be signed off when their outputs are up to date (meshforge apply)")
    lines += _format_assets([(asset.id, asset.result_status) for asset in found.open_assets], MOST_LISTED)
    doubted = [(asset.id, asset.result_status) for asset in found.assets if asset.result_status.found_since]
    lines += _format_assets(doubted, MOST_LISTED)
    others = [(one.id, one.result_status) for one in found.assets if not one.result_status.needs_review]
    return "\n".join([*lines, *_format_goals(others)])


def _format_goals(found: Iterable[tuple[str, ResultStatus]]) -> Iterator[str]:
    """A line for each goal that fails or was not tried on results."""
    rows = dict[str, list[str]]()
    for name, one in found:
        for goal in one.open_goals:
            rows.setdefault(goal.describe(), []).append(name)
    yield from (f"  {text}: {join_names(names)}" for text, names in rows.items())


def _format_assets(need_review: Sequence[tuple[str, ResultStatus]], most: int, rest: str = "") -> Iterator[str]:
    """A line for each reason with the assets held for it, in the order given; most: lines; rest: after the others."""
    reasons: dict[str, list[tuple[str, float | None]]] = {}
    for name, one in need_review:
        if one.probability is None or one.void or one.found_since:
            reasons.setdefault(one.describe(), []).append((name, None))
        else:
            reasons.setdefault(one.reasons[0].text if one.reasons else "", []).append((name, one.probability))
    for reason, some in list(reasons.items())[:most]:
        shares = [share for _, share in some if share is not None]
        interval = f" ({_format_range(shares)})" if shares else ""
        yield f"  {join_names([name for name, _ in some])}{interval}{': ' if reason else ''}{reason}"
    more = sum(map(len, list(reasons.values())[most:]))
    if more:
        yield f"  and {more} more{rest}"


def _format_range(shares: Sequence[float]) -> str:
    return " to ".join(dict.fromkeys(map(format_share, (min(shares), max(shares)))))


_NOT_WRITTEN = "Nothing was written: this is what the program would make of it."
_NOT_WHOLE = "files of its output are gone or changed: apply the program to it again"


@dataclass(frozen=True, eq=False, slots=True)
class RunReport:
    """What `batch.write_report` writes."""

    header: batch.ReportHeader
    assets: list[batch.ReportAsset]
    program: Program


def summarize_outputs(project: Project) -> batch.RunSummary:
    """Return what runs have made of each asset so far, as if one run had just made all of it."""
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
    """Return the report of a run, what needs review first; what was not written is shown as it would be.

    title: by default the name of the project; measures: what is measured of each result. Raises StoppedError where
    `execution.stop` says so.
    """
    found = project.status()
    result_statuses = Counter(asset.result_status.word for asset in found.assets)
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
    """Return the assets of a project with how sure each result is; alarms of the run replace those of a review."""
    known = {asset.id: asset.result_status for asset in found.assets}
    return [_add_result_status(asset, known[asset.name], asset.name in not_written) for asset in assets]


def _add_result_status(shown: batch.ReportAsset, found: ResultStatus, is_not_written: bool) -> batch.ReportAsset:
    shown = replace(shown, result_status=found)
    if shown.error:
        return shown
    if is_not_written:
        shown = replace(shown, status="not written", notes=(_NOT_WRITTEN, *shown.notes))
    alarms = tuple(reason.text for reason in found.reasons if reason.kind == "alarm")
    return replace(shown, alarms=shown.alarms or alarms)
