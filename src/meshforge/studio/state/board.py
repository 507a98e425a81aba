"""All jobs of a studio; of each kind one at a time."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from threading import Lock, Thread

from meshforge.errors import StoppedError, UsageError, told
from meshforge.studio.errors import NotHereError
from meshforge.studio.state.running import Running
from meshforge.studio.wire.jobs import Job, JobKind

Work = Callable[[Running], str]
"""Does the work of a job, and gives its result in a sentence. Raises StoppedError where it was stopped."""
STAYS = "what was done by then stays."


class Jobs:
    """Begins and stops jobs. tell: shows a job to all pages."""

    def __init__(self, tell: Callable[[Job], None]) -> None:
        self._tell = tell
        self._lock, self._numbers = Lock(), count(1)
        self._running: dict[str, tuple[Running, Thread]] = {}

    def start(
        self, kind: JobKind, title: str, total: int, work: Work, out: str | None = None, stays: str = STAYS
    ) -> Job:
        """Begin a job; out: the folder that it writes; stays: what is said where it was stopped.

        Raises UsageError where one of its kind is under way.
        """
        with self._lock:
            if any(running.job.kind == kind for running, _ in self._running.values()):
                raise UsageError("this is being done already", remedy="Wait until it is over, or cancel it.")
            running = Running(Job(id=f"{kind}-{next(self._numbers)}", kind=kind, title=title, total=total), self._tell)
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

    def _run(self, running: Running, work: Work, out: str | None, stays: str) -> None:
        end = _ended(running, work, out, stays)
        with self._lock:  # before pages are told, which may ask for the next one at once
            del self._running[running.job.id]
        running.end(*end)


def _ended(running: Running, work: Work, out: str | None, stays: str) -> tuple[str, str, str | None]:
    """How a job ended, what is said of that, and the folder that it wrote."""
    try:
        return "done", work(running), out
    except StoppedError:
        return "cancelled", f"Cancelled: {stays}", out
    except Exception as error:  # what a job does wrong is told as its outcome
        return "failed", told(error), None
