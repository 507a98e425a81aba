"""Jobs that label the family: propagation, and asking a model (and what that would cost); all is undone at once."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING
from uuid import uuid4

from meshforge.batch import ExecutionOptions, record_digest
from meshforge.common import MeshForgeError, ProjectError, join_names, pluralize
from meshforge.labels import LabelOutcome, PropagationResult, VlmForecast, VlmResult, check_vlm_settings
from meshforge.project import Project
from meshforge.store import VlmSettings
from meshforge.studio.edits.labels import LabelFromModel, Propagate
from meshforge.studio.errors import ConflictError
from meshforge.studio.session.job_runner import JobProgress
from meshforge.studio.wire.jobs import AskJob, ForecastJob, Job, JobLine
from meshforge.symbolic import GIVEN_SOURCES

if TYPE_CHECKING:
    from meshforge.studio.session.session import Session


_REMEDY = "Carry labels over again."


def start_forecast(desk: Session, request: ForecastJob) -> Job:
    """Begin to find out what asking would send and cost. Raises MeshForgeError where nothing can be asked."""
    project = desk.project
    settings = _check_settings(desk, request)

    def work(running: JobProgress) -> str:
        found = project.forecast_vlm(settings, progress=running.advance, stop=lambda: running.is_stopped)
        running.raise_if_stopped()
        return _describe_forecast(found)

    title = f"What asking {settings.model} would cost"
    return desk.jobs.start("forecast", title, len(project.assets()), work, stays="nothing was sent.")


def start_ask(desk: Session, request: AskJob) -> Job:
    """Begin to ask. Raises MeshForgeError where nothing can be asked."""
    project = desk.project
    settings = _check_settings(desk, request)
    if request.max_cost is not None:
        settings = settings.model_copy(update={"max_cost": request.max_cost})

    @contextmanager
    def keeping() -> Iterator[None]:
        with desk.record_edit(LabelFromModel(model=settings.model), uuid4().hex):
            yield

    def work(running: JobProgress) -> str:
        found = project.label_with_vlm(
            settings, progress=lambda bill: running.advance(), stop=lambda: running.is_stopped, keeping=keeping
        )
        for report in found.reports:
            running.add_line(_answers_line(report, found))
        if found.ended and not running.is_stopped:
            raise MeshForgeError(f"The asking ended early: {found.ended}", remedy=_describe_answers(found))
        return _describe_answers(found)

    return desk.jobs.start("ask", f"Asking {settings.model}", len(project.assets()), work, stays="nothing was asked.")


def _check_settings(desk: Session, request: ForecastJob | AskJob) -> VlmSettings:
    """Those of the project, which are tried out before anything long begins."""
    settings = desk.project.settings.vlm.model_copy(update={"mode": request.mode})
    check_vlm_settings(settings, desk.project.vocabulary)
    return settings


def _describe_forecast(found: VlmForecast) -> str:
    fresh = found.questions - found.known
    if not fresh:
        return "Every question has its answer already: asking again costs nothing."
    known = f", {found.known} more are answered already" if found.known else ""
    cost = "price not known" if found.cost is None else f"about ${found.cost:.4f}"
    sent = f"{pluralize(fresh, 'question')} with {pluralize(found.pictures, 'picture')} to {found.host}{known}"
    return f"{sent}; about {found.input:,} tokens: {cost}."


def _answers_line(report: LabelOutcome, found: VlmResult) -> JobLine:
    if report.problems:
        return JobLine(asset=report.asset, status="failed", text="; ".join(report.problems))
    bare = found.open.get(report.asset, {})
    said = [pluralize(report.taken, "label")] + ([f"none for {join_names(list(bare), most=3)}"] if bare else [])
    return JobLine(asset=report.asset, status="done" if report.taken else "unchanged", text=", ".join(said))


def _describe_answers(found: VlmResult) -> str:
    taken, bill = sum(report.taken for report in found.reports), found.usage
    bare = sum(map(len, found.open.values()))
    cost = f"{bill.usage.input + bill.usage.output:,} tokens" if bill.cost is None else f"${bill.cost:.4f}"
    parts = [f"{pluralize(taken, 'label')} taken"]
    parts += [f"{pluralize(bare, 'hull')} left without"] if bare else []
    parts += [f"{pluralize(len(found.unasked), 'asset')} not asked about"] if found.unasked else []
    return f"{', '.join(parts)}; {cost}."


def start_propagate(desk: Session) -> Job:
    """Begin to carry labels over. Raises ProjectError: no vocabulary, or no label that a person or a file gave."""
    project = desk.project
    _check_labels(project)
    began, used = _preparation_digests(project), desk.history.view.undoable

    @contextmanager
    def keeping(best: str | None) -> Iterator[None]:
        with desk.record_edit(Propagate(used=used, next=best), uuid4().hex):
            if _preparation_digests(desk.project) != began:
                raise ConflictError("assets or their hulls were changed meanwhile", remedy=_REMEDY)
            yield

    def work(running: JobProgress) -> str:
        spread = ExecutionOptions(stop=lambda: running.is_stopped)
        carried = project.propagate_labels(spread=spread, stage=running.stage, keeping=keeping)
        for report in carried.reports:
            running.add_line(_propagation_line(report))
        if not any(report.taken for report in carried.reports):
            desk.label_changes.note_no_change(used, carried.next)
            desk.refresh_queue.add()
        return _describe_propagation(carried)

    assets = project.assets()
    return desk.jobs.start("propagate", "Carrying labels over", len(assets), work, stays="no label was changed.")


def _check_labels(project: Project) -> None:
    """Raises ProjectError, before anything long is begun, where there is nothing to carry over."""
    if not project.vocabulary:
        raise ProjectError("the vocabulary is empty", remedy="Say first what hulls can be.")
    given = (label.source in GIVEN_SOURCES for a in project.assets() for label in project.labels(a).labels.values())
    if not any(given):
        raise ProjectError("there is no label to carry over", remedy="Label the hulls of one asset first.")


def _preparation_digests(project: Project) -> dict[str, str | None]:
    """What of each asset decides which hulls it has, besides its files."""
    return {asset: record_digest(project.layout.preparation(asset)) for asset in project.assets()}


def _propagation_line(report: LabelOutcome) -> JobLine:
    if report.problems:
        return JobLine(asset=report.asset, status="failed", text="; ".join(report.problems))
    said = [pluralize(report.taken, "label")] + ([f"{report.unsure} unsure"] if report.unsure else [])
    return JobLine(asset=report.asset, status="done" if report.taken else "unchanged", text=", ".join(said))


def _describe_propagation(carried: PropagationResult) -> str:
    taken = sum(report.taken for report in carried.reports)
    if not taken:
        return "Every label stays as it is."
    assets = pluralize(sum(report.taken > 0 for report in carried.reports), "asset")
    unsure = sum(report.unsure for report in carried.reports)
    doubt = f"{pluralize(unsure, 'label')} {'is' if unsure == 1 else 'are'} unsure" if unsure else "all are sure"
    return f"{pluralize(taken, 'label')} on {assets}; {doubt}."
