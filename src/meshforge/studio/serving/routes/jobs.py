"""Long work."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body

from meshforge.studio.jobs import begin
from meshforge.studio.serving.routes.common import AtDesk
from meshforge.studio.wire.jobs import Job, JobRequest
from meshforge.studio.wire.requests import JobCancel

router = APIRouter(prefix="/api/jobs")


@router.post("")
def start(desk: AtDesk, request: Annotated[JobRequest, Body(discriminator="kind")]) -> Job:
    """Begin a job."""
    return begin(desk, request)


@router.post("/cancel")
def cancel(desk: AtDesk, request: JobCancel) -> Job:
    """Have a job stop."""
    return desk.jobs.cancel(request.id)
