"""Beginning the job that a page asks for."""

from __future__ import annotations

from typing import TYPE_CHECKING, assert_never

from meshforge.studio.jobs.apply import apply_job
from meshforge.studio.jobs.ask import ask_job, forecast_job
from meshforge.studio.jobs.check import check_job
from meshforge.studio.jobs.decompose import decompose_job
from meshforge.studio.jobs.export import export_job
from meshforge.studio.jobs.propagate import propagate_job
from meshforge.studio.wire.jobs import (
    ApplyJob,
    AskJob,
    CheckJob,
    DecomposeJob,
    ExportJob,
    ForecastJob,
    Job,
    JobRequest,
    PropagateJob,
)

if TYPE_CHECKING:
    from meshforge.studio.state import Desk


def begin(desk: Desk, request: JobRequest) -> Job:
    """Begin it. Raises MeshForgeError where it cannot be done."""
    match request:
        case ApplyJob():
            return apply_job(desk, request)
        case DecomposeJob():
            return decompose_job(desk, request)
        case ExportJob():
            return export_job(desk, request)
        case PropagateJob():
            return propagate_job(desk)
        case ForecastJob():
            return forecast_job(desk, request)
        case AskJob():
            return ask_job(desk, request)
        case CheckJob():
            return check_job(desk)
        case _:
            assert_never(request)
