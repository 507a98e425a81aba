"""Worker processes in which a crash is one error."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import CancelledError, Future, TimeoutError
from dataclasses import replace
from threading import Lock
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar
from weakref import WeakSet

from meshforge.batch import count_processors
from meshforge.common import MeshForgeError, StoppedError
from meshforge.common.processes import begin_isolated, server_context
from meshforge.project import Project

if TYPE_CHECKING:
    from pebble import ProcessPool


Params = ParamSpec("Params")
Result = TypeVar("Result")

WORK_TIMEOUT = 300.0
"""Seconds for one piece of work: far above what is usual, so that only a hang is stopped."""


class Workers:
    """Some worker processes, started with the first call."""

    def __init__(self, count: int | None = None, timeout: float = WORK_TIMEOUT) -> None:
        self.count = count or count_processors()
        self._timeout = timeout
        self._lock = Lock()
        self._pool: ProcessPool | None = None
        self._closed = False
        self._futures: WeakSet[Future[Any]] = WeakSet()

    def start(self, function: Callable[Params, Result], *args: Params.args, **kwargs: Params.kwargs) -> Future[Result]:
        """Start some work. Its result raises what the function raises; see `wait_for`."""
        from pebble import ProcessPool  # lazy: 0.1 s, and processes that unpickle work of this module need none

        with self._lock:
            if self._closed:
                raise MeshForgeError("the studio is being closed")
            if self._pool and not self._pool.active:  # broken: a process died before it said which work it had taken
                self._pool.join()
                self._pool = None
            self._pool = self._pool or ProcessPool(
                max_workers=self.count, context=server_context(), initializer=begin_isolated
            )
            future: Future[Result] = self._pool.schedule(function, args=args, kwargs=kwargs, timeout=self._timeout)
            self._futures.add(future)
        return future

    def run(self, function: Callable[Params, Result], *args: Params.args, **kwargs: Params.kwargs) -> Result:
        """Do some work and wait for it. Raises what the function raises, MeshForgeError where its process died."""
        return wait_for(self.start(function, *args, **kwargs))

    def close(self) -> None:
        """Stop all work at once."""
        with self._lock:
            pool, self._pool, self._closed = self._pool, None, True
            futures = list(self._futures)
        for future in futures:  # a pool that is stopped leaves who waits for it waiting
            future.cancel()
        if pool:
            pool.stop()  # type: ignore[no-untyped-call]  # pebble has no types
            pool.join()


def future_of(result: Result) -> Future[Result]:
    """Return a future that has its result already."""
    future: Future[Result] = Future()
    future.set_result(result)
    return future


def project_of_one(project: Project, asset: str) -> Project:
    """Return the same project with one asset, for a worker process."""
    return Project(project.folder, replace(project.every, paths=(project.path(asset),)))


def wait_for(future: Future[Result]) -> Result:
    """Return the result of some work. Raises MeshForgeError where its process died, took too long or was stopped."""
    from concurrent.futures.process import BrokenProcessPool  # lazy: as above

    from pebble import ProcessExpired  # lazy: as above

    try:
        return future.result()
    except CancelledError:
        raise StoppedError("the studio is being closed") from None
    except ProcessExpired as error:
        raise MeshForgeError(f"the process that worked on this died (exit code {error.exitcode})") from None
    except BrokenProcessPool:
        raise MeshForgeError("the process that worked on this died") from None
    except TimeoutError:
        raise MeshForgeError("this took too long and was stopped") from None
