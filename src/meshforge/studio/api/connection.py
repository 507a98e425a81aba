"""How requests reach the session: from pages that it served itself, from this machine, with the token; and the
WebSocket on which a page gets all events.
"""

from asyncio import FIRST_COMPLETED, create_task, get_running_loop, wait
from secrets import compare_digest
from typing import Annotated, Any
from urllib.parse import urlsplit

from fastapi import APIRouter, Body, Depends, Header, WebSocket, WebSocketDisconnect
from fastapi.responses import Response
from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from meshforge.studio.host import Host
from meshforge.studio.pages import PageConnection
from meshforge.studio.session.session import Session
from meshforge.studio.wire.events import Problem

LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})
MOST_BYTES = 16 * 2**20
"""Bytes of the body of a request that is no upload."""

PROTOCOL = "meshforge"
"""The protocol that a WebSocket asks for; after it, it offers the token."""
CHANGED = 4000
"""The code of a closed WebSocket whose page is to connect again at once."""

_REOPEN = "Open the address that `meshforge studio` has printed."


class Guard:
    """Lets requests pass that come from a page of this studio, and gives every answer its safety headers."""

    def __init__(self, app: ASGIApp, token: str) -> None:
        self._app = app
        self._token = token.encode()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self._find_refusal(HTTPConnection(scope))
        if scope["type"] == "websocket":
            await (_refuse_socket(receive, send) if refusal else self._app(scope, receive, send))
            return

        host = Headers(scope=scope).get("host", "")

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(_safety_headers(host if not refusal else ""))
            await send(message)

        if refusal:
            await refusal(scope, receive, send_with_headers)
        else:
            await self._app(scope, receive, send_with_headers)

    def _find_refusal(self, request: HTTPConnection) -> Response | None:
        """Why a request is refused. A foreign name in `Host` means that a foreign page has rebound its name to us."""
        host = request.headers.get("host", "")
        if _host_name(f"//{host}") not in LOOPBACK:
            return _refuse(403, "the studio answers on this machine only", remedy=_REOPEN)
        origin = request.headers.get("origin")
        if origin is not None and origin != f"http://{host}":
            return _refuse(403, "another site asked for this", where=origin, remedy=_REOPEN)
        path = request.url.path
        if path != "/ws" and not path.startswith(("/api/", "/ws/")):
            return None
        if not self._has_token(request):
            return _refuse(401, "this page has no valid token for the studio", remedy=_REOPEN)
        return _check_length(request) if request.scope.get("method") == "POST" else None

    def _has_token(self, request: HTTPConnection) -> bool:
        """Never by the address, which ends up in logs and histories; a browser's socket has no headers of its own."""
        if request.scope["type"] == "websocket":
            offered = [word.strip() for word in request.headers.get("sec-websocket-protocol", "").split(",")]
            token = offered[1] if offered[0] == PROTOCOL and len(offered) == 2 else ""
        else:
            kind, _, given = request.headers.get("authorization", "").partition(" ")
            token = given if kind.lower() == "bearer" else ""
        return compare_digest(token.encode(), self._token)


def _refuse(status: int, message: str, where: str | None = None, remedy: str | None = None) -> Response:
    return JSONResponse(Problem(message=message, where=where, remedy=remedy).model_dump(mode="json"), status)


def _check_length(request: HTTPConnection) -> Response | None:
    length = request.headers.get("content-length", "")
    if not length.isdigit():
        return _refuse(411, "this request does not say how long it is")
    if int(length) > MOST_BYTES:
        return _refuse(413, f"this request is longer than {MOST_BYTES >> 20} MB")
    return None


def _host_name(address: str) -> str | None:
    try:
        return urlsplit(address).hostname
    except ValueError:
        return None


async def _refuse_socket(receive: Receive, send: Send) -> None:
    await receive()
    await send({"type": "websocket.close", "code": 1008})


def _safety_headers(host: str) -> dict[str, str]:
    socket = f" ws://{host}" if host else ""
    policy = (
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; font-src 'self' data:; "
        f"img-src 'self' blob: data:; connect-src 'self'{socket}; worker-src 'self' blob:; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
    return {
        "Content-Security-Policy": policy,
        "X-Content-Type-Options": "nosniff",
        "X-Frame-Options": "DENY",
        "Referrer-Policy": "no-referrer",
        "Cross-Origin-Resource-Policy": "same-origin",
        "Cross-Origin-Opener-Policy": "same-origin",
    }


BodyText = Annotated[str, Body(embed=True)]
"""A field of a request's JSON object."""
SenderId = Annotated[str | None, Header(alias="X-Page")]
"""The page that sends the request, by its own name."""

router = APIRouter()


def _get_host(connection: HTTPConnection) -> Host:
    host: Any = connection.app.state.host
    assert isinstance(host, Host)
    return host


CurrentHost = Annotated[Host, Depends(_get_host)]
"""The studio's open project, or its start page."""


def _get_session(host: CurrentHost) -> Session:
    return host.session


CurrentSession = Annotated[Session, Depends(_get_session)]
"""The project that is open. Raises ConflictError, which the page gets, where none is."""


def packet_response(data: bytes) -> Response:
    """Return a packet of shapes, which pages fetch anew each time."""
    return Response(data, media_type="application/octet-stream", headers={"Cache-Control": "no-store"})


@router.websocket("/ws")
async def serve_socket(connection: WebSocket, host: CurrentHost) -> None:
    """Send a page all events until it leaves, another project is opened, or the studio is closed."""
    await connection.accept(subprotocol=PROTOCOL)
    page = PageConnection(get_running_loop())
    hub = host.join(page)
    tasks = [create_task(_send_events(connection, page, host)), create_task(_listen(connection))]
    try:
        await wait(tasks, return_when=FIRST_COMPLETED)
    finally:
        hub.leave(page)
        for task in tasks:
            task.cancel()


async def _send_events(connection: WebSocket, page: PageConnection, host: Host) -> None:
    try:
        while (text := await page.events.get()) is not None:
            await connection.send_text(text)
        await connection.close(code=1012 if host.is_closing else CHANGED)
    except (WebSocketDisconnect, RuntimeError):  # it has left meanwhile
        return


async def _listen(connection: WebSocket) -> None:
    """Wait until the page leaves; what it sends has no meaning."""
    try:
        while True:
            await connection.receive_text()
    except (WebSocketDisconnect, RuntimeError, KeyError):
        return
