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
"""The page that asks, as it calls itself."""

router = APIRouter()


def _get_session(connection: HTTPConnection) -> Session:
    desk: Any = connection.app.state.desk
    assert isinstance(desk, Session)
    return desk


CurrentSession = Annotated[Session, Depends(_get_session)]
"""The desk of the studio."""


def packet_response(data: bytes) -> Response:
    """A packet of shapes, which pages ask for anew each time."""
    return Response(data, media_type="application/octet-stream", headers={"Cache-Control": "no-store"})


@router.websocket("/ws")
async def serve_socket(connection: WebSocket, desk: CurrentSession) -> None:
    """Tell a page all events until it leaves, or the studio is closed."""
    await connection.accept()
    page = PageConnection(get_running_loop())
    desk.pages.join(page)
    tasks = [create_task(_send_events(connection, page)), create_task(_listen(connection))]
    try:
        await wait(tasks, return_when=FIRST_COMPLETED)
    finally:
        desk.hub.leave(page)
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
    """Pages have nothing to say but that they are still there."""
    try:
        while True:
            await connection.receive_text()
    except (WebSocketDisconnect, RuntimeError, KeyError):
        return
