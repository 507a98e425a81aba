"""The connection on which a page is told everything."""

from __future__ import annotations

from asyncio import FIRST_COMPLETED, create_task, get_running_loop, wait

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from meshforge.studio.serving.routes.common import AtDesk
from meshforge.studio.state.hub import Page

router = APIRouter()


@router.websocket("/ws")
async def socket(connection: WebSocket, desk: AtDesk) -> None:
    """Tell a page all events until it leaves, or the studio is closed."""
    await connection.accept()
    page = Page(get_running_loop())
    desk.pages.join(page)
    tasks = [create_task(_tell(connection, page)), create_task(_listen(connection))]
    try:
        await wait(tasks, return_when=FIRST_COMPLETED)
    finally:
        desk.hub.leave(page)
        for task in tasks:
            task.cancel()


async def _tell(connection: WebSocket, page: Page) -> None:
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
