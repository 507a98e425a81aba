"""Jobs of a session: each in a thread of its own, of each kind one at a time, its progress sent to all pages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import count
from threading import Event, Lock, RLock, Thread
from time import monotonic

from meshforge.common import StoppedError, UsageError, describe_error
from meshforge.studio.errors import NotHereError
from meshforge.studio.wire.jobs import Job, JobKind, JobLine

STOP_MESSAGE = "what was done by then stays."

SEND_INTERVAL = 0.15
"""Seconds between two messages about a job."""
MOST_LINES = 200


class JobProgress:
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
            return self._job.model_copy(update={"lines": _sort_lines(self._lines)})

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
        if at_once or monotonic() - self._told >= SEND_INTERVAL:
            self._told = monotonic()
            self._tell(self.job)


JobWork = Callable[[JobProgress], str]
"""Does the work of a job, and gives its result in a sentence. Raises StoppedError where it was stopped."""


class JobRunner:
    """Begins and stops jobs. tell: shows a job to all pages."""

    def __init__(self, tell: Callable[[Job], None]) -> None:
        self._tell = tell
        self._lock, self._numbers = Lock(), count(1)
        self._running: dict[str, tuple[JobProgress, Thread]] = {}

    def start(
        self, kind: JobKind, title: str, total: int, work: JobWork, out: str | None = None, stays: str = STOP_MESSAGE
    ) -> Job:
        """Begin a job; out: the folder that it writes; stays: what is said where it was stopped.

        Raises UsageError where one of its kind is under way.
        """
        with self._lock:
            if any(running.job.kind == kind for running, _ in self._running.values()):
                raise UsageError("this is being done already", remedy="Wait until it is over, or cancel it.")
            running = JobProgress(
                Job(id=f"{kind}-{next(self._numbers)}", kind=kind, title=title, total=total), self._tell
            )
            thread = Thread(target=self._run, args=(running, work, out, stays), name=running.job.id, daemon=True)
            self._running[running.job.id] = running, thread
        thread.start()
        return running.job

    def cancel(self, job: str) -> Job:
        """Have a job stop. Raises NotHereError where it is over, or never was."""
        with self._lock:
            if job not in self._running:
                raise NotHereError(f"there is no job {job!r} under way", remedy="It is over.")
            running, _ = self._running[job]
        running.stop()
        return running.job

    def close(self) -> None:
        """Stop all jobs, and wait for their end."""
        with self._lock:
            rows = list(self._running.values())
        for running, _ in rows:
            running.stop()
        for _, thread in rows:
            thread.join()

    def _run(self, running: JobProgress, work: JobWork, out: str | None, stays: str) -> None:
        end = _run_to_end(running, work, out, stays)
        with self._lock:  # before pages are told, which may ask for the next one at once
            del self._running[running.job.id]
        running.end(*end)


def _run_to_end(running: JobProgress, work: JobWork, out: str | None, stays: str) -> tuple[str, str, str | None]:
    """How a job ended, what is said of that, and the folder that it wrote."""
    try:
        return "done", work(running), out
    except StoppedError:
        return "cancelled", f"Cancelled: {stays}", out
    except Exception as error:  # what a job does wrong is told as its outcome
        return "failed", describe_error(error), None


def _sort_lines(lines: list[JobLine]) -> tuple[JobLine, ...]:
    """Of many lines those that failed first."""
    return tuple(sorted(lines, key=lambda line: line.status != "failed")[:MOST_LINES])
