"""Worker processes that stand ready: what crashes in them is one error, and the studio goes on."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, TimeoutError
from threading import Lock
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from meshforge.batch import Found
from meshforge.batch.workers.pool import processors, workers_context
from meshforge.errors import MeshForgeError
from meshforge.project import Project

if TYPE_CHECKING:
    from pebble import ProcessPool

Given = ParamSpec("Given")
Result = TypeVar("Result")

TIMEOUT = 300.0
"""Seconds for one piece of work: far above what is usual, so that only a hang is stopped."""


class Workers:
    """Some worker processes, started with the first work."""

    def __init__(self, count: int | None = None, timeout: float = TIMEOUT) -> None:
        self.count = count or processors()
        self._timeout = timeout
        self._lock = Lock()
        self._pool: ProcessPool | None = None
        self._closed = False

    def start(self, function: Callable[Given, Result], *args: Given.args, **kwargs: Given.kwargs) -> Future[Result]:
        """Begin some work. Its result raises what the function raises; see `arrived`."""
        from pebble import ProcessPool

        with self._lock:
            if self._closed:
                raise MeshForgeError("the studio is being closed")
            self._pool = self._pool or ProcessPool(max_workers=self.count, context=workers_context())
            future: Future[Result] = self._pool.schedule(function, args=args, kwargs=kwargs, timeout=self._timeout)
        return future

    def run(self, function: Callable[Given, Result], *args: Given.args, **kwargs: Given.kwargs) -> Result:
        """Do some work and wait for it. Raises what the function raises, MeshForgeError where its process died."""
        return arrived(self.start(function, *args, **kwargs))

    def close(self) -> None:
        """Stop all work at once."""
        with self._lock:
            pool, self._pool, self._closed = self._pool, None, True
        if pool:
            pool.stop()  # type: ignore[no-untyped-call]  # pebble has no types
            pool.join()


def alone(project: Project, asset: str) -> Project:
    """The same project with one asset, for a worker process."""
    return Project(project.folder, Found(project.found.base, (project.path(asset),)))


def arrived(future: Future[Result]) -> Result:
    """The result of some work. Raises MeshForgeError where its process died, or took too long."""
    from pebble import ProcessExpired

    try:
        return future.result()
    except ProcessExpired as error:
        raise MeshForgeError(f"the process that worked on this died (exit code {error.exitcode})") from None
    except TimeoutError:
        raise MeshForgeError("this took too long and was stopped") from None
