"""Worker processes on this machine: a crash, a time-out or too much memory loses one item, never the batch."""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections import deque
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures import Future, TimeoutError, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, suppress
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from multiprocessing.process import current_process
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from meshforge.common import MeshForgeError, Plugin, PluginKind, StoppedError, adopt_plugins, collect_plugins

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
_THREADS = Path("/proc/self/task")
_USABLE_SHARE = 0.9  # of the machine's memory, for all workers together
_CGROUP_LIMIT = Path("/sys/fs/cgroup/memory.max")
_PROCESS_STATUS = Path("/proc/self/status")
MIB = 1 << 20
GIB = 1 << 30


@dataclass(frozen=True, slots=True)
class ExecutionOptions:
    """How work on many items, mostly assets, is executed.

    workers: how many processes; None takes one a processor, never more than items; 0 works in this process, without
    protection against crashes and without bounds. timeout: seconds for one item, None for no bound; memory: bytes that
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
    """The results of `function` on the items, in their order, computed in worker processes of this machine.

    Raises MeshForgeError when worker processes cannot be started at all, StoppedError when `options.stop` said so.
    """
    workers = min(count_processors() if options.workers is None else options.workers, len(items))
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
    """How many processors this process may use."""
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
    raise _start_error(last) from last


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


def worker_context() -> Any:
    """How the workers of one pool start: on Linux by a fork of this process while it has one thread, which takes
    milliseconds, else as those of `server_context`.

    A fork copies the locks that other threads hold, so it is safe where there are none, those of libraries counted.
    Pebble makes its first workers before it starts its threads; one that replaces them comes from the server.
    """
    return _make_context(can_fork=True)


def server_context() -> Any:
    """How the workers of one pool start beside threads: on Linux by a fork of a clean server process.

    The server imports what this process has of MeshForge by now, which is about what workers will need: the first
    worker is there in 0.45 s for `batch`, each further one in 0.02 s (0.45 s each when spawned).
    """
    return _make_context(can_fork=False)


def _make_context(can_fork: bool) -> Any:
    """The context of one pool, whose locks stay as long as the pool.

    Pebble lets go of them before it stops its workers; one that was just starting would complain that they are gone.
    """
    context: Any = get_context("forkserver" if sys.platform == "linux" else "spawn")
    own: Any = type(context)()
    locks: list[Any] = []

    def kept_lock() -> Any:
        locks.append(context.RLock())
        return locks[-1]

    def start_process(**options: Any) -> Any:
        if can_fork and _has_one_thread():
            return get_context("fork").Process(**options)
        if sys.platform == "linux":
            context.set_forkserver_preload(["meshforge.batch.edit", *_list_modules()])
        return context.Process(**options)

    own.RLock, own.Process = kept_lock, start_process
    return own


def _has_one_thread() -> bool:
    """Whether this process may be forked: it has one thread, and is no worker that runs the script it is for."""
    try:
        is_alone = sys.platform == "linux" and len(list(_THREADS.iterdir())) == 1
    except OSError:  # the system does not tell
        return False
    return is_alone and not getattr(current_process(), "_inheriting", False)


def _list_modules() -> list[str]:
    """The modules of MeshForge that this process has imported, but for the command line's, which no worker runs."""
    return [name for name in sys.modules if name.startswith("meshforge.") and not name.startswith("meshforge.cli")]


def _collect(future: Future[Result], timeout: float | None) -> Result | WorkerFailure:
    from pebble import ProcessExpired  # lazy: 0.04 s, not needed in this process alone

    try:
        return future.result()
    except TimeoutError:
        return WorkerFailure(f"it took longer than {timeout:g} seconds and was stopped", timeout or 0.0)
    except ProcessExpired as error:
        return WorkerFailure(f"its worker process died ({_describe_exit(error.exitcode)})")


def _start_error(error: Exception) -> MeshForgeError:
    remedy = "In a script of your own, put the call below `if __name__ == '__main__':`, or pass workers=0."
    return MeshForgeError(f"worker processes do not start: {error}", remedy=remedy)


def _describe_exit(code: int | None) -> str:
    """How a process ended: negative codes are signals."""
    try:
        return signal.Signals(-code).name if code and code < 0 else f"exit code {code}"
    except ValueError:
        return f"signal {-(code or 0)}"


def memory_share(workers: int) -> int | None:
    """An even share [bytes] of the memory that this machine, or this container, has; None where it does not tell."""
    try:
        whole = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None
    with suppress(OSError, ValueError):  # no container, or one without a bound
        whole = min(whole, int(_CGROUP_LIMIT.read_text()))
    return int(whole * _USABLE_SHARE) // max(workers, 1)


def limit_memory(more: int) -> None:
    """Let this process take so many bytes more than it has by now. Only Linux counts them; elsewhere nothing is bound.

    What goes beyond that is a MemoryError, or the end of native code that does not expect one.
    """
    if not _PROCESS_STATUS.exists():
        return
    import resource  # lazy: Windows does not have it

    row = next(line for line in _PROCESS_STATUS.read_text().splitlines() if line.startswith("VmData"))
    most = int(row.split()[1]) * 1024 + more
    hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
    resource.setrlimit(resource.RLIMIT_DATA, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
