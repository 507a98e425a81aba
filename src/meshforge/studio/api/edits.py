"""Routes that change the project: edits, undo and redo, learning, and uploaded templates and assets."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from fastapi import APIRouter, Body, Request
from starlette.concurrency import run_in_threadpool

from meshforge.common import ProjectError, join_names
from meshforge.studio.api.connection import CurrentSession, SenderId
from meshforge.studio.edits import AnyEdit
from meshforge.studio.edits.assets import AddAssets, AddTemplate
from meshforge.studio.queries.project import model_of
from meshforge.studio.uploads import find_assets
from meshforge.studio.wire.requests import Done, LabelSources, Uploaded

if TYPE_CHECKING:
    from meshforge.studio.session.session import Session


router = APIRouter(prefix="/api")

ADDED_FOLDER = "added"
"""The folder, below that of the project's assets, that new ones come to."""


@router.post("/edit")
def make_edit(desk: CurrentSession, change: Annotated[AnyEdit, Body()], page: SenderId = None) -> Done:
    """Make an edit."""
    return desk.edit(change, page)


@router.post("/undo")
def undo(desk: CurrentSession, page: SenderId = None) -> Done:
    """Take back what was done last."""
    return desk.undo(page)


@router.post("/redo")
def redo(desk: CurrentSession, page: SenderId = None) -> Done:
    """Do again what was taken back last."""
    return desk.redo(page)


@router.post("/learn")
def learn(desk: CurrentSession) -> Done:
    """Learn now, and take what is learned."""
    return desk.learn()


@router.post("/learn/stop")
def stop_learning(desk: CurrentSession) -> Done:
    """Stop the lesson that is under way."""
    desk.learning.stop()
    return Done(said="stopped")


@router.get("/labels/sources")
def get_label_sources(desk: CurrentSession) -> LabelSources:
    """Where labels could come from, as far as assets are read by now."""
    offered = desk.offers.of(desk.project, {card.asset for card in desk.pages.cards if card.hulls is not None})
    names = sum(map(len, offered.names.values()))
    return LabelSources(files=len(offered.files), names=names, model=model_of(desk.project))


@router.put("/templates")
async def put_template(desk: CurrentSession, request: Request, name: str, page: SenderId = None) -> Uploaded:
    """Take a hull template."""
    file = await desk.uploads.put_template(request.stream())
    return await run_in_threadpool(add_template, desk, name, file, page)


@router.put("/assets")
async def put_asset_file(desk: CurrentSession, request: Request, path: str) -> Uploaded:
    """Keep a file of an asset aside."""
    await desk.uploads.put(path, request.stream())
    return Uploaded(names=(path,))


@router.post("/assets")
def add_sent_assets(desk: CurrentSession, page: SenderId = None) -> Uploaded:
    """Take the files that were sent into the project."""
    return add_assets(desk, page)


def add_template(desk: Session, name: str, file: Path, page: str | None) -> Uploaded:
    """Keep an uploaded file as a template. Raises ProjectError: no name for one, or no convex hulls in it."""
    try:
        desk.edit(AddTemplate(name=name, file=str(file)), page)
    finally:
        file.unlink(missing_ok=True)
    return Uploaded(names=(name,))


def add_assets(desk: Session, page: str | None) -> Uploaded:
    """Put the files that were sent in place, as assets of the project. Raises ProjectError, and throws them away,
    where one cannot be read, or would take the place of another file."""
    try:
        staged, files = desk.uploads.list_files()
        added = find_assets(desk.readers, staged)
        home = desk.project.found.base / ADDED_FOLDER
        _check_free(home, files)
        desk.edit(AddAssets(staged=str(staged), files=files, added=added, home=str(home)), page)
    finally:
        desk.uploads.clear()
    return Uploaded(names=tuple(f"{ADDED_FOLDER}/{name}" for name in added))


def _check_free(home: Path, files: tuple[str, ...]) -> None:
    if not home.resolve().is_relative_to(home.parent.resolve()):
        raise ProjectError("this folder is a link to somewhere else", where=str(home), remedy="Remove the link.")
    taken = [name for name in files if (home / name).exists()]
    if taken:
        raise ProjectError(f"there is a file of that name already: {join_names(taken)}", remedy="Give it another name.")
