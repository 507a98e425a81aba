"""Worker processes on this machine: a crash, a time-out or too much memory loses one item, never the batch."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Literal

from meshforge.batch.pool import Item, ItemError, Result, WorkerFailure, WorkerPool
from meshforge.common import StoppedError

Backend = Literal["local", "ray"]

TIMEOUT = 600.0
"""Seconds for one asset: far above the slowest real one, so that only a hang is stopped."""
ITEMS_AHEAD = 32
"""Items handed out before the oldest is done, for each worker: enough to hide one slow item behind."""
POLL_SECONDS = 0.1
"""Seconds between two looks whether to stop."""

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


def run_isolated(
    function: Callable[[Item], Result], items: Sequence[Item], options: ExecutionOptions = UNBOUNDED
) -> Generator[Result | WorkerFailure, None, None]:
    """The results of `function` on the items, in their order, computed in worker processes of this machine.

    Raises MeshForgeError when worker processes cannot be started at all, StoppedError when `options.stop` said so.
    """
    workers = min(count_processors() if options.workers is None else options.workers, len(items))
    if workers > 0:
        yield from _run_pool(function, items, workers, options)
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


def _run_pool(
    function: Callable[[Item], Result], items: Sequence[Item], workers: int, options: ExecutionOptions
) -> Generator[Result | WorkerFailure, None, None]:
    work = partial(_run_within, options.memory, function) if options.memory else function
    pool: WorkerPool[Item, Result] = WorkerPool(work, items, workers, options.timeout)
    found: dict[int, Result | WorkerFailure | ItemError] = {}
    try:
        for oldest in range(len(items)):
            while oldest not in found:
                raise_if_stopped(options.stop)
                pool.hand_out(oldest + ITEMS_AHEAD * workers)
                for index, result in pool.collect(POLL_SECONDS if options.stop else None):
                    found[index] = result
                    if options.progress:
                        options.progress()
            result = found.pop(oldest)
            if isinstance(result, ItemError):
                raise result.error
            yield result
    finally:  # also when the caller stops early, or on Ctrl-C
        pool.close()


def _run_within(memory: int, function: Callable[[Item], Result], item: Item) -> Result:
    """The bound counts from here, for each item anew: libraries keep some of what earlier ones took."""
    limit_memory(memory)
    return function(item)


def raise_if_stopped(stop: Callable[[], bool] | None) -> None:
    """Raise StoppedError where `stop` says so."""
    if stop and stop():
        raise StoppedError("this was stopped")


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
