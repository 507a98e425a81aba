"""Jobs on assets: decomposing what has no hulls, and running the program."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING
from uuid import uuid4

from meshforge.batch import AssetOutcome, ExecutionOptions, Failed, status_of
from meshforge.common import ProjectError, pluralize
from meshforge.geometry import CoacdSettings, VhacdSettings
from meshforge.project import PreparationResult
from meshforge.studio.edits.assets import Decompose
from meshforge.studio.session.job_runner import JobProgress
from meshforge.studio.wire.jobs import ApplyJob, DecomposeJob, Job, JobLine

if TYPE_CHECKING:
    from meshforge.studio.session.session import Session


def start_decompose(desk: Session, request: DecomposeJob) -> Job:
    """Begin to decompose what some assets have no hulls for."""
    project = desk.project
    desk.check_assets(*request.assets)
    assets, group = tuple(dict.fromkeys(request.assets)), uuid4().hex
    settings = CoacdSettings() if request.method == "coacd" else VhacdSettings()

    @contextmanager
    def keeping(asset: str) -> Iterator[None]:
        with desk.record_edit(Decompose(asset=asset), group):
            yield

    def work(running: JobProgress) -> str:
        made = 0
        results = project.decompose(
            assets, settings, progress=running.advance, stop=lambda: running.is_stopped, keeping=keeping
        )
        for result in results:
            made += len(result.hulls)
            running.add_line(_decompose_line(result))
        return f"{pluralize(made, 'hull')} made for {pluralize(len(assets), 'asset')}."

    return desk.jobs.start("decompose", f"Decomposing {pluralize(len(assets), 'asset')}", len(assets), work)


def _decompose_line(result: PreparationResult) -> JobLine:
    said = "; ".join((*result.problems, *result.notes))
    if result.made:
        return JobLine(asset=result.asset, status="done", text=said or pluralize(len(result.hulls), "hull"))
    return JobLine(asset=result.asset, status="failed" if result.problems else "unchanged", text=said)


def start_apply(desk: Session, request: ApplyJob) -> Job:
    """Begin to run the program on all assets, or on some. Raises ProjectError where there is no program."""
    project = desk.project
    desk.check_assets(*request.assets or ())
    assets = project.assets() if request.assets is None else tuple(dict.fromkeys(request.assets))
    if project.program() is None:
        raise ProjectError("there is no program yet", remedy="Demonstrate what is to be done on an asset or two.")

    def work(running: JobProgress) -> str:
        counts: Counter[str] = Counter()
        outcomes = project.apply(
            assets, execution=ExecutionOptions(stop=lambda: running.is_stopped, progress=running.advance)
        )
        for outcome in outcomes:
            counts[status_of(outcome)] += 1
            running.add_line(_apply_line(outcome))
            desk.note_output(outcome.asset)
        said = ", ".join(f"{number} {word}" for word, number in counts.items())
        return f"{pluralize(len(assets), 'asset')}: {said or 'none'}."

    title = f"Applying the program to {pluralize(len(assets), 'asset')}"
    return desk.jobs.start("apply", title, len(assets), work, str(project.layout.edited))


def _apply_line(outcome: AssetOutcome) -> JobLine:
    if isinstance(outcome, Failed):
        return JobLine(asset=outcome.asset, status="failed", text=outcome.error)
    said = [f"{outcome.before} → {pluralize(outcome.after, 'hull')}", *outcome.notes, *outcome.flags]
    return JobLine(asset=outcome.asset, status=status_of(outcome), text="; ".join(said))
