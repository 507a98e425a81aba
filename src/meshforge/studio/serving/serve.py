"""Serving the studio on this machine, until it is stopped."""

from __future__ import annotations

import logging
import multiprocessing
import signal
import socket
import webbrowser
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from secrets import token_urlsafe
from threading import Thread
from types import FrameType

import uvicorn

from meshforge.batch import STATE, locked
from meshforge.errors import MeshForgeError, ProjectError, UsageError
from meshforge.project import Project
from meshforge.studio.serving.app import application
from meshforge.studio.serving.routes.page import BUILT, page_in
from meshforge.studio.state import Desk, Opening

ADDRESS = "127.0.0.1"
LAST_MOMENT = 3.0
"""Seconds that a worker process is waited for."""
_LOG = logging.getLogger(__name__)


def serve(
    opening: Opening, say: Callable[[str], None], *, port: int = 0, browser: bool = True, page: Path = BUILT
) -> None:
    """Serve a project until Ctrl-C or SIGTERM. say: told the address; port: 0 takes a free one; page: the built page.

    Raises MeshForgeError: no project, no page, the port is taken, or the studio is open on the project already.
    """
    page_in(page)
    project, token = Project.open(opening.folder), token_urlsafe(24)
    with _until_stopped(), ExitStack() as stack:
        _be_alone(stack, project)
        listening = stack.enter_context(closing(_listening(port)))
        desk = Desk(opening)
        stack.callback(_await_processes)
        stack.callback(desk.close)
        address = f"http://{ADDRESS}:{listening.getsockname()[1]}/?token={token}"

        def ready() -> None:
            say(address)
            if browser:
                Thread(target=webbrowser.open, args=(address,), daemon=True).start()

        desk.start()
        _Server(_config(desk, token, page), ready).run(sockets=[listening])


class _Server(uvicorn.Server):
    """A server that says when it is there."""

    def __init__(self, config: uvicorn.Config, ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._ready = ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            self._ready()


def _config(desk: Desk, token: str, page: Path) -> uvicorn.Config:
    return uvicorn.Config(
        application(desk, token, page),
        log_level="info" if _LOG.isEnabledFor(logging.DEBUG) else "critical",
        access_log=False,
        lifespan="off",
        ws="websockets-sansio",
        ws_max_size=2**16,
        timeout_graceful_shutdown=2,
        server_header=False,
    )


def _await_processes() -> None:
    """A worker process that is just starting would complain if its locks went with this process."""
    for process in multiprocessing.active_children():
        process.join(LAST_MOMENT)


def _be_alone(stack: ExitStack, project: Project) -> None:
    """Two studios on one project would each have half of its history."""
    try:
        stack.enter_context(locked(project.folder / STATE / "studio" / "lock", str(project.folder), wait=0))
    except MeshForgeError as error:
        remedy = "Use the page that is open, or stop that studio first."
        raise ProjectError("the studio is open on this project already", where=error.where, remedy=remedy) from None


def _listening(port: int) -> socket.socket:
    try:
        return socket.create_server((ADDRESS, port))
    except OSError as error:
        remedy = "Choose another: --port N; 0 takes a free one."
        raise UsageError(f"port {port} cannot be taken: {error.strerror}", remedy=remedy) from None


@contextmanager
def _until_stopped() -> Iterator[None]:
    """Ctrl-C and SIGTERM end the block as if it came to its end, everything closed."""

    def end(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    except KeyboardInterrupt:
        return
    finally:
        signal.signal(signal.SIGTERM, before)
