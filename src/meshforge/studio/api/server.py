"""Serving the studio on this machine until it is stopped: the web application, its errors, and the built page."""

import logging
import signal
import socket
import webbrowser
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from pathlib import Path
from secrets import token_urlsafe
from threading import Thread
from types import FrameType
from typing import Any

import uvicorn
from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import ValidationError
from starlette.exceptions import HTTPException
from starlette.responses import Response
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Scope

from meshforge.batch import text_digest
from meshforge.common import (
    MeshForgeError,
    UsageError,
    describe_error,
    describe_invalid_field,
    explain_refusal,
    write_atomically,
)
from meshforge.store import ConflictError, JsonFile, NotHereError
from meshforge.studio.api import connection, routes, start
from meshforge.studio.api.connection import Guard
from meshforge.studio.host import Host
from meshforge.studio.session.session import StudioOptions
from meshforge.studio.start.page import state_folder
from meshforge.studio.transfers import TooLargeError
from meshforge.studio.wire.events import Problem

ADDRESS = "127.0.0.1"
_PRIVATE = 0o600
_LOG = logging.getLogger(__name__)

_STATUSES = {ConflictError: 409, NotHereError: 404, TooLargeError: 413, MeshForgeError: 400}
PAGE_FOLDER = Path(__file__).parent.parent / "static"


def serve(
    options: StudioOptions,
    announce: Callable[[str], None],
    *,
    port: int | None = None,
    browser: bool = True,
    page: Path = PAGE_FOLDER,
) -> None:
    """Serve a project, or the start page, until Ctrl-C or SIGTERM. announce: called with the address; port: 0 takes a
    free one, None the last one if it is free; page: the built page.

    Raises MeshForgeError: no project, no page, the port is taken, or the studio is open on the project already.
    """
    open_page(page)
    host = Host(options)
    with _stop_on_signal(), ExitStack() as stack:
        stack.callback(host.close)
        if options.folder is not None:
            host.open(options.folder)
        listening, token = LastAddress(state_folder(), options.folder).listen(port)
        stack.enter_context(closing(listening))
        address = f"http://{ADDRESS}:{listening.getsockname()[1]}/?token={token}"

        def ready() -> None:
            announce(address)
            if browser:
                Thread(target=webbrowser.open, args=(address,), daemon=True).start()

        _Server(_make_config(host, token, page), ready).run(sockets=[listening])


class _Server(uvicorn.Server):
    """A server that calls `ready` once it listens."""

    def __init__(self, config: uvicorn.Config, ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._ready = ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            self._ready()


def _make_config(host: Host, token: str, page: Path) -> uvicorn.Config:
    return uvicorn.Config(
        build_app(host, token, page),
        log_level="info" if _LOG.isEnabledFor(logging.DEBUG) else "critical",
        access_log=False,
        lifespan="off",
        ws="websockets-sansio",
        ws_max_size=2**16,
        ws_per_message_deflate=False,  # pages are on this machine: packing what they get takes longer than sending it
        timeout_graceful_shutdown=2,
        server_header=False,
    )


class _LastFile(JsonFile):
    port: int
    token: str


class LastAddress:
    """The port and the token that the studio of a project, or the start page, had last: open pages connect by them.

    They lie in the user's state folder, in a file that only the user can read: never in the project, which may be
    shared or committed. A token is used again on its own port alone.
    """

    def __init__(self, state: Path, folder: Path | None) -> None:
        name = text_digest(str(folder.resolve()))[:32] if folder else "start"
        self._path = state / "addresses" / f"{name}.json"

    def listen(self, port: int | None) -> tuple[socket.socket, str]:
        """Return a socket on a port, and the token of the studio there, which are kept. port: None takes the last one
        where it is free, else a free one, as 0 does. Raises UsageError where the port is taken."""
        last = self._read()
        if port is None and last:
            with suppress(UsageError):
                return _listen(last.port), last.token
        listening = _listen(port or 0)
        taken: int = listening.getsockname()[1]
        token = last.token if last and last.port == taken else token_urlsafe(24)
        with suppress(OSError):  # a home that cannot be written to: pages have to be opened again
            self._path.parent.mkdir(parents=True, exist_ok=True)
            self._path.touch(_PRIVATE)  # before anything is in it
            write_atomically(self._path, _LastFile(port=taken, token=token).model_dump_json())
        return listening, token

    def _read(self) -> _LastFile | None:
        try:
            is_private = self._path.stat().st_mode & 0o777 == _PRIVATE
            return _LastFile.model_validate_json(self._path.read_bytes()) if is_private else None
        except (OSError, ValidationError):
            return None


def _listen(port: int) -> socket.socket:
    try:
        return socket.create_server((ADDRESS, port))
    except (OSError, OverflowError) as error:
        remedy = "Choose another: --port N; 0 takes a free one."
        raise UsageError(f"port {port} cannot be taken: {error}", remedy=remedy) from None


@contextmanager
def _stop_on_signal() -> Iterator[None]:
    """Ctrl-C and SIGTERM leave the block without an error, and all it opened is closed."""

    def end(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    except KeyboardInterrupt:
        return
    finally:
        signal.signal(signal.SIGTERM, before)


def build_app(host: Host, token: str, page: Path) -> ASGIApp:
    """Return the web application of a studio; page: that of the built page. Raises MeshForgeError as `open_page`."""
    app = FastAPI(title="MeshForge studio", docs_url=None, redoc_url=None, openapi_url=None)
    app.state.host = host
    for module in (routes, start, connection):
        app.include_router(module.router)
    app.mount("/", open_page(page))
    for kind in (MeshForgeError, RequestValidationError, HTTPException, Exception):
        app.add_exception_handler(kind, _handle_error)
    return Guard(app, token)


def _handle_error(_: Request, error: Exception) -> JSONResponse:
    match error:
        case RequestValidationError():
            problem, status = Problem(message=describe_invalid_field(error.errors()[0])), 400
        case HTTPException():
            problem, status = Problem(message=str(error.detail)), error.status_code
        case _:
            status = next((status for kind, status in _STATUSES.items() if isinstance(error, kind)), 500)
            problem = _problem_of(error)
    if status == 500:
        _LOG.debug("a fault of the studio", exc_info=error)
    return JSONResponse(problem.model_dump(mode="json"), status)


class PageFiles(StaticFiles):
    """The built page. Browsers keep what has a digest in its name, and ask for the rest each time."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        response = await super().get_response(path, scope)
        is_digested = path.startswith("assets/")
        response.headers["Cache-Control"] = "private, max-age=31536000, immutable" if is_digested else "no-cache"
        return response


def open_page(folder: Path) -> Any:
    """Return the page in a folder. Raises MeshForgeError where it was not built."""
    if not (folder / "index.html").is_file():
        remedy = "Build it: script/build-web"
        raise MeshForgeError("the page of the studio is not built", where=str(folder), remedy=remedy)
    return PageFiles(directory=folder, html=True)


def _problem_of(error: Exception) -> Problem:
    """An error in its parts; a fault of the studio in one sentence."""
    if isinstance(error, OSError):
        error = explain_refusal(error) or error
    if isinstance(error, MeshForgeError):
        conflict = isinstance(error, ConflictError)
        return Problem(message=error.problem, where=error.where, remedy=error.remedy, conflict=conflict)
    return Problem(message=describe_error(error, fault="start the studio with --debug to see where it comes from"))
