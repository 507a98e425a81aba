"""Routes of the start page: recent projects, folders of this machine, files that are sent, and opening a project."""

from typing import Annotated

from fastapi import APIRouter, Body, Depends, Request
from fastapi.responses import FileResponse

from meshforge.store import NotHereError
from meshforge.studio.api.connection import BodyText, CurrentHost
from meshforge.studio.jobs import start_job
from meshforge.studio.start import folders
from meshforge.studio.start.page import StartPage
from meshforge.studio.wire.jobs import DecomposeJob
from meshforge.studio.wire.requests import EditReceipt, UploadReceipt
from meshforge.studio.wire.start import (
    AssetsFound,
    FolderView,
    NewProject,
    ProjectOfFolder,
    ProjectOfTour,
    ProjectOfUpload,
    StartView,
)

router = APIRouter(prefix="/api/start")


def _get_start(host: CurrentHost) -> StartPage:
    return host.start


CurrentStart = Annotated[StartPage, Depends(_get_start)]
"""The start page. Raises ConflictError, which the page gets, where it is not open."""


@router.get("/folder")
def get_folder(start: CurrentStart, folder: str) -> FolderView:
    """Return the folders in a folder."""
    return folders.list_folder(folders.parse_path(folder))


@router.get("/look")
def look_at_folder(start: CurrentStart, folder: str) -> AssetsFound:
    """Return the assets in a folder."""
    return start.look_at_folder(folder)


@router.put("/files")
async def put_file(start: CurrentStart, request: Request, path: str) -> UploadReceipt:
    """Keep a file for a new project."""
    await start.uploads.put(path, request.stream())
    return UploadReceipt(names=(path,))


@router.post("/files")
def look_at_files(start: CurrentStart) -> AssetsFound:
    """Return the assets among the files that were sent; where one cannot be taken, all go, with an error."""
    return start.look_at_upload()


@router.post("/files/clear")
def clear_files(start: CurrentStart) -> UploadReceipt:
    """Throw away the files that were sent."""
    start.uploads.clear()
    return UploadReceipt(names=())


@router.post("/forget")
def forget(start: CurrentStart, folder: BodyText) -> StartView:
    """Take a project off the list of recent ones."""
    start.recent.forget(folder)
    return start.view


@router.get("/picture")
def get_picture(start: CurrentStart, folder: str) -> FileResponse:
    """Return the thumbnail of a recent project."""
    if (picture := start.recent.find_picture(folder)) is None:
        raise NotHereError("there is no such picture", where=folder)
    return FileResponse(picture, media_type="image/png")


@router.post("/open")
def open_project(host: CurrentHost, start: CurrentStart, folder: BodyText) -> EditReceipt:
    """Open a project."""
    path = folders.parse_path(folder, "the folder of the project")
    folders.check_folder(path)
    host.open(path)
    return EditReceipt(message=f"{path} opened")


@router.post("/new")
def make_project(host: CurrentHost, request: Annotated[NewProject, Body(discriminator="kind")]) -> EditReceipt:
    """Make a project and open it; hulls are made in a job, as far as that is asked for."""
    session = host.create(lambda start: start.create(request), tour=isinstance(request, ProjectOfTour))
    if isinstance(request, ProjectOfFolder | ProjectOfUpload) and request.decompose:
        start_job(session, DecomposeJob(assets=session.project.assets(), **request.decompose.model_dump()))
    return EditReceipt(message=f"{session.project.folder} made")


@router.post("/leave")
def leave_project(host: CurrentHost) -> EditReceipt:
    """Close the project, and show the start page."""
    host.leave()
    return EditReceipt(message="left")
