"""Routes that answer what is asked about assets, pictures, programs and the language."""

from __future__ import annotations

from asyncio import wrap_future
from typing import Literal

from fastapi import APIRouter, Response

from meshforge.common import ProjectError
from meshforge.language import Program
from meshforge.studio.api.connection import CurrentSession, packet_response
from meshforge.studio.errors import NotHereError
from meshforge.studio.queries import assets, packets, previews, programs
from meshforge.studio.queries.programs import build_language_view
from meshforge.studio.session.session import Session
from meshforge.studio.thumbnails import ThumbnailOf
from meshforge.studio.wire.asset import AssetView
from meshforge.studio.wire.program import Generalised, Guesses, LanguageView, ProgramCheck, Selected
from meshforge.studio.wire.requests import CheckRequest, GeneraliseRequest, PreviewRequest, SelectRequest
from meshforge.studio.workers import wait_for

router = APIRouter(prefix="/api")

_CACHE_FOREVER = {"Cache-Control": "private, max-age=31536000, immutable"}


@router.get("/asset")
def get_asset(desk: CurrentSession, asset: str) -> AssetView:
    """An asset with its steps."""
    return assets.build_asset_view(desk.project, asset, desk.mesh(asset))


@router.get("/shapes")
def get_shapes(desk: CurrentSession, asset: str) -> Response:
    """Its hulls and opaque pieces."""
    return packet_response(packets.pack_asset(desk.mesh(asset)))


@router.get("/visual")
def get_visual(desk: CurrentSession, asset: str) -> Response:
    """What it shows."""
    return packet_response(packets.pack_visual(desk.mesh(asset)))


@router.get("/stage")
def get_stage(desk: CurrentSession, asset: str, steps: int) -> Response:
    """What it is after some of its steps."""
    return packet_response(previews.preview_steps(desk.project, asset, desk.mesh(asset), steps))


@router.post("/preview")
def preview(desk: CurrentSession, request: PreviewRequest) -> Response:
    """What one more action would do."""
    return packet_response(previews.preview_action(desk.project, request.asset, desk.mesh(request.asset), request))


@router.post("/select")
def select(desk: CurrentSession, request: SelectRequest) -> Selected:
    """What an extractor selects there."""
    program = None if request.rule is None else present_program(desk)
    return programs.select_hulls(desk.project, request.asset, desk.mesh(request.asset), request, program)


@router.post("/generalise")
def generalise(desk: CurrentSession, request: GeneraliseRequest) -> Generalised:
    """What an extractor selects on all assets."""
    return wait_for(desk.learning.generalise(request.extractor, request.rule))


@router.get("/result")
def get_result(desk: CurrentSession, asset: str, of: Literal["program", "output"]) -> Response:
    """What the program makes of it, or what was written."""
    program = desk.project.program() if of == "program" else None
    return packet_response(previews.preview_result(desk.project, asset, desk.mesh(asset), of, program))


@router.get("/guesses")
def get_guesses(desk: CurrentSession, asset: str) -> Guesses:
    """What the program would select for each rule."""
    mesh, program = desk.mesh(asset), present_program(desk)
    if program is None:
        return Guesses(asset=asset, guesses=())
    return programs.guess_selections(desk.project, asset, mesh, program)


def present_program(desk: Session) -> Program | None:
    """The program of the present lesson, or else the accepted one; a program by hand goes before lessons."""
    lesson, accepted = desk.pages.lesson, desk.pages.program
    if lesson and lesson.program and not accepted.by_hand:
        return Program.parse(lesson.program)
    if accepted.error:
        raise ProjectError(accepted.error, where="program.mf")
    return Program.parse(accepted.text) if accepted.text else None


@router.get("/thumbnail")
async def get_thumbnail(desk: CurrentSession, asset: str, of: ThumbnailOf, v: str) -> Response:
    """The thumbnail of an asset or of its output; v: the digest on its card."""
    desk.check_assets(asset)
    if not (v.isalnum() and v.isascii() and len(v) == 32):
        raise NotHereError("there is no such picture", where=asset)
    data = await wrap_future(desk.thumbnails.get(desk.project, asset, of, v))
    return Response(data, media_type="image/png", headers=_CACHE_FOREVER)


@router.get("/picture")
def get_picture(desk: CurrentSession, asset: str, rule: int) -> Response:
    """An asset as a rule of the present program meets it."""
    return packet_response(assets.draw_rule_picture(desk.project, asset, desk.mesh(asset), rule, present_program(desk)))


@router.get("/language")
def get_language() -> LanguageView:
    """Actions, operators and directions."""
    return build_language_view()


@router.post("/program/check")
def check_program(request: CheckRequest) -> ProgramCheck:
    """Whether a text is a program."""
    return programs.check_text(request.text)
