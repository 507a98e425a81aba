"""Running the program on assets, as a job."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from meshforge.batch import Failed, Outcome, status
from meshforge.errors import ProjectError
from meshforge.studio.state.running import Running
from meshforge.studio.wire.jobs import ApplyJob, Job, JobLine
from meshforge.words import counted

if TYPE_CHECKING:
    from meshforge.studio.state import Desk


def apply_job(desk: Desk, request: ApplyJob) -> Job:
    """Begin to run the program on all assets, or on some. Raises ProjectError where there is no program."""
    project = desk.project
    desk.check_assets(*request.assets or ())
    assets = project.assets() if request.assets is None else tuple(dict.fromkeys(request.assets))
    if project.program() is None:
        raise ProjectError("there is no program yet", remedy="Demonstrate what is to be done on an asset or two.")

    def work(running: Running) -> str:
        counts: Counter[str] = Counter()
        outcomes = project.apply(assets, progress=running.advance, stop=lambda: running.is_stopped)
        for outcome in outcomes:
            counts[status(outcome)] += 1
            running.add_line(_line(outcome))
            desk.note_output(outcome.asset)
        said = ", ".join(f"{number} {word}" for word, number in counts.items())
        return f"{counted(len(assets), 'asset')}: {said or 'none'}."

    title = f"Applying the program to {counted(len(assets), 'asset')}"
    return desk.jobs.start("apply", title, len(assets), work, str(project.layout.edited))


def _line(outcome: Outcome) -> JobLine:
    if isinstance(outcome, Failed):
        return JobLine(asset=outcome.asset, status="failed", text=outcome.error)
    said = [f"{outcome.before} → {counted(outcome.after, 'hull')}", *outcome.notes, *outcome.flags]
    return JobLine(asset=outcome.asset, status=status(outcome), text="; ".join(said))
