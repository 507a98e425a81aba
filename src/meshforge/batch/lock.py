"""One writer at a time: a lock that the system releases when its process dies, however it dies."""

import os
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from meshforge.common import MeshForgeError


class _ThreadLocks(threading.local):
    """The lock files that the present thread of the present process holds."""

    def __init__(self) -> None:
        self.places: set[tuple[int, str]] = set()


_LOCKS = _ThreadLocks()
_HANDLES: set[int] = set()


def _close_handles() -> None:
    """In a forked process: else it would hold the locks for as long as it lives."""
    for handle in _HANDLES:
        os.close(handle)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_close_handles)


@contextmanager
def hold_lock(path: Path, what: str, wait: float = 10.0, *, again: bool = False) -> Iterator[None]:
    """Hold the lock file `path`, made if absent, for the time of a `with` block.

    wait: seconds to wait for another holder; again: a thread that holds it by `again` may take it once more.
    Raises MeshForgeError, saying that `what` is busy, after the wait.
    """
    place = (os.getpid(), os.path.realpath(path))  # a forked process holds nothing
    if not again:
        with _acquire(path, what, wait):
            yield
    elif place in _LOCKS.places:
        yield
    else:
        with _acquire(path, what, wait):
            _LOCKS.places.add(place)
            try:
                yield
            finally:
                _LOCKS.places.discard(place)


@contextmanager
def _acquire(path: Path, what: str, wait: float) -> Iterator[None]:
    path.parent.mkdir(parents=True, exist_ok=True)
    handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
    _HANDLES.add(handle)
    try:
        until = time.monotonic() + wait
        while not _try_lock(handle):
            if time.monotonic() >= until:
                raise MeshForgeError(
                    "another meshforge is writing here", where=what, remedy="Wait until it is done, then try again."
                )
            time.sleep(0.02)
        yield
    finally:
        _HANDLES.discard(handle)
        os.close(handle)  # closing lets go of the lock


def _try_lock(handle: int) -> bool:
    try:
        if os.name == "nt":
            import msvcrt  # lazy: only Windows has it

            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]  # Windows only
        else:
            import fcntl  # lazy: Windows does not have it

            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
