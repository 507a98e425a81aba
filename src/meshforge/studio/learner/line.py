"""Work that waits for one process: one thing at a time, and of each kind only what was asked for last."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from threading import Lock
from typing import Any

from meshforge.errors import MeshForgeError, told
from meshforge.studio.learner.bell import KINDS, Kind
from meshforge.studio.workers import Workers, arrived


class Superseded(MeshForgeError):  # noqa: N818 (nothing went wrong: nobody waits for it)
    """Something newer of the same kind was asked for, or the work was interrupted; its result is of no use."""


@dataclass(frozen=True, eq=False, slots=True)
class _Call:
    function: Callable[..., Any]
    args: tuple[Any, ...]
    future: Future[Any] = field(default_factory=Future)

    def give_up(self, why: str) -> None:
        """Tell whoever still waits for it that it will not be done."""
        if self.future.set_running_or_notify_cancel():
            self.future.set_exception(Superseded(why))


class Line:
    """Calls on their way to a worker process; lessons go first, then the others in the order of `KINDS`."""

    def __init__(self, workers: Workers) -> None:
        self._workers = workers
        self._lock = Lock()
        self._waiting: dict[Kind, _Call] = {}
        self._busy = False

    def put(self, kind: Kind, function: Callable[..., Any], *args: Any) -> Future[Any]:
        """Ask for something, in place of what waits of its kind. What gives None was interrupted: Superseded."""
        call = _Call(function, args)
        with self._lock:
            before, self._waiting[kind] = self._waiting.get(kind), call
        if before:
            before.give_up("something newer was asked for")
        self._start_next()
        return call.future

    def close(self) -> None:
        """Give up what waits."""
        with self._lock:
            waiting, self._waiting = tuple(self._waiting.values()), {}
        for call in waiting:
            call.give_up("the studio is being closed")

    def _start_next(self) -> None:
        call = self._take_next()
        if call is None:
            return
        try:
            work = self._workers.start(call.function, *call.args)
        except (MeshForgeError, RuntimeError) as error:
            self._finish(call, error)
            return
        work.add_done_callback(lambda done: self._finish(call, _outcome(done)))

    def _take_next(self) -> _Call | None:
        """What is begun now, None where something is being done, or nothing waits."""
        with self._lock:
            for kind in [kind for kind in KINDS if kind in self._waiting and not self._busy]:
                call = self._waiting.pop(kind)
                self._busy = call.future.set_running_or_notify_cancel()
                if self._busy:
                    return call
        return None

    def _finish(self, call: _Call, outcome: Any) -> None:
        with self._lock:
            self._busy = False
        match outcome:
            case MeshForgeError():
                call.future.set_exception(outcome)
            case Exception():
                call.future.set_exception(MeshForgeError(told(outcome)))
            case None:
                call.future.set_exception(Superseded("it was interrupted"))
            case _:
                call.future.set_result(outcome)
        self._start_next()


def _outcome(done: Future[Any]) -> Any:
    """What a worker gave, or the error."""
    try:
        return arrived(done)
    except Exception as error:  # whoever waits for the answer gets it, whatever it is
        return error
