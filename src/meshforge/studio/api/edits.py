"""Routes that change the project: edits, undo and redo, learning, jobs, and uploaded templates and assets."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Body, Request
from starlette.concurrency import run_in_threadpool

from meshforge.common import ProjectError, join_names
from meshforge.studio.api.connection import CurrentSession, SenderId
from meshforge.studio.edits import AnyEdit
from meshforge.studio.edits.assets import AddAssets, AddTemplate
from meshforge.studio.jobs import start_job
from meshforge.studio.queries.project import model_of
from meshforge.studio.session.session import Session
from meshforge.studio.uploads import find_assets
from meshforge.studio.wire.jobs import Job, JobRequest
from meshforge.studio.wire.requests import Done, JobCancel, LabelSources, Uploaded

router = APIRouter(prefix="/api")

ADDED_FOLDER = "added"
"""The folder for new assets, below that of the project's assets."""


@router.post("/edit")
def make_edit(session: CurrentSession, change: Annotated[AnyEdit, Body()], page: SenderId = None) -> Done:
    """Make an edit."""
    return session.edit(change, page)


@router.post("/undo")
def undo(session: CurrentSession, page: SenderId = None) -> Done:
    """Undo what was done last."""
    return session.move("undo", page)


@router.post("/redo")
def redo(session: CurrentSession, page: SenderId = None) -> Done:
    """Redo what was undone last."""
    return session.move("redo", page)


@router.post("/learn")
def learn(session: CurrentSession) -> Done:
    """Learn now, and take what is learned."""
    return session.learn()


@router.post("/learn/stop")
def stop_learning(session: CurrentSession) -> Done:
    """Stop the learning run that is under way."""
    session.learning.stop()
    return Done(said="stopped")


@router.post("/jobs")
def post_job(session: CurrentSession, request: Annotated[JobRequest, Body(discriminator="kind")]) -> Job:
    """Start a job."""
    return start_job(session, request)


@router.post("/jobs/cancel")
def cancel_job(session: CurrentSession, request: JobCancel) -> Job:
    """Have a job stop."""
    return session.jobs.cancel(request.id)


@router.get("/labels/sources")
def get_label_sources(session: CurrentSession) -> LabelSources:
    """Where labels could come from, as far as assets are read by now."""
    offered = session.offers.of(session.project, {card.asset for card in session.pages.cards if card.hulls is not None})
    names = sum(map(len, offered.names.values()))
    return LabelSources(files=len(offered.files), names=names, model=model_of(session.project))


@router.put("/templates")
async def put_template(session: CurrentSession, request: Request, name: str, page: SenderId = None) -> Uploaded:
    """Take a hull template."""
    file = await session.uploads.put_template(request.stream())
    return await run_in_threadpool(_add_template, session, name, file, page)


def _add_template(session: Session, name: str, file: Path, page: str | None) -> Uploaded:
    """Keep an uploaded file as a template. Raises ProjectError: no name for one, or no convex hulls in it."""
    try:
        session.edit(AddTemplate(name=name, file=str(file)), page)
    finally:
        file.unlink(missing_ok=True)
    return Uploaded(names=(name,))


@router.put("/assets")
async def put_asset_file(session: CurrentSession, request: Request, path: str) -> Uploaded:
    """Keep a file of an asset aside."""
    await session.uploads.put(path, request.stream())
    return Uploaded(names=(path,))


@router.post("/assets")
def add_assets(session: CurrentSession, page: SenderId = None) -> Uploaded:
    """Take the files that were sent into the project, as assets. Raises ProjectError, and throws them away, where one
    cannot be read, or would take the place of another file."""
    try:
        staged, files = session.uploads.list_files()
        added = find_assets(session.readers, staged)
        home = session.project.found.base / ADDED_FOLDER
        _check_free(home, files)
        session.edit(AddAssets(staged=str(staged), files=files, added=added, home=str(home)), page)
    finally:
        session.uploads.clear()
    return Uploaded(names=tuple(f"{ADDED_FOLDER}/{name}" for name in added))


def _check_free(home: Path, files: tuple[str, ...]) -> None:
    if not home.resolve().is_relative_to(home.parent.resolve()):
        raise ProjectError("this folder is a link to somewhere else", where=str(home), remedy="Remove the link.")
    taken = [name for name in files if (home / name).exists()]
    if taken:
        raise ProjectError(f"there is a file of that name already: {join_names(taken)}", remedy="Give it another name.")
