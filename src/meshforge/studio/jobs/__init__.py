"""Long work that a page asks for: applying, decomposing, labelling, checking, exporting."""

from __future__ import annotations

from typing import TYPE_CHECKING, assert_never

from meshforge.studio.jobs.assets import start_apply, start_decompose
from meshforge.studio.jobs.labels import start_ask, start_forecast, start_propagate
from meshforge.studio.jobs.outputs import start_check, start_export
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
    from meshforge.studio.session.session import Session


def start_job(desk: Session, request: JobRequest) -> Job:
    """Begin it. Raises MeshForgeError where it cannot be done."""
    match request:
        case ApplyJob():
            return start_apply(desk, request)
        case DecomposeJob():
            return start_decompose(desk, request)
        case ExportJob():
            return start_export(desk, request)
        case PropagateJob():
            return start_propagate(desk)
        case ForecastJob():
            return start_forecast(desk, request)
        case AskJob():
            return start_ask(desk, request)
        case CheckJob():
            return start_check(desk)
        case _:
            assert_never(request)
