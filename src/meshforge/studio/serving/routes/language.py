"""The language, and texts in it."""

from __future__ import annotations

from fastapi import APIRouter

from meshforge.studio.showing import programs
from meshforge.studio.showing.language import language_view
from meshforge.studio.wire.language import LanguageView
from meshforge.studio.wire.lesson import ProgramCheck
from meshforge.studio.wire.requests import CheckRequest

router = APIRouter(prefix="/api")


@router.get("/language")
def language() -> LanguageView:
    """Actions, operators and directions."""
    return language_view()


@router.post("/program/check")
def check(request: CheckRequest) -> ProgramCheck:
    """Whether a text is a program."""
    return programs.check(request.text)
