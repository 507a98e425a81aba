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
from meshforge.project.sign_off_text import format_standing, format_status
from meshforge.project.status import AssetStatus, Status

if TYPE_CHECKING:
    from meshforge.project.project import Project

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
