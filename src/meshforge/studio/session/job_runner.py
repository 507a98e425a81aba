"""Jobs of a session: each runs in its own thread, one at a time of each kind, and all pages see its progress."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import count
from threading import Event, Lock, RLock, Thread
from time import monotonic

from meshforge.common import StoppedError, UsageError, describe_error
from meshforge.store import NotHereError
from meshforge.studio.wire.jobs import Job, JobKind, JobLine

STOP_MESSAGE = "what was done by then stays."

SEND_INTERVAL = 0.15
"""Seconds between two messages about a job."""
MOST_LINES = 200


class JobProgress:
    """What the work of a job reports to. show: shows a job to all pages."""

    def __init__(self, job: Job, show: Callable[[Job], None]) -> None:
        self._job, self._show = job, show
        self._lock, self._stopped = RLock(), Event()
        self._lines: list[JobLine] = []
        self._last_sent, self._begun = 0.0, monotonic()
        self._send(at_once=True)

    @property
    def job(self) -> Job:
        """The job as it stands; of many lines those that failed first, then those of assets that were prepared."""
        with self._lock:
            lines = sorted(self._lines, key=lambda line: (line.status != "failed", not line.before))[:MOST_LINES]
            return self._job.model_copy(update={"lines": tuple(lines)})

    def is_stopped(self) -> bool:
        """Return whether the job is to stop."""
        return self._stopped.is_set()

    def raise_if_stopped(self) -> None:
        """Raise StoppedError where the job is to stop."""
        if self.is_stopped():
            raise StoppedError("the job was cancelled")

    def stop(self) -> None:
        """Have the job stop as soon as it can."""
        self._stopped.set()

    def advance(self, done: int | None = None) -> None:
        """Count one more thing as done, or set how many are."""
        with self._lock:
            now = min(self._job.done + 1 if done is None else done, self._job.total)
            left = (monotonic() - self._begun) * (self._job.total - now) / now if now else None
            self._job = self._job.model_copy(update={"done": now, "left": left})
            self._send()

    @contextmanager
    def stage(self, total: int, what: str) -> Iterator[Callable[[], None]]:
        """Begin one of several parts, with so many things to do: gives a function that counts one more of them. what:
        says so; where there is nothing to do, what was done last stays."""
        with self._lock:
            if total:
                self._job = self._job.model_copy(update={"done": 0, "total": total, "doing": what, "left": None})
                self._begun = monotonic()
            self._send()
        yield self.advance

    def add_line(self, line: JobLine) -> None:
        """Add what became of one asset."""
        with self._lock:
            self._lines.append(line)
            self._send()

    def end(self, state: str, message: str, out: str | None = None) -> None:
        """End the job."""
        with self._lock:
            self._job = self._job.model_copy(update={"state": state, "message": message, "out": out, "left": None})
            self._send(at_once=True)

    def _send(self, at_once: bool = False) -> None:
        if at_once or monotonic() - self._last_sent >= SEND_INTERVAL:
            self._last_sent = monotonic()
            self._show(self.job)


JobWork = Callable[[JobProgress], str]
"""Does the work of a job, and returns its result in a sentence. Raises StoppedError where it was stopped."""


class JobRunner:
    """Starts and stops jobs. show: shows a job to all pages."""

    def __init__(self, show: Callable[[Job], None]) -> None:
        self._show = show
        self._lock, self._numbers = Lock(), count(1)
        self._running: dict[str, tuple[JobProgress, Thread]] = {}

    def start(
        self, kind: JobKind, title: str, total: int, work: JobWork, out: str | None = None, stays: str = STOP_MESSAGE
    ) -> Job:
        """Start a job; out: the folder that it writes; stays: ends the message of a job that was cancelled.

        Raises UsageError where one of its kind is running.
        """
        with self._lock:
            if any(progress.job.kind == kind for progress, _ in self._running.values()):
                raise UsageError("this is being done already", remedy="Wait until it is over, or cancel it.")
            job = Job(id=f"{kind}-{next(self._numbers)}", kind=kind, title=title, total=total)
            progress = JobProgress(job, self._show)
            thread = Thread(target=self._run, args=(progress, work, out, stays), name=job.id, daemon=True)
            self._running[job.id] = progress, thread
        thread.start()
        return progress.job

    def cancel(self, job: str) -> Job:
        """Have a job stop. Raises NotHereError where it is over, or never was."""
        with self._lock:
            if job not in self._running:
                raise NotHereError(f"there is no job {job!r} under way", remedy="It is over.")
            progress, _ = self._running[job]
        progress.stop()
        return progress.job

    def close(self) -> None:
        """Stop all jobs, and wait for their end."""
        with self._lock:
            rows = list(self._running.values())
        for progress, _ in rows:
            progress.stop()
        for _, thread in rows:
            thread.join()

    def _run(self, progress: JobProgress, work: JobWork, out: str | None, stays: str) -> None:
        try:
            state, message = "done", work(progress)
        except StoppedError:
            state, message = "cancelled", f"Cancelled: {stays}"
        except Exception as error:  # whatever went wrong is the outcome of the job
            state, message, out = "failed", describe_error(error), None
        with self._lock:  # before pages see the end: they may ask for the next job at once
            del self._running[progress.job.id]
        progress.end(state, message, out)
