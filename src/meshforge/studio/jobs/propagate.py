"""Carrying labels over to the whole family, as a job; all that it changes is undone with one step."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING
from uuid import uuid4

from meshforge.batch import Spread
from meshforge.errors import ProjectError
from meshforge.preparation import record_digest
from meshforge.project import Carried, Labelled, Project
from meshforge.studio.edits.own import Propagate
from meshforge.studio.errors import ConflictError
from meshforge.studio.state.running import Running
from meshforge.studio.wire.jobs import Job, JobLine
from meshforge.symbolic import GIVEN_SOURCES
from meshforge.words import counted

if TYPE_CHECKING:
    from meshforge.studio.state import Desk

_AGAIN = "Carry labels over again."


def propagate_job(desk: Desk) -> Job:
    """Begin to carry labels over. Raises ProjectError: no vocabulary, or no label that a person or a file gave."""
    project = desk.project
    _check(project)
    began, used = _hulls(project), desk.history.view.undoable

    @contextmanager
    def keeping(best: str | None) -> Iterator[None]:
        with desk.record_edit(Propagate(used=used, next=best), uuid4().hex):
            if _hulls(desk.project) != began:
                raise ConflictError("assets or their hulls were changed meanwhile", remedy=_AGAIN)
            yield

    def work(running: Running) -> str:
        spread = Spread(stop=lambda: running.is_stopped)
        carried = project.propagate_labels(spread=spread, stage=running.stage, keeping=keeping)
        for report in carried.reports:
            running.add_line(_line(report))
        if not any(report.taken for report in carried.reports):
            desk.label_changes.note_no_change(used, carried.next)
            desk.refresh_queue.add()
        return _said(carried)

    assets = project.assets()
    return desk.jobs.start("propagate", "Carrying labels over", len(assets), work, stays="no label was changed.")


def _check(project: Project) -> None:
    """Raises ProjectError, before anything long is begun, where there is nothing to carry over."""
    if not project.vocabulary:
        raise ProjectError("the vocabulary is empty", remedy="Say first what hulls can be.")
    given = (label.source in GIVEN_SOURCES for a in project.assets() for label in project.labels(a).labels.values())
    if not any(given):
        raise ProjectError("there is no label to carry over", remedy="Label the hulls of one asset first.")


def _hulls(project: Project) -> dict[str, str | None]:
    """What of each asset decides which hulls it has, besides its files."""
    return {asset: record_digest(project.layout.preparation(asset)) for asset in project.assets()}


def _line(report: Labelled) -> JobLine:
    if report.problems:
        return JobLine(asset=report.asset, status="failed", text="; ".join(report.problems))
    said = [counted(report.taken, "label")] + ([f"{report.unsure} unsure"] if report.unsure else [])
    return JobLine(asset=report.asset, status="done" if report.taken else "unchanged", text=", ".join(said))


def _said(carried: Carried) -> str:
    taken = sum(report.taken for report in carried.reports)
    if not taken:
        return "Every label stays as it is."
    assets = counted(sum(report.taken > 0 for report in carried.reports), "asset")
    unsure = sum(report.unsure for report in carried.reports)
    doubt = f"{counted(unsure, 'label')} {'is' if unsure == 1 else 'are'} unsure" if unsure else "all are sure"
    return f"{counted(taken, 'label')} on {assets}; {doubt}."
