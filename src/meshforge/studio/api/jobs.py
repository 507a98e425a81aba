"""Routes of long work: jobs, and checks that end when the page that asked for them goes on."""

from __future__ import annotations

from asyncio import wait, wrap_future
from concurrent.futures import Future
from typing import Annotated, Literal, TypeVar

from fastapi import APIRouter, Body, Request, Response

from meshforge.common import StoppedError
from meshforge.studio.api.connection import CurrentSession
from meshforge.studio.errors import NotHereError
from meshforge.studio.jobs import start_job
from meshforge.studio.wire.asset import Checked, CheckPart, CheckPicture
from meshforge.studio.wire.jobs import Job, JobRequest
from meshforge.studio.wire.requests import JobCancel
from meshforge.studio.workers import wait_for

router = APIRouter(prefix="/api/jobs")

checks_router = APIRouter(prefix="/api/checked")
Result = TypeVar("Result")

POLL_SECONDS = 0.2
"""Seconds between two looks whether the page still waits."""
_CACHE_FOREVER = {"Cache-Control": "private, max-age=31536000, immutable"}


@router.post("")
def post_job(desk: CurrentSession, request: Annotated[JobRequest, Body(discriminator="kind")]) -> Job:
    """Begin a job."""
    return start_job(desk, request)


@router.post("/cancel")
def cancel_job(desk: CurrentSession, request: JobCancel) -> Job:
    """Have a job stop."""
    return desk.jobs.cancel(request.id)


@checks_router.get("")
async def get_checked(desk: CurrentSession, request: Request, asset: str, part: CheckPart) -> Checked:
    """What is measured of the output of an asset."""
    desk.check_assets(asset)
    known = desk.checks.check_part(desk.project, asset, part)
    fresh = not known.done()
    found = await _wait_while_connected(request, known)
    if fresh:  # its card may tell more now
        desk.refresh_queue.add([asset])
    return found


@checks_router.get("/pictures")
async def get_pictures(
    desk: CurrentSession, request: Request, asset: str, part: Literal["fit", "clearance"]
) -> tuple[CheckPicture, ...]:
    """The pictures of it, drawn."""
    desk.check_assets(asset)
    return await _wait_while_connected(request, desk.checks.draw_pictures(desk.project, asset, part))


@checks_router.get("/picture")
def get_picture(desk: CurrentSession, asset: str, name: str, v: str) -> Response:
    """One of them; v: the digest on the card."""
    desk.check_assets(asset)
    if not (v.isalnum() and v.isascii() and name.replace("-", "").isalpha() and name.isascii()):
        raise NotHereError("there is no such picture", where=asset)
    return Response(desk.checks.read_picture(asset, v, name), media_type="image/png", headers=_CACHE_FOREVER)


async def _wait_while_connected(request: Request, future: Future[Result]) -> Result:
    """The result of some work, which is stopped where nobody waits for it any more."""
    waiting = wrap_future(future)
    while not (await wait([waiting], timeout=POLL_SECONDS))[0]:
        if await request.is_disconnected():
            waiting.cancel()
            raise StoppedError("the page went on")
    if waiting.cancelled():
        raise StoppedError("the studio is being closed")
    waiting.exception()  # told by `wait_for`
    return wait_for(future)
