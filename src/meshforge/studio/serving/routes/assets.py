"""One asset: what it is, its shapes, and what edits and programs make of it."""

from __future__ import annotations

from typing import Literal

from fastapi import APIRouter, Response

from meshforge.errors import ProjectError
from meshforge.language import Program
from meshforge.studio.serving.routes.common import AtDesk, packet
from meshforge.studio.showing import shapes, staging
from meshforge.studio.state import Desk
from meshforge.studio.wire.asset import AssetView
from meshforge.studio.wire.lesson import Generalised, Guesses, Selected
from meshforge.studio.wire.requests import GeneraliseRequest, PreviewRequest, SelectRequest
from meshforge.studio.workers import arrived

router = APIRouter(prefix="/api")


@router.get("/asset")
def asset_view(desk: AtDesk, asset: str) -> AssetView:
    """An asset with its steps."""
    return shapes.asset_view(desk.project, asset, desk.mesh(asset))


@router.get("/shapes")
def shapes_of(desk: AtDesk, asset: str) -> Response:
    """Its hulls and opaque pieces."""
    return packet(shapes.asset_packet(desk.mesh(asset)))


@router.get("/visual")
def visual(desk: AtDesk, asset: str) -> Response:
    """What it shows."""
    return packet(shapes.visual_packet(desk.mesh(asset)))


@router.get("/stage")
def stage(desk: AtDesk, asset: str, steps: int) -> Response:
    """What it is after some of its steps."""
    return packet(staging.staged(desk.project, asset, desk.mesh(asset), steps))


@router.post("/preview")
def preview(desk: AtDesk, request: PreviewRequest) -> Response:
    """What one more action would do."""
    return packet(staging.preview(desk.project, request.asset, desk.mesh(request.asset), request))


@router.post("/select")
def select(desk: AtDesk, request: SelectRequest) -> Selected:
    """What an extractor selects there."""
    program = None if request.rule is None else present_program(desk)
    return staging.selected(desk.project, request.asset, desk.mesh(request.asset), request, program)


@router.post("/generalise")
def generalise(desk: AtDesk, request: GeneraliseRequest) -> Generalised:
    """What an extractor selects on all assets."""
    return arrived(desk.learning.generalise(request.extractor, request.rule))


@router.get("/result")
def result(desk: AtDesk, asset: str, of: Literal["program", "output"]) -> Response:
    """What the program makes of it, or what was written."""
    program = desk.project.program() if of == "program" else None
    return packet(staging.result(desk.project, asset, desk.mesh(asset), of, program))


@router.get("/guesses")
def guesses(desk: AtDesk, asset: str) -> Guesses:
    """What the program would select for each rule."""
    mesh, program = desk.mesh(asset), present_program(desk)
    if program is None:
        return Guesses(asset=asset, guesses=())
    return staging.guesses(desk.project, asset, mesh, program)


def present_program(desk: Desk) -> Program | None:
    """The program of the present lesson, or else the accepted one; a program by hand goes before lessons."""
    lesson, accepted = desk.pages.lesson, desk.pages.program
    if lesson and lesson.program and not accepted.by_hand:
        return Program.parse(lesson.program)
    if accepted.error:
        raise ProjectError(accepted.error, where="program.mf")
    return Program.parse(accepted.text) if accepted.text else None
