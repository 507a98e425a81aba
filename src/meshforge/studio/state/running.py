"""A job under way: its progress, told to the pages a few times a second at most."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Event, RLock
from time import monotonic

from meshforge.errors import StoppedError
from meshforge.studio.wire.jobs import Job, JobLine

OFTEN = 0.15
"""Seconds between two messages about a job."""
LINES = 200


class Running:
    """What the work of a job calls. tell: shows a job to all pages."""

    def __init__(self, job: Job, tell: Callable[[Job], None]) -> None:
        self._job, self._tell = job, tell
        self._lock, self._stopped = RLock(), Event()
        self._lines: list[JobLine] = []
        self._told = 0.0
        self._show(at_once=True)

    @property
    def job(self) -> Job:
        """The job as it stands."""
        with self._lock:
            return self._job.model_copy(update={"lines": _most_important(self._lines)})

    @property
    def is_stopped(self) -> bool:
        """Whether it is to stop."""
        return self._stopped.is_set()

    def raise_if_stopped(self) -> None:
        """Raises StoppedError where it is to stop."""
        if self.is_stopped:
            raise StoppedError("the job was cancelled")

    def stop(self) -> None:
        """Have it stop as soon as it can."""
        self._stopped.set()

    def advance(self, done: int | None = None) -> None:
        """One thing more is done, or so many."""
        with self._lock:
            now = self._job.done + 1 if done is None else done
            self._job = self._job.model_copy(update={"done": min(now, self._job.total)})
            self._show()

    @contextmanager
    def stage(self, total: int, what: str) -> Iterator[Callable[[], None]]:
        """For one part of several, which is about so many things: gives what counts one more of them."""
        with self._lock:
            self._job = self._job.model_copy(update={"done": 0, "total": total} if total else {})
            self._show()
        yield self.advance

    def add_line(self, line: JobLine) -> None:
        """What became of one asset."""
        with self._lock:
            self._lines.append(line)
            self._show()

    def end(self, state: str, message: str, out: str | None = None) -> None:
        """It is over."""
        with self._lock:
            self._job = self._job.model_copy(update={"state": state, "message": message, "out": out})
            self._show(at_once=True)

    def _show(self, at_once: bool = False) -> None:
        if at_once or monotonic() - self._told >= OFTEN:
            self._told = monotonic()
            self._tell(self.job)


def _most_important(lines: list[JobLine]) -> tuple[JobLine, ...]:
    """Of many lines those that failed first."""
    return tuple(sorted(lines, key=lambda line: line.status != "failed")[:LINES])
