"""Which outcomes of a run its report shows, and the meshes before and after of each."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from meshforge.batch.check import examine_file
from meshforge.batch.execution import execute
from meshforge.batch.outcome import MOST_SHOWN, AssetOutcome, Failed, RuleEffect, RunSummary
from meshforge.batch.provenance import read_stamp
from meshforge.batch.report.contents import READ_TIMEOUT, MeshReader, ReportAsset, read_again
from meshforge.batch.workers import EXECUTION_DEFAULTS, ExecutionOptions, WorkerFailure
from meshforge.checks import CheckOptions, Examination
from meshforge.common import join_names
from meshforge.formats import load
from meshforge.language import Program, RuleTrace, to_canonical_frame
from meshforge.symbolic import SymbolicMesh


def choose_outcomes(
    out: Path, summary: RunSummary, need_review: Sequence[AssetOutcome] = (), doubted: Sequence[str] = ()
) -> list[AssetOutcome]:
    """Return those that a report shows; of too many failed ones, then those in doubt or with alarms, then the first
    others.

    need_review: what would have become of those that were not written; alarms are looked for among these, too. doubted:
    ids.
    """
    known = {outcome.asset: outcome for outcome in (*need_review, *summary.outcomes_to_show)}
    summary.measures |= {one.asset: one.measures for one in need_review if not isinstance(one, Failed) and one.measures}
    remarkable = [*doubted, *summary.find_alarms()]
    for name in remarkable[:MOST_SHOWN]:
        stamp = None if name in known else read_stamp(out, name)
        if stamp and stamp.is_whole(out):
            known[name] = stamp.to_skipped(out)
    order = dict.fromkeys([*(failed.asset for failed in summary.failed), *remarkable, *known])
    chosen = set([name for name in order if name in known][:MOST_SHOWN])
    return [outcome for name, outcome in known.items() if name in chosen]


def compare_outcomes(
    outcomes: Sequence[AssetOutcome],
    program: Program,
    readers: Sequence[MeshReader],
    demonstrated: Collection[str] = (),
    measures: CheckOptions | None = None,
    alarms: Mapping[str, tuple[str, ...]] | None = None,
    execution: ExecutionOptions = EXECUTION_DEFAULTS,
) -> Iterator[ReportAsset]:
    """Yield each asset before and after, standing upright where the program orients it; readers: of the assets before.

    measures: what is measured of it after; such assets are shown as they lie, for what they show was not turned.
    alarms: sentences about results that stand out, by asset. Raises StoppedError where `execution.stop` says so.
    """
    made = [None if isinstance(outcome, Failed) else partial(load, outcome.out) for outcome in outcomes]
    meshes = read_again([*readers, *made], execution)
    pairs = list(zip(outcomes, meshes[: len(made)], meshes[len(made) :], strict=True))
    todo = [
        (Path(outcome.out), after, measures, before)
        for outcome, before, after in pairs
        if measures and before and after and not isinstance(outcome, Failed)
    ]
    found = execute(_examine, todo, replace(execution, timeout=READ_TIMEOUT))
    for outcome, was, now in pairs:
        name, is_shown = outcome.asset, outcome.asset in demonstrated
        if isinstance(outcome, Failed) or was is None or now is None:
            error = outcome.error if isinstance(outcome, Failed) else "it cannot be read any more"
            yield ReportAsset(name, was, status="failed", error=error, demonstrated=is_shown)
            continue
        checked, notes = None, outcome.notes
        if measures:
            result = next(found)
            if isinstance(result, WorkerFailure):
                notes = (*notes, f"the checks did not come to an end: {result.why}")
            else:
                checked = result
        else:
            was, pose = to_canonical_frame(was, program.orient, program.contact)
            was = was.with_view_up("z") if program.orient and program.orient.names_z else was
            now = replace(now, hulls=tuple(hull.move(pose) for hull in now.hulls))
        now = now.with_view_up(was.asset.view_up) if was.asset else now
        trace = tuple(RuleTrace(line.rule, line.selected, line.made, _describe(line)) for line in outcome.rules)
        alarms_of = (alarms or {}).get(name, ())
        yield ReportAsset(name, was, now, trace, outcome.status, None, is_shown, notes, checked, alarms_of)


def _describe(line: RuleEffect) -> str | None:
    """The note on what a rule did, with the names that are gone."""
    gone = f"names that are gone: {join_names(line.gone, 5)}" if line.gone else None
    return "; ".join(filter(None, [line.note, gone])) or None


def _examine(work: tuple[Path, SymbolicMesh, CheckOptions, SymbolicMesh | None]) -> Examination:
    """In a process of its own, since MuJoCo may crash."""
    return examine_file(*work)
