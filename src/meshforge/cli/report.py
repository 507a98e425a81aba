"""The page that `--report` asks for, and assets before and after a run, as it shows them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from meshforge import batch
from meshforge.checks import CheckOptions, Examination, examine_mesh
from meshforge.cli.console import progress
from meshforge.cli.terminal import remark
from meshforge.formats import load
from meshforge.language import Program, RuleTrace, to_canonical_frame
from meshforge.symbolic import SymbolicMesh

NOTHING_WRITTEN = " (nothing was written)"


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
) -> Iterator[batch.ReportAsset]:
    """Each asset before and after, standing upright where the program orients it; readers: of the assets before.

    measures: what is measured of it after; such assets are shown as they lie, for what they show was not turned.
    """
    made = [None if isinstance(outcome, batch.Failed) else partial(load, outcome.out) for outcome in outcomes]
    meshes = batch.read_again([*readers, *made])
    pairs = list(zip(outcomes, meshes[: len(made)], meshes[len(made) :], strict=True))
    todo = [(after, measures, before) for _, before, after in pairs if before and after] if measures else []
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
        yield batch.ReportAsset(name, was, now, trace, batch.status_of(outcome), None, is_shown, notes, checked)


def _split_checks(found: Examination | batch.WorkerFailure) -> tuple[Examination | None, tuple[str, ...]]:
    """What was measured, or why it was not."""
    if isinstance(found, batch.WorkerFailure):
        return None, (f"the checks did not come to an end: {found.why}",)
    return found, ()


def _examine(work: tuple[SymbolicMesh, CheckOptions, SymbolicMesh | None]) -> Examination:
    """In a process of its own, since MuJoCo may crash."""
    return examine_mesh(*work)


def describe_failure(outcome: batch.Failed) -> str:
    """That an asset failed, and why."""
    return f"failed     {outcome.asset}\n    " + outcome.error.replace("\n", "\n    ")
