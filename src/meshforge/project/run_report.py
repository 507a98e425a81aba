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


MOST_HELD = 12
"""Lines on assets that are held, one for each reason."""


def format_counts(signed_off: int, total: int, held: int, excluded: Sequence[ExclusionReason], bar: float) -> str:
    """The sentence that says how far a family is signed off; total: assets, but for those not of the family."""
    foreign = excluded.count(NOT_OF_FAMILY)
    if not total:
        return f"Nothing is signed off: all {foreign} assets are excluded." if foreign else "There is no asset."
    are, were = ("is", "was") if signed_off == 1 else ("are", "were")
    some = f"{signed_off} of {total} {are} at least {100 * bar:g}% sure, or {were} looked at"
    counts = ((reason, excluded.count(reason)) for reason in (NOT_SOLVED, NOT_OF_FAMILY))
    away = "".join(f", {count} excluded: {reason}" for reason, count in counts if count)
    if held:
        return f"{some}{away}; look at {'this one' if held == 1 else f'these {held}'}:"
    return f"{some}{away}." if signed_off else f"Nothing is signed off{away}."


def format_review(found: ProjectReview, held: int = MOST_HELD) -> str:
    """How the family stands: the counts, then why assets are held, the least probable first; held: lines at most."""
    one = found.assessment
    names = one.held
    lines = [format_counts(len(one.signed_off), len(one.assets), len(names), [*one.excluded.values()], one.bar)]
    lines += _format_held([_hold(one.assets[name]) for name in names], held, " (all with --json)")
    if names and one.question is None:
        lines.append(
            "Nothing is left to ask: show the edit on one of these (meshforge demonstrate), or say what is right there."
        )
    return "\n".join(lines)


def format_status(found: Status) -> str:
    """How far a project is signed off by its last review, and what is not, the least sure first."""
    waits = found.count(lambda asset: asset.sign_off == "sure")
    done = waits + found.count(lambda asset: asset.sign_off == "signed off")
    excluded = [asset.excluded for asset in found.assets if asset.excluded] + [NOT_OF_FAMILY] * len(found.not_of_family)
    lines = [format_counts(done, len(found.assets), len(found.open_assets), excluded, found.bar)]
    if waits:
        lines.append(f"  {waits} of them will be signed off when their outputs are up to date (meshforge apply)")
    lines += _format_held([_hold_of_status(asset) for asset in found.open_assets], MOST_HELD)
    doubted = [_AssetDoubt(one.id, None, format_standing(one)) for one in found.assets if one.found_since]
    return "\n".join([*lines, *_format_held(doubted, MOST_HELD)])


@dataclass(frozen=True, slots=True)
class _AssetDoubt:
    """An asset that is held, and its weightiest doubt; probability: that its edit is right, None where not known."""

    name: str
    probability: float | None
    reason: str


def _hold(one: AssetConfidence) -> _AssetDoubt:
    return _AssetDoubt(one.asset, one.probability, one.doubts[0].text if one.doubts else "")


def _hold_of_status(asset: AssetStatus) -> _AssetDoubt:
    if asset.probability is None or asset.void:
        return _AssetDoubt(asset.id, None, format_standing(asset))
    return _hold(AssetConfidence(asset.id, asset.probability, asset.doubts))


def _format_held(held: Sequence[_AssetDoubt], most: int, rest: str = "") -> Iterator[str]:
    """A line for each reason with the assets held for it, in the order given; most: lines; rest: after the others."""
    reasons: dict[str, list[_AssetDoubt]] = {}
    for one in held:
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


def format_standing(asset: AssetStatus) -> str:
    """How one asset stands: how sure its result is, and whether it is signed off, and by whom."""
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


_HELD_BACK = "Nothing was written: this is what the program would make of it."
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
    """The report of a run, what is held first; what was held back is shown as it would be.

    title: by default the name of the project; measures: what is measured of each result. Raises StoppedError where
    `execution.stop` says so.
    """
    found = project.status()
    standings = Counter(map(word_of, found.assets))
    figures = replace(batch.RunFigures.of_run(summary), first="those that failed or are held", standings=standings)
    back = [held.asset for held in summary.held]
    with TemporaryDirectory() as folder:
        held = project.apply(back[: batch.MOST_SHOWN], out=Path(folder)) if back else ()
        doubted = [asset.id for asset in found.open_assets]
        outcomes = batch.choose_outcomes(out, summary, tuple(held), doubted)
        readers, alarms = project.readers(outcome.asset for outcome in outcomes), summary.find_alarms()
        demonstrated = frozenset(project.layout.demonstration.ids)
        assets = list(batch.compare_outcomes(outcomes, program, readers, demonstrated, measures, alarms, execution))
    header = batch.ReportHeader(title or found.name, seconds=seconds, figures=figures, standing=format_status(found))
    return RunReport(header, add_standings(assets, found, back), program)


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
