"""Changes of the project, and taking them back."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body

from meshforge.studio.edits import AnyEdit
from meshforge.studio.serving.routes.common import AtDesk, FromPage
from meshforge.studio.showing.model import model_of
from meshforge.studio.wire.requests import Done, LabelSources

router = APIRouter(prefix="/api")


@router.post("/edit")
def edit(desk: AtDesk, change: Annotated[AnyEdit, Body()], page: FromPage = None) -> Done:
    """Make an edit."""
    return desk.edit(change, page)


@router.post("/undo")
def undo(desk: AtDesk, page: FromPage = None) -> Done:
    """Take back what was done last."""
    return desk.undo(page)


@router.post("/redo")
def redo(desk: AtDesk, page: FromPage = None) -> Done:
    """Do again what was taken back last."""
    return desk.redo(page)


@router.post("/learn")
def learn(desk: AtDesk) -> Done:
    """Learn now, and take what is learned."""
    return desk.learn()


@router.post("/learn/stop")
def stop_learning(desk: AtDesk) -> Done:
    """Stop the lesson that is under way."""
    desk.learning.stop()
    return Done(describe="stopped")


@router.get("/labels/sources")
def label_sources(desk: AtDesk) -> LabelSources:
    """Where labels could come from, as far as assets are read by now."""
    offered = desk.offers.of(desk.project, {card.asset for card in desk.pages.cards if card.hulls is not None})
    names = sum(map(len, offered.names.values()))
    return LabelSources(files=len(offered.files), names=names, model=model_of(desk.project))
