"""Routes of files that the browser takes away."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import FileResponse

from meshforge.studio.api.connection import BodyText, CurrentSession

router = APIRouter()


@router.post("/api/download")
def get_ticket(session: CurrentSession, job: BodyText) -> str:
    """An address, below the studio's own, that is good for a minute and one download of what a job has made."""
    return f"download/{session.downloads.give_ticket(job)}"


@router.get("/download/{ticket}")
def download(session: CurrentSession, ticket: str) -> FileResponse:
    """The file itself, never shown as a page. The ticket takes the place of the token."""
    path = session.downloads.redeem(ticket)
    return FileResponse(path, filename=path.name, headers={"Cache-Control": "no-store"})
