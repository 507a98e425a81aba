"""Calls to the learning process: of each kind only the latest counts, and flags cancel what runs."""

import mmap
import os
import struct
import tempfile
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from threading import Lock
from typing import Any, Literal, get_args

from meshforge.common import MeshForgeError, StoppedError, describe_error
from meshforge.studio.workers import Workers, wait_for

CallKind = Literal["learn", "reach", "generalise", "assess"]
CALL_KINDS: tuple[CallKind, ...] = get_args(CallKind)

_COUNT = struct.Struct("<q")


class Superseded(MeshForgeError):  # noqa: N818 (nothing went wrong)
    """A newer call of the same kind took its place, or the call was interrupted; nobody needs its result."""


@dataclass(frozen=True, eq=False, slots=True)
class _Call:
    function: Callable[..., Any]
    args: tuple[Any, ...]
    future: Future[Any] = field(default_factory=Future)

    def give_up(self, why: str) -> None:
        """Raise Superseded for whoever still waits for the result."""
        if self.future.set_running_or_notify_cancel():
            self.future.set_exception(Superseded(why))


class LearningProcess:
    """A process for the functions of `process`, which starts with the first call; folder: of the project.

    It makes one call at a time, in the order of `CALL_KINDS`. A new call ends the one before of its kind. One that had
    not started then, or was stopped, raises Superseded. Where the process dies, the call raises
    MeshForgeError, and the next call starts a new process.
    """

    def __init__(self, folder: Path) -> None:
        self._folder, self._workers, self._flag = folder, Workers(1), CancelFlag()
        self._lock = Lock()
        self._waiting: dict[CallKind, _Call] = {}
        self._busy = False

    def call(self, kind: CallKind, function: Callable[..., Any], *args: Any) -> Future[Any]:
        """Call a function with the folder, a token that says when to stop, and some arguments."""
        self._flag.cancel(kind)
        call = _Call(function, (self._folder, self._flag.make_token(kind), *args))
        with self._lock:
            before, self._waiting[kind] = self._waiting.get(kind), call
        if before:
            before.give_up("something newer was asked for")
        self._start_next()
        return call.future

    def cancel(self, *kinds: CallKind) -> None:
        """End the calls of some kinds that are running, soon."""
        self._flag.cancel(*kinds)

    def close(self) -> None:
        """Give up the calls that wait, and stop the process."""
        with self._lock:
            waiting, self._waiting = tuple(self._waiting.values()), {}
        for call in waiting:
            call.give_up("the studio is being closed")
        self._workers.close()
        self._flag.close()

    def _start_next(self) -> None:
        call = self._take_next()
        if call is None:
            return
        try:
            work = self._workers.start(call.function, *call.args)
        except (MeshForgeError, RuntimeError) as error:
            self._finish(call, error)
            return
        work.add_done_callback(lambda done: self._finish(call, _outcome_of(done)))

    def _take_next(self) -> _Call | None:
        """The call to start now, None where one is running, or none waits."""
        with self._lock:
            for kind in [kind for kind in CALL_KINDS if kind in self._waiting and not self._busy]:
                call = self._waiting.pop(kind)
                self._busy = call.future.set_running_or_notify_cancel()
                if self._busy:
                    return call
        return None

    def _finish(self, call: _Call, outcome: Any) -> None:
        with self._lock:
            self._busy = False
        match outcome:
            case None | StoppedError():
                call.future.set_exception(Superseded("it was interrupted"))
            case MeshForgeError():
                call.future.set_exception(outcome)
            case Exception():
                call.future.set_exception(MeshForgeError(describe_error(outcome)))
            case _:
                call.future.set_result(outcome)
        self._start_next()


def _outcome_of(done: Future[Any]) -> Any:
    try:
        return wait_for(done)
    except Exception as error:  # whoever waits for the answer gets it, whatever it is
        return error


@dataclass(frozen=True, slots=True)
class CancelToken:
    """What a call takes with it: its kind, and how often that kind had been cancelled when the call was made."""

    path: Path
    kind: CallKind
    count: int

    @property
    def stop(self) -> Callable[[], bool]:
        """Tells whether the call was cancelled since."""
        counts, place = _map_file(self.path), CALL_KINDS.index(self.kind) * _COUNT.size
        return lambda: int(_COUNT.unpack_from(counts, place)[0]) != self.count


class CancelFlag:
    """Counts, in a small file that processes share, how often the calls of each kind were cancelled."""

    def __init__(self) -> None:
        handle, name = tempfile.mkstemp(prefix="meshforge-", suffix=".bell")
        os.write(handle, bytes(_COUNT.size * len(CALL_KINDS)))
        self.path = Path(name)
        self._counts = mmap.mmap(handle, 0)
        os.close(handle)

    def cancel(self, *kinds: CallKind) -> None:
        """Cancel the calls of some kinds that are running."""
        for kind in kinds:
            _COUNT.pack_into(self._counts, self._offset_of(kind), self._count_of(kind) + 1)

    def make_token(self, kind: CallKind) -> CancelToken:
        """Return the token of a call that is made now."""
        return CancelToken(self.path, kind, self._count_of(kind))

    def close(self) -> None:
        """Remove the file."""
        self._counts.close()
        self.path.unlink(missing_ok=True)

    def _count_of(self, kind: CallKind) -> int:
        return int(_COUNT.unpack_from(self._counts, self._offset_of(kind))[0])

    def _offset_of(self, kind: CallKind) -> int:
        return CALL_KINDS.index(kind) * _COUNT.size


@cache
def _map_file(path: Path) -> mmap.mmap:
    with path.open("rb") as file:
        return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
