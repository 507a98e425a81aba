"""Work on many items in worker processes: a crash or a time-out loses one item, never the batch."""

from __future__ import annotations

import os
import signal
import sys
from collections import deque
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import Future, TimeoutError, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any, TypeVar

from meshforge.batch.workers.memory import bound
from meshforge.errors import MeshForgeError, StoppedError

if TYPE_CHECKING:
    from pebble import ProcessPool

Item = TypeVar("Item")
Result = TypeVar("Result")

AHEAD = 32
"""Items handed out before the oldest is done, for each worker: enough to hide one slow item behind."""
OFTEN = 0.1
"""Seconds between two looks whether to stop."""


@dataclass(frozen=True, slots=True)
class Lost:
    """An item whose worker did not come back, why, and after how many seconds, as far as known."""

    why: str
    seconds: float = 0.0


def isolated(
    function: Callable[[Item], Result],
    items: Sequence[Item],
    *,
    workers: int | None = None,
    timeout: float | None = None,
    memory: int | None = None,
    done: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> Generator[Result | Lost, None, None]:
    """The results of `function` on the items, in their order, computed in worker processes.

    workers: how many; None takes one a processor, never more than items; 0 works in this process, without
    protection against crashes and without bounds. timeout: seconds for one item; memory: bytes that a worker may take
    for one item, beyond what it has when that begins. done: called whenever an item is finished, in any order, maybe
    from another thread. stop: asked often whether to end all work in the midst.
    Raises MeshForgeError when worker processes cannot be started at all, StoppedError when it was told to stop.
    """
    number = min(processors() if workers is None else workers, len(items))
    if number > 0:
        yield from _pooled(function, items, number, timeout, memory, done, stop)
        return
    for item in items:
        heed(stop)
        result = function(item)
        if done:
            done()
        yield result


def processors() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _pooled(
    function: Callable[[Item], Result],
    items: Sequence[Item],
    workers: int,
    timeout: float | None,
    memory: int | None,
    done: Callable[[], None] | None,
    stop: Callable[[], bool] | None,
) -> Generator[Result | Lost, None, None]:
    from pebble import ProcessPool

    pool = ProcessPool(workers, initializer=_begin, initargs=[function, memory], context=workers_context())
    waiting: deque[Future[Result]] = deque()
    rest = iter(items)
    try:
        while True:
            while len(waiting) < AHEAD * workers and (item := next(rest, _END)) is not _END:
                future = _scheduled(pool, item, timeout)
                if done:
                    future.add_done_callback(lambda _: done())
                waiting.append(future)
            if not waiting:
                break
            while stop and not wait([waiting[0]], OFTEN).done:
                heed(stop)
            oldest = _outcome(waiting.popleft(), timeout)
            yield oldest
    finally:  # also when the caller stops early, or on Ctrl-C
        pool.stop()  # type: ignore[no-untyped-call]  # pebble has no types
        pool.join()


_END: Any = object()
_function: Callable[[Any], Any]
_memory: int | None = None


def _begin(function: Callable[[Any], Any], memory: int | None) -> None:
    """What each worker does first: the function comes once, not with every item, for it may hold much."""
    global _function, _memory
    _function, _memory = function, memory


def _worked(item: Any) -> Any:
    """The bound counts from here, for each item anew: libraries keep some of what earlier ones took."""
    if _memory:
        bound(_memory)
    return _function(item)


def heed(stop: Callable[[], bool] | None) -> None:
    """Raise StoppedError where it is said that all is to end."""
    if stop and stop():
        raise StoppedError("this was stopped")


def _scheduled(pool: ProcessPool, item: Any, timeout: float | None) -> Future[Any]:
    try:
        return pool.schedule(_worked, args=[item], timeout=timeout)
    except RuntimeError as error:  # the pool has given up
        raise _no_workers(error) from error


def workers_context() -> Any:
    """How workers start: a clean server process that has the imports done forks them, where forking is safe.

    Measured: the first worker is there in 0.45 s, each further one in 0.02 s (0.45 s each when spawned).
    Forking this process itself would copy locks that its other threads hold.
    """
    if sys.platform != "linux":
        return _with_locks(get_context("spawn"))
    context = get_context("forkserver")
    context.set_forkserver_preload(["meshforge.batch.edit"])
    return _with_locks(context)


def _with_locks(context: Any) -> Any:
    """The same for one pool, whose locks stay as long as the pool.

    Pebble lets go of them before it stops its workers; one that was just starting would complain that they are gone.
    """
    own: Any = type(context)()
    locks: list[Any] = []

    def kept_lock() -> Any:
        locks.append(context.RLock())
        return locks[-1]

    own.RLock = kept_lock
    return own


def _outcome(future: Future[Result], timeout: float | None) -> Result | Lost:
    from pebble import ProcessExpired

    try:
        return future.result()
    except TimeoutError:
        return Lost(f"it took longer than {timeout:g} seconds and was stopped", timeout or 0.0)
    except ProcessExpired as error:
        return Lost(f"its worker process died ({_death(error.exitcode)})")
    except BrokenProcessPool as error:
        raise _no_workers(error) from error


def _no_workers(error: Exception) -> MeshForgeError:
    return MeshForgeError(
        f"worker processes do not start: {error}",
        remedy="In a script of your own, put the call below `if __name__ == '__main__':`, or pass workers=0.",
    )


def _death(code: int | None) -> str:
    """How a process ended: negative codes are signals."""
    try:
        return signal.Signals(-code).name if code and code < 0 else f"exit code {code}"
    except ValueError:
        return f"signal {-(code or 0)}"
