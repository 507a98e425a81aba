"""Pictures of assets."""

from __future__ import annotations

from asyncio import wrap_future

from fastapi import APIRouter, Response

from meshforge.studio.assets import Of
from meshforge.studio.errors import NotHereError
from meshforge.studio.serving.routes.assets import present_program
from meshforge.studio.serving.routes.common import AtDesk, packet
from meshforge.studio.showing import pictures

router = APIRouter(prefix="/api")
_FOR_EVER = {"Cache-Control": "private, max-age=31536000, immutable"}


@router.get("/thumbnail")
async def thumbnail(desk: AtDesk, asset: str, of: Of, v: str) -> Response:
    """The thumbnail of an asset or of its output; v: the digest on its card."""
    desk.check_assets(asset)
    if not (v.isalnum() and v.isascii() and len(v) == 32):
        raise NotHereError("there is no such picture", where=asset)
    data = await wrap_future(desk.thumbnails.get(desk.project, asset, of, v))
    return Response(data, media_type="image/png", headers=_FOR_EVER)


@router.get("/picture")
def picture(desk: AtDesk, asset: str, rule: int) -> Response:
    """An asset as a rule of the present program meets it."""
    return packet(pictures.met(desk.project, asset, desk.mesh(asset), rule, present_program(desk)))
