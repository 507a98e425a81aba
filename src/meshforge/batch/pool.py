"""A pool of worker processes, watched by the one thread that asks for results: what died or took too long is replaced.

Without threads of its own a pool can fork the process that it is for, and its workers begin with all that is loaded.
"""

from __future__ import annotations

import gc
import pickle
import signal
import sys
import time
import traceback
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess, current_process
from pathlib import Path
from typing import Any, Generic, TypeVar

from meshforge.common import MeshForgeError

Item = TypeVar("Item")
Result = TypeVar("Result")

ITEMS_AHEAD = 32
"""Items handed out before the oldest is done, for each worker: enough to hide one slow item behind."""
_QUICK = 0.1  # seconds of an item, up to which a worker gets others before it is done
_WAITING_ITEMS = 4  # items that a worker of quick ones has at most
_LARGEST_WAITING = 8 << 10  # bytes of an item that may wait: pipes hold more, so that nobody waits to write
_MOST_FAILED_STARTS = 2  # in a row
_THREADS = Path("/proc/self/task")
_SECONDS_TO_DIE = 1.0  # of a process that has closed its pipe


@dataclass(frozen=True, slots=True)
class WorkerFailure:
    """An item whose worker did not come back, why, and after how many seconds, as far as known."""

    why: str
    seconds: float = 0.0


@dataclass(frozen=True, slots=True)
class ItemError:
    """What the function raised for an item."""

    error: Exception


class _Worker:
    """A process and the items that it has, the oldest of which it works on. since: when that began, None before the
    process is ready."""

    def __init__(self, context: Any, function: Callable[[Any], Any], others: Sequence[Connection]) -> None:
        self.connection, theirs = context.Pipe()
        inherited = [self.connection, *others] if context.get_start_method() == "fork" else []
        self.process: BaseProcess = context.Process(target=_work, args=(theirs, inherited, function), daemon=True)
        self.process.start()
        theirs.close()  # so that the end of the process is the end of the pipe
        self.items: deque[int] = deque()
        self.since: float | None = None
        self.is_quick = False

    def finish(self) -> int:
        """The item that is done; the next one begins."""
        now = time.monotonic()
        self.is_quick = self.since is not None and now - self.since < _QUICK
        self.since = now
        return self.items.popleft()

    def has_taken(self, seconds: float) -> bool:
        """Whether it has worked so long on its oldest item."""
        return bool(self.items) and self.since is not None and time.monotonic() - self.since >= seconds

    def stop(self, seconds: float = 0.0) -> int | None:
        """The exit code of the process, which has so many seconds to end by itself."""
        self.process.join(seconds)
        self.process.kill()
        self.process.join()
        self.connection.close()
        return self.process.exitcode


class WorkerPool(Generic[Item, Result]):
    """Some worker processes that compute a function on items. timeout: seconds for one item, None for no bound.

    Its methods raise MeshForgeError when worker processes do not start.
    """

    def __init__(
        self, function: Callable[[Item], Result], items: Sequence[Item], workers: int, timeout: float | None
    ) -> None:
        self._function, self._items, self._count, self._timeout = function, items, workers, timeout
        self._context = _quickest_context()
        self._workers: list[_Worker] = []
        self._next, self._again = 0, deque[int]()  # the first item that nobody had, and those that come back
        self._failed_starts = 0

    def hand_out(self, limit: int) -> None:
        """Give work on the items before a limit to the workers that have too little, starting those that are absent."""
        for size in range(1, _WAITING_ITEMS + 1):
            while len(self._workers) < self._count and self._has_more(limit):
                self._start()
            for worker in self._workers:
                if len(worker.items) < size and (size == 1 or worker.is_quick) and self._has_more(limit):
                    self._give(worker)

    def collect(self, seconds: float | None) -> Iterator[tuple[int, Result | WorkerFailure | ItemError]]:
        """Wait up to so many seconds, None for no bound; the items that are done by then, by their places."""
        wait([worker.connection for worker in self._workers], self._seconds_to_wait(seconds))
        for worker in list(self._workers):
            try:
                while worker.connection.poll():
                    message = pickle.loads(worker.connection.recv_bytes())
                    if worker.since is None:  # it is ready
                        worker.since, self._failed_starts = time.monotonic(), 0
                    else:
                        yield worker.finish(), message
            except (EOFError, OSError):
                yield from self._replace(worker, None)
            else:
                if self._timeout is not None and worker.has_taken(self._timeout):
                    yield from self._replace(worker, self._timeout)

    def close(self) -> None:
        """End all processes, whatever they do."""
        for worker in self._workers:
            worker.process.kill()
        while self._workers:
            self._workers.pop().stop()

    def _has_more(self, limit: int) -> bool:
        return bool(self._again) or self._next < min(limit, len(self._items))

    def _start(self) -> None:
        others = [worker.connection for worker in self._workers]
        try:
            self._workers.append(_Worker(self._context, self._function, others))
        except RuntimeError as error:
            raise _start_error("each of them runs the script that starts them") from error

    def _give(self, worker: _Worker) -> None:
        index = self._again[0] if self._again else self._next
        message = pickle.dumps(self._items[index])
        if worker.items and len(message) > _LARGEST_WAITING:
            return
        if self._again:
            self._again.popleft()
        else:
            self._next += 1
        if not worker.items and worker.since is not None:
            worker.since = time.monotonic()
        worker.items.append(index)
        with suppress(OSError):  # it has died, which `collect` will see
            worker.connection.send_bytes(message)

    def _seconds_to_wait(self, seconds: float | None) -> float | None:
        begun = [worker.since for worker in self._workers if worker.items and worker.since is not None]
        if self._timeout is None or not begun:
            return seconds
        left = max(0.0, min(begun) + self._timeout - time.monotonic())
        return left if seconds is None else min(left, seconds)

    def _replace(self, worker: _Worker, timeout: float | None) -> Iterator[tuple[int, WorkerFailure]]:
        """Let go of a worker that died, or of one that took longer than a time-out.

        Its oldest item has failed, the others come back.
        """
        code = worker.stop(_SECONDS_TO_DIE if timeout is None else 0.0)
        self._workers.remove(worker)
        if worker.since is None:
            self._failed_starts += 1
            if self._failed_starts >= _MOST_FAILED_STARTS:
                raise _start_error(f"they end at once ({_describe_exit(code)})")
        elif worker.items:
            died = f"its worker process died ({_describe_exit(code)})"
            why = died if timeout is None else f"it took longer than {timeout:g} seconds and was stopped"
            yield worker.items.popleft(), WorkerFailure(why, timeout or 0.0)
        self._again.extendleft(reversed(worker.items))


