"""Worker processes on this machine: a crash, a time-out or too much memory loses one item, never the batch."""

from __future__ import annotations

import gc
import os
import signal
from collections import deque
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures import Future, TimeoutError, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from meshforge.common import MeshForgeError, Plugin, PluginKind, StoppedError, adopt_plugins, collect_plugins
from meshforge.common.processes import begin_isolated, describe_exit, limit_memory, worker_context

if TYPE_CHECKING:
    from pebble import ProcessPool

Item = TypeVar("Item")
Result = TypeVar("Result")
Backend = Literal["local", "ray"]

TIMEOUT = 600.0
"""Seconds for one asset: far above the slowest real one, so that only a hang is stopped."""
ITEMS_AHEAD = 32
"""Items handed out before the oldest is done, for each worker: enough to hide one slow item behind."""
POLL_SECONDS = 0.1
"""Seconds between two looks whether to stop."""

_END: Any = object()
_function: Callable[[Any], Any]
_memory: int | None = None

_BARREN_POOLS = 2  # so many in a row that give nothing are the last
_POOL_CYCLE = 0.01  # seconds between two looks of a pool at its workers, all of which its end waits for
_BY_COMMAND = "MESHFORGE_WORKERS"  # an environment variable, for it is the same in all processes of a command
MIB = 1 << 20


@dataclass(frozen=True, slots=True)
class ExecutionOptions:
    """How work on many items, mostly assets, is executed.

    workers: how many processes, never more than items; 0 works in this process, without protection against crashes and
    without bounds. None takes one a processor in the commands and the studio, and 0 in Python, where each worker might
    run a script again that has no main guard. timeout: seconds for one item, None for no bound; memory: bytes that
    a worker may take for one item, beyond what it has when that begins. stop: asked often whether to end all work in
    the midst. backend: the workers of this machine, or those of a Ray cluster; results are the same. progress: called
    whenever an item is finished, in any order, maybe from another thread.
    """

    workers: int | None = None
    timeout: float | None = TIMEOUT
    memory: int | None = None
    stop: Callable[[], bool] | None = None
    backend: Backend = "local"
    progress: Callable[[], None] | None = None


EXECUTION_DEFAULTS = ExecutionOptions()
IN_PROCESS = ExecutionOptions(workers=0)
"""In this process, one item after the other: nothing has to be started, and nothing is bounded."""
UNBOUNDED = ExecutionOptions(timeout=None)
"""In worker processes, each item for as long as it takes."""


@dataclass(frozen=True, slots=True)
class WorkerFailure:
    """An item whose worker did not come back, why, and after how many seconds, as far as known."""

    why: str
    seconds: float = 0.0


def run_isolated(
    function: Callable[[Item], Result], items: Sequence[Item], options: ExecutionOptions = UNBOUNDED
) -> Generator[Result | WorkerFailure, None, None]:
    """Yield the results of `function` on the items, in their order, computed in worker processes of this machine.

    Raises MeshForgeError when worker processes cannot be started at all, StoppedError when `options.stop` said so.
    """
    default = count_processors() if os.environ.get(_BY_COMMAND) else 0
    workers = min(default if options.workers is None else options.workers, len(items))
    if workers > 0:
        yield from _run_pools(function, items, workers, options)
        return
    for item in items:
        raise_if_stopped(options.stop)
        result = function(item)
        if options.progress:
            options.progress()
        yield result


def count_processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _run_pools(
    function: Callable[[Item], Result], items: Sequence[Item], workers: int, options: ExecutionOptions
) -> Generator[Result | WorkerFailure, None, None]:
    """The results of one pool, or of several: pebble gives a pool up where a worker dies before it said what it works
    on; another one goes on with what is left. Raises MeshForgeError where two in a row give nothing."""
    done = barren = 0
    while barren < _BARREN_POOLS:
        before = done
        try:
            with closing(_run_pool(function, items[done:], workers, options)) as results:
                for result in results:
                    done += 1
                    yield result
            return
        except BrokenProcessPool as error:
            barren = 0 if done > before else barren + 1
            last = error
    remedy = "In a script of your own, put the call below `if __name__ == '__main__':`, or pass workers=0."
    raise MeshForgeError(f"worker processes do not start: {last}", remedy=remedy) from last


def _run_pool(
    function: Callable[[Item], Result], items: Sequence[Item], workers: int, options: ExecutionOptions
) -> Generator[Result | WorkerFailure, None, None]:
    from pebble import CONSTS, ProcessPool  # lazy: 0.04 s, not needed in this process alone

    CONSTS.sleep_unit = _POOL_CYCLE
    progress, stop = options.progress, options.stop
    pool = ProcessPool(
        workers,
        initializer=_begin_worker,
        initargs=[function, options.memory, collect_plugins()],
        context=worker_context(),
    )
    waiting: deque[Future[Result]] = deque()
    rest = iter(items)
    try:
        while True:
            while len(waiting) < ITEMS_AHEAD * workers and (item := next(rest, _END)) is not _END:
                future = _schedule(pool, item, options.timeout)
                if progress:
                    future.add_done_callback(partial(_count_done, progress))
                waiting.append(future)
            if not waiting:
                break
            while stop and not wait([waiting[0]], POLL_SECONDS).done:
                raise_if_stopped(stop)
            oldest = _collect(waiting.popleft(), options.timeout)
            yield oldest
    finally:  # also when the caller stops early, or on Ctrl-C
        pool.stop()  # type: ignore[no-untyped-call]  # pebble has no types
        pool.join()


def _begin_worker(
    function: Callable[[Any], Any], memory: int | None, plugins: Mapping[PluginKind, tuple[Plugin, ...]]
) -> None:
    """What each worker does first: the function comes once, not with every item, for it may hold much."""
    begin_isolated()
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # what the parent does then is not for a worker
    gc.freeze()  # what came with a fork is not looked through, so it stays shared
    adopt_plugins(plugins)
    global _function, _memory
    _function, _memory = function, memory


def _run_item(item: Any) -> Any:
    """The bound counts from here, for each item anew: libraries keep some of what earlier ones took."""
    if _memory:
        limit_memory(_memory)
    return _function(item)


def raise_if_stopped(stop: Callable[[], bool] | None) -> None:
    """Raise StoppedError where `stop` says so."""
    if stop and stop():
        raise StoppedError("this was stopped")


def _schedule(pool: ProcessPool, item: Any, timeout: float | None) -> Future[Any]:
    try:
        return pool.schedule(_run_item, args=[item], timeout=timeout)
    except RuntimeError as error:  # the pool has given up
        raise BrokenProcessPool(str(error)) from error


def _count_done(progress: Callable[[], object], future: Future[Any]) -> None:
    """Count an item that is done, not one that waits for another pool."""
    if future.cancelled() or not isinstance(future.exception(), BrokenProcessPool):
        progress()


def _collect(future: Future[Result], timeout: float | None) -> Result | WorkerFailure:
    from pebble import ProcessExpired  # lazy: 0.04 s, not needed in this process alone

    try:
        return future.result()
    except TimeoutError:
        return WorkerFailure(f"it took longer than {timeout:g} seconds and was stopped", timeout or 0.0)
    except ProcessExpired as error:
        return WorkerFailure(f"its worker process died ({describe_exit(error.exitcode)})")
