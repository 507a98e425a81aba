"""Files that the page sends."""

from __future__ import annotations

from fastapi import APIRouter, Request
from starlette.concurrency import run_in_threadpool

from meshforge.studio.serving.routes.common import AtDesk, FromPage
from meshforge.studio.state.adding import take_assets, take_template
from meshforge.studio.wire.requests import Uploaded

router = APIRouter(prefix="/api")


@router.put("/templates")
async def template(desk: AtDesk, request: Request, name: str, page: FromPage = None) -> Uploaded:
    """Take a hull template."""
    file = await desk.uploads.put_template(request.stream())
    return await run_in_threadpool(take_template, desk, name, file, page)


@router.put("/assets")
async def asset_file(desk: AtDesk, request: Request, path: str) -> Uploaded:
    """Keep a file of an asset aside."""
    await desk.uploads.put(path, request.stream())
    return Uploaded(names=(path,))


@router.post("/assets")
def assets(desk: AtDesk, page: FromPage = None) -> Uploaded:
    """Take the files that were sent into the project."""
    return take_assets(desk, page)
