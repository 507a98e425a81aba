"""Asking a model for labels, as a job, and finding out first what that would cost; all it changes is undone at once."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING
from uuid import uuid4

from meshforge.errors import MeshForgeError
from meshforge.project import Labelled, VlmForecast, VlmLabelled, VlmSettings
from meshforge.studio.edits.own import LabelFromModel
from meshforge.studio.state.running import Running
from meshforge.studio.wire.jobs import AskJob, ForecastJob, Job, JobLine
from meshforge.words import counted, listed

if TYPE_CHECKING:
    from meshforge.studio.state import Desk


def forecast_job(desk: Desk, request: ForecastJob) -> Job:
    """Begin to find out what asking would send and cost. Raises MeshForgeError where nothing can be asked."""
    project = desk.project
    settings = _settings(desk, request)

    def work(running: Running) -> str:
        found = project.forecast_vlm(settings, progress=running.advance, stop=lambda: running.is_stopped)
        running.raise_if_stopped()
        return _foretold(found)

    title = f"What asking {settings.model} would cost"
    return desk.jobs.start("forecast", title, len(project.assets()), work, stays="nothing was sent.")


def ask_job(desk: Desk, request: AskJob) -> Job:
    """Begin to ask. Raises MeshForgeError where nothing can be asked."""
    project = desk.project
    settings = _settings(desk, request)
    if request.max_cost is not None:
        settings = settings.model_copy(update={"max_cost": request.max_cost})

    @contextmanager
    def keeping() -> Iterator[None]:
        with desk.record_edit(LabelFromModel(model=settings.model), uuid4().hex):
            yield

    def work(running: Running) -> str:
        found = project.label_with_vlm(
            settings, progress=lambda bill: running.advance(), stop=lambda: running.is_stopped, keeping=keeping
        )
        for report in found.reports:
            running.add_line(_line(report, found))
        if found.ended and not running.is_stopped:
            raise MeshForgeError(f"The asking ended early: {found.ended}", remedy=_said(found))
        return _said(found)

    return desk.jobs.start("ask", f"Asking {settings.model}", len(project.assets()), work, stays="nothing was asked.")


def _settings(desk: Desk, request: ForecastJob | AskJob) -> VlmSettings:
    """Those of the project, which are tried out before anything long begins."""
    settings = desk.project.settings.vlm.model_copy(update={"mode": request.mode})
    settings.check(desk.project.vocabulary)
    return settings


def _foretold(found: VlmForecast) -> str:
    fresh = found.questions - found.known
    if not fresh:
        return "Every question has its answer already: asking again costs nothing."
    known = f", {found.known} more are answered already" if found.known else ""
    cost = "price not known" if found.cost is None else f"about ${found.cost:.4f}"
    sent = f"{counted(fresh, 'question')} with {counted(found.pictures, 'picture')} to {found.host}{known}"
    return f"{sent}; about {found.input:,} tokens: {cost}."


def _line(report: Labelled, found: VlmLabelled) -> JobLine:
    if report.problems:
        return JobLine(asset=report.asset, status="failed", text="; ".join(report.problems))
    bare = found.open.get(report.asset, {})
    said = [counted(report.taken, "label")] + ([f"none for {listed(list(bare), most=3)}"] if bare else [])
    return JobLine(asset=report.asset, status="done" if report.taken else "unchanged", text=", ".join(said))


def _said(found: VlmLabelled) -> str:
    taken, bill = sum(report.taken for report in found.reports), found.usage
    bare = sum(map(len, found.open.values()))
    cost = f"{bill.usage.input + bill.usage.output:,} tokens" if bill.cost is None else f"${bill.cost:.4f}"
    parts = [f"{counted(taken, 'label')} taken"]
    parts += [f"{counted(bare, 'hull')} left without"] if bare else []
    parts += [f"{counted(len(found.unasked), 'asset')} not asked about"] if found.unasked else []
    return f"{', '.join(parts)}; {cost}."
