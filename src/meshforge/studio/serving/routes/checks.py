"""What is measured of outputs; the work ends when the page that asked for it goes on."""

from __future__ import annotations

from asyncio import wait, wrap_future
from concurrent.futures import Future
from typing import Literal, TypeVar

from fastapi import APIRouter, Request, Response

from meshforge.errors import StoppedError
from meshforge.studio.errors import NotHereError
from meshforge.studio.serving.routes.common import AtDesk
from meshforge.studio.wire.checks import Checked, CheckPicture, Part
from meshforge.studio.workers import arrived

router = APIRouter(prefix="/api/checked")
Result = TypeVar("Result")

OFTEN = 0.2
"""Seconds between two looks whether the page still waits."""
_FOR_EVER = {"Cache-Control": "private, max-age=31536000, immutable"}


@router.get("")
async def checked(desk: AtDesk, request: Request, asset: str, part: Part) -> Checked:
    """What is measured of the output of an asset."""
    desk.check_assets(asset)
    known = desk.checks.check_part(desk.project, asset, part)
    fresh = not known.done()
    found = await _awaited(request, known)
    if fresh:  # its card may tell more now
        desk.refresh_queue.add([asset])
    return found


@router.get("/pictures")
async def pictures(
    desk: AtDesk, request: Request, asset: str, part: Literal["fit", "clearance"]
) -> tuple[CheckPicture, ...]:
    """The pictures of it, drawn."""
    desk.check_assets(asset)
    return await _awaited(request, desk.checks.draw_pictures(desk.project, asset, part))


@router.get("/picture")
def picture(desk: AtDesk, asset: str, name: str, v: str) -> Response:
    """One of them; v: the digest on the card."""
    desk.check_assets(asset)
    if not (v.isalnum() and v.isascii() and name.replace("-", "").isalpha() and name.isascii()):
        raise NotHereError("there is no such picture", where=asset)
    return Response(desk.checks.read_picture(asset, v, name), media_type="image/png", headers=_FOR_EVER)


async def _awaited(request: Request, future: Future[Result]) -> Result:
    """The result of some work, which is stopped where nobody waits for it any more."""
    waiting = wrap_future(future)
    while not (await wait([waiting], timeout=OFTEN))[0]:
        if await request.is_disconnected():
            waiting.cancel()
            raise StoppedError("the page went on")
    if waiting.cancelled():
        raise StoppedError("the studio is being closed")
    waiting.exception()  # told by `arrived`
    return arrived(future)