def _work(connection: Connection, inherited: Sequence[Connection], function: Callable[[Any], Any]) -> None:
    """What a worker does until the other end of its pipe is closed. inherited: ends that are not for it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the command hears it, too, and ends its workers
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    for other in inherited:
        other.close()
    gc.freeze()  # what came with a fork is not looked through, so it stays shared
    with suppress(EOFError, OSError):  # the command is gone
        connection.send_bytes(pickle.dumps(None))
        while True:
            connection.send_bytes(_compute(connection.recv_bytes(), function))


def _compute(item: bytes, function: Callable[[Any], Any]) -> bytes:
    """The result of an item, or what was raised, as it goes through a pipe."""
    try:
        return pickle.dumps(function(pickle.loads(item)))
    except Exception as error:
        error.add_note(f"In a worker process:\n{traceback.format_exc()}")
        with suppress(Exception):
            return pickle.dumps(ItemError(error))
        return pickle.dumps(ItemError(MeshForgeError(f"{type(error).__name__}: {error}")))


def _quickest_context() -> Any:
    """How the workers of a pool start: by a fork of this process where that is safe, which takes milliseconds.

    A fork copies the locks that other threads hold, so it is safe where there are none, those of libraries counted.
    """
    is_starting = getattr(current_process(), "_inheriting", False)  # a worker that runs the script it is for
    return get_context("fork") if _has_one_thread() and not is_starting else worker_context()


def _has_one_thread() -> bool:
    """Whether this process has no other thread; False where the system does not tell."""
    try:
        return sys.platform == "linux" and len(list(_THREADS.iterdir())) == 1
    except OSError:
        return False


def worker_context() -> Any:
    """How workers start: a clean server process that has the imports done forks them, where forking is safe.

    The server imports what this process has of MeshForge by now, which is about what workers will need: the first
    worker is there in 0.45 s for `batch`, each further one in 0.02 s (0.45 s each when spawned).
    Forking this process itself would copy locks that its other threads hold.
    """
    if sys.platform != "linux":
        return _keep_locks(get_context("spawn"))
    context = get_context("forkserver")
    context.set_forkserver_preload(["meshforge.batch.edit", *_list_modules()])
    return _keep_locks(context)


def _list_modules() -> list[str]:
    """The modules of MeshForge that this process has imported, but for the command line's, which no worker runs."""
    return [name for name in sys.modules if name.startswith("meshforge.") and not name.startswith("meshforge.cli")]


def _keep_locks(context: Any) -> Any:
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


def _start_error(why: str) -> MeshForgeError:
    remedy = "In a script of your own, put the call below `if __name__ == '__main__':`, or pass workers=0."
    return MeshForgeError(f"worker processes do not start: {why}", remedy=remedy)


def _describe_exit(code: int | None) -> str:
    """How a process ended: negative codes are signals."""
    try:
        return signal.Signals(-code).name if code and code < 0 else f"exit code {code}"
    except ValueError:
        return f"signal {-(code or 0)}"
