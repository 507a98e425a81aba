"""Making hulls of what has none, as a job; each asset can be undone, all of the job together."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING
from uuid import uuid4

from meshforge.geometry.decompose import CoacdSettings, VhacdSettings
from meshforge.project import Prepared
from meshforge.studio.edits.own import Decompose
from meshforge.studio.state.running import Running
from meshforge.studio.wire.jobs import DecomposeJob, Job, JobLine
from meshforge.words import counted

if TYPE_CHECKING:
    from meshforge.studio.state import Desk


def decompose_job(desk: Desk, request: DecomposeJob) -> Job:
    """Begin to decompose what some assets have no hulls for."""
    project = desk.project
    desk.check_assets(*request.assets)
    assets, group = tuple(dict.fromkeys(request.assets)), uuid4().hex
    settings = CoacdSettings() if request.method == "coacd" else VhacdSettings()

    @contextmanager
    def keeping(asset: str) -> Iterator[None]:
        with desk.record_edit(Decompose(asset=asset), group):
            yield

    def work(running: Running) -> str:
        made = 0
        results = project.decompose(
            assets, settings, progress=running.advance, stop=lambda: running.is_stopped, keeping=keeping
        )
        for result in results:
            made += len(result.hulls)
            running.add_line(_line(result))
        return f"{counted(made, 'hull')} made for {counted(len(assets), 'asset')}."

    return desk.jobs.start("decompose", f"Decomposing {counted(len(assets), 'asset')}", len(assets), work)


def _line(result: Prepared) -> JobLine:
    said = "; ".join((*result.problems, *result.notes))
    if result.made:
        return JobLine(asset=result.asset, status="done", text=said or counted(len(result.hulls), "hull"))
    return JobLine(asset=result.asset, status="failed" if result.problems else "unchanged", text=said)
