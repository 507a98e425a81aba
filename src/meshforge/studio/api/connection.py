"""How requests reach the session, and the WebSocket on which a page gets all events."""

from __future__ import annotations

from asyncio import FIRST_COMPLETED, create_task, get_running_loop, wait
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Header, WebSocket, WebSocketDisconnect
from fastapi.requests import HTTPConnection
from fastapi.responses import Response

from meshforge.studio.pages import PageConnection
from meshforge.studio.session.session import Session

SenderId = Annotated[str | None, Header(alias="X-Page")]
"""The page that sends the request, by its own name."""

router = APIRouter()


def _get_session(connection: HTTPConnection) -> Session:
    session: Any = connection.app.state.session
    assert isinstance(session, Session)
    return session


CurrentSession = Annotated[Session, Depends(_get_session)]
"""The session that the studio serves."""


def packet_response(data: bytes) -> Response:
    """A packet of shapes, which pages fetch anew each time."""
    return Response(data, media_type="application/octet-stream", headers={"Cache-Control": "no-store"})


@router.websocket("/ws")
async def serve_socket(connection: WebSocket, session: CurrentSession) -> None:
    """Send a page all events until it leaves, or the studio is closed."""
    await connection.accept()
    page = PageConnection(get_running_loop())
    session.pages.join(page)
    tasks = [create_task(_send_events(connection, page)), create_task(_listen(connection))]
    try:
        await wait(tasks, return_when=FIRST_COMPLETED)
    finally:
        session.hub.leave(page)
        for task in tasks:
            task.cancel()


async def _send_events(connection: WebSocket, page: PageConnection) -> None:
    try:
        while (text := await page.events.get()) is not None:
            await connection.send_text(text)
        await connection.close(code=1012)
    except (WebSocketDisconnect, RuntimeError):  # it has left meanwhile
        return


async def _listen(connection: WebSocket) -> None:
    """Wait until the page leaves; what it sends has no meaning."""
    try:
        while True:
            await connection.receive_text()
    except (WebSocketDisconnect, RuntimeError, KeyError):
        return
