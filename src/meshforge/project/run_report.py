"""How sure the results of a project are, in sentences: for `review`, `status`, `apply`, downloads and the report of its
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
from meshforge.project.status import AssetStatus, Status
from meshforge.signoff import AssetConfidence, ExclusionReason
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
    """Return how the family stands: the counts, then why assets need review, the least probable first; need_review:
    lines at most."""
    one = found.assessment
    names = one.need_review
    lines = [format_counts(len(one.signed_off), len(one.assets), len(names), [*one.excluded.values()], one.threshold)]
    lines += _format_assets([_to_line(one.assets[name]) for name in names], need_review, " (all with --json)")
    if names and one.question is None:
        lines.append(
            "Nothing is left to ask: show the edit on one of these (meshforge demonstrate), or say what is right there."
        )
    return "\n".join(lines)


def format_status(found: Status) -> str:
    """Return how far a project is signed off by its last review, and what is not, the least sure first."""
    waits = found.count(lambda asset: asset.sign_off == "sure")
    done = waits + found.count(lambda asset: asset.sign_off == "signed off")
    excluded = [asset.excluded for asset in found.assets if asset.excluded] + [NOT_OF_FAMILY] * len(found.not_of_family)
    lines = [format_counts(done, len(found.assets), len(found.open_assets), excluded, found.threshold)]
    if waits:
        lines.append(f"  {waits} of them will be signed off when their outputs are up to date (meshforge apply)")
    lines += _format_assets([_status_to_line(asset) for asset in found.open_assets], MOST_LISTED)
    doubted = [_AssetReason(one.id, None, format_result_status(one)) for one in found.assets if one.found_since]
    return "\n".join([*lines, *_format_assets(doubted, MOST_LISTED)])


@dataclass(frozen=True, slots=True)
class _AssetReason:
    """An asset that needs review, and its weightiest reason; probability: that its edit is right, None where not
    known."""

    name: str
    probability: float | None
    reason: str


def _to_line(one: AssetConfidence) -> _AssetReason:
    return _AssetReason(one.asset, one.probability, one.reasons[0].text if one.reasons else "")


def _status_to_line(asset: AssetStatus) -> _AssetReason:
    if asset.probability is None or asset.void:
        return _AssetReason(asset.id, None, format_result_status(asset))
    return _to_line(AssetConfidence(asset.id, asset.probability, asset.reasons))


def _format_assets(need_review: Sequence[_AssetReason], most: int, rest: str = "") -> Iterator[str]:
    """A line for each reason with the assets held for it, in the order given; most: lines; rest: after the others."""
    reasons: dict[str, list[_AssetReason]] = {}
    for one in need_review:
        reasons.setdefault(one.reason, []).append(one)
    for reason, some in list(reasons.items())[:most]:
        shares = [one.probability for one in some if one.probability is not None]
        share = f" ({_format_range(shares)})" if shares else ""
        yield f"  {join_names([one.name for one in some])}{share}{': ' if reason else ''}{reason}"
    more = sum(map(len, list(reasons.values())[most:]))
    if more:
        yield f"  and {more} more{rest}"


def _format_range(shares: Sequence[float]) -> str:
    return " to ".join(dict.fromkeys(map(format_share, (min(shares), max(shares)))))


def format_result_status(asset: AssetStatus) -> str:
    """Return how one asset stands: how sure its result is, and whether it is signed off, and by whom."""
    if asset.sign_off == "void":
        return f"void, {join_names(asset.void)} changed since it was signed off"
    if asset.sign_off == "unknown":
        return "not looked at as it is now (meshforge review)"
    share = "" if asset.probability is None else f"{format_share(asset.probability)} sure, "
    if asset.sign_off == "sure":
        return f"{share}signed off when its output is up to date (meshforge apply)"
    who = {"tool": " by MeshForge", "person": " by a person", None: ""}[asset.signed_by]
    since = f"; found since: {'; '.join(asset.found_since)}" if asset.found_since else ""
    return f"{share}{asset.sign_off}{who}{since}"


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
    """Return the assets of a project with how sure each result is; alarms of the run take the place of those of a
    review."""
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
    """Return how an asset of a project stands, in a word."""
    state = asset.sign_off
    return "needs review" if state == "needs review" or state == "void" or state == "unknown" else state
