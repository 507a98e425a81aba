"""Processes beside this one: how they start, what memory they may take, and one in which native code runs that a
damaged file may crash or hang: that process ends, and nothing else is lost."""

from __future__ import annotations

import faulthandler
import os
import pickle
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable
from contextlib import nullcontext, suppress
from multiprocessing import get_context
from multiprocessing.process import current_process
from pathlib import Path
from types import ModuleType
from typing import Any, TypeVar, cast

from meshforge.common.files import confine_reads, reads_folder
from meshforge.common.messages import AssetError

Result = TypeVar("Result")

PATIENCE = 60.0
"""Seconds without a sign of progress after which a call is taken to hang."""
_BEAT = 1.0  # seconds between two signs of progress
_REMEDY = "The file is damaged, or made to do harm: repair it, or export it anew."
_SAFE_PATH = "PYTHONSAFEPATH"
_THREADS = Path("/proc/self/task")
_USABLE_SHARE = 0.9  # of the machine's memory, for all workers together
_CGROUP_LIMIT = Path("/sys/fs/cgroup/memory.max")
_PROCESS_STATUS = Path("/proc/self/status")

_LOCK = threading.RLock()
_worker: _Worker | None = None
_caller: Any = None  # in the process of `call_isolated`, the connection to the one that asks
_is_isolated = False
_last_beat = 0.0


def begin_isolated() -> None:
    """Say of this process that it may crash: what starts it loses one item of its work then."""
    global _is_isolated
    _is_isolated = True


def call_isolated(function: Callable[..., Result], *args: Any, where: str) -> Result:
    """Return what a function of a module gives, computed in a process of its own that later calls use again; in a
    worker process, which is isolated already, there.

    where: the file it is about. Raises what the function raises, and AssetError where that process dies, or reports no
    progress for `PATIENCE` seconds.
    """
    global _worker
    if _is_isolated:
        return function(*args)
    with _LOCK:
        try:
            _worker = _worker or _Worker()
            is_done, result = _worker.call((Path.cwd(), reads_folder(), function, args))
        except (EOFError, ConnectionError):
            problem = f"the process that read it died ({describe_exit(_stop_worker(wait=1.0))})"
            raise AssetError(problem, where=where, remedy=_REMEDY) from None
        except TimeoutError:
            _stop_worker()
            problem = f"the process that read it came no further for {PATIENCE:g} seconds, and was stopped"
            raise AssetError(problem, where=where, remedy=_REMEDY) from None
        except BaseException:  # Ctrl-C: what it is at would be the answer to the next call
            _stop_worker()
            raise
    if is_done:
        return cast(Result, result)
    raise result


def report_progress() -> None:
    """Say that an isolated call goes on; elsewhere do nothing."""
    global _last_beat
    if _caller is not None and time.monotonic() - _last_beat > _BEAT:
        _caller.send_bytes(b"")
        _watch()
        _last_beat = time.monotonic()


class _Worker:
    """The process of `call_isolated`; it ends with this one."""

    def __init__(self) -> None:
        context, main = get_context("spawn"), sys.modules["__main__"]
        self.connection, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs,), daemon=True)
        sys.modules["__main__"] = ModuleType("__main__")  # it needs none: a script without a main guard runs once
        try:
            self.process.start()
        finally:
            sys.modules["__main__"] = main
        theirs.close()

    def call(self, request: tuple[Any, ...]) -> tuple[bool, Any]:
        """Whether a request is done, and its result, else its error. Raises EOFError, ConnectionError, TimeoutError."""
        self.connection.send(request)
        while self.connection.poll(PATIENCE):
            if reply := self.connection.recv_bytes():
                return cast(tuple[bool, Any], pickle.loads(reply))
        raise TimeoutError


def _stop_worker(wait: float = 0.0) -> int | None:
    """End the process of `call_isolated`, after some seconds; its exit code."""
    global _worker
    stopped, _worker = _worker, None
    if stopped is None:
        return None
    stopped.process.join(wait)
    stopped.process.kill()
    stopped.process.join()
    stopped.connection.close()
    return stopped.process.exitcode


def _watch() -> None:
    """End this process if it comes no further, though the one that asked may be gone; native code cannot stop that."""
    faulthandler.dump_traceback_later(2 * PATIENCE, exit=True, file=2)


def _serve(connection: Any) -> None:
    """Answer one request after the other; what libraries print is dropped."""
    global _caller
    _caller = connection
    begin_isolated()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that asks
    for stream in (1, 2):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
    with suppress(EOFError):
        while True:
            folder, reach, function, args = connection.recv()
            os.chdir(folder)
            _watch()
            if share := memory_share(2):
                limit_memory(share)
            try:
                with confine_reads(reach) if reach else nullcontext():
                    reply = True, function(*args)
            except Exception as error:
                error.add_note(traceback.format_exc())
                reply = False, error
            faulthandler.cancel_dump_traceback_later()
            connection.send_bytes(pickle.dumps(reply, protocol=5))  # which keeps arrays write-protected


def worker_context() -> Any:
    """Return how the workers of one pool start: on Linux by a fork of this process while it has one thread, which takes
    milliseconds, else as those of `server_context`.

    A fork copies the locks that other threads hold, so it is safe where there are none, those of libraries counted.
    Pebble makes its first workers before it starts its threads; one that replaces them comes from the server.
    """
    return _make_context(can_fork=True)


def server_context() -> Any:
    """Return how the workers of one pool start beside threads: on Linux by a fork of a clean server process.

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
            own_modules = (name for name in sys.modules if name.startswith("meshforge."))
            needed = [name for name in own_modules if not name.startswith("meshforge.cli")]  # which no worker runs
            context.set_forkserver_preload(["meshforge.batch.edit", *needed])
            _start_server()
        return context.Process(**options)

    own.RLock, own.Process = kept_lock, start_process
    return own


def _start_server() -> None:
    """Start the server of forks, where there is none yet, so that it imports nothing from the present folder."""
    from multiprocessing import forkserver  # lazy: Windows has none

    before = os.environ.get(_SAFE_PATH)
    os.environ[_SAFE_PATH] = "1"
    try:
        forkserver.ensure_running()
    finally:
        os.environ.pop(_SAFE_PATH) if before is None else os.environ.update({_SAFE_PATH: before})


def _has_one_thread() -> bool:
    """Whether this process may be forked: it has one thread, and is no worker that runs the script it is for."""
    try:
        is_alone = sys.platform == "linux" and len(list(_THREADS.iterdir())) == 1
    except OSError:  # the system does not tell
        return False
    return is_alone and not getattr(current_process(), "_inheriting", False)


def describe_exit(code: int | None) -> str:
    """Return how a process ended: negative codes are signals."""
    try:
        return signal.Signals(-code).name if code and code < 0 else f"exit code {code}"
    except ValueError:
        return f"signal {-(code or 0)}"


def memory_share(workers: int) -> int | None:
    """Return an even share [bytes] of the memory that this machine, or this container, has; None if unknown."""
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
