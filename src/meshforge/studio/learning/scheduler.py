"""Learning after every change: a new run takes the place of the one before, in a process of its own."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from functools import partial
from pathlib import Path
from threading import RLock, Timer
from typing import TypeVar

from meshforge.common import MeshForgeError, describe_error
from meshforge.studio.learning import process
from meshforge.studio.learning.queue import CancelFlag, LatestOnlyQueue
from meshforge.studio.pages import PageState
from meshforge.studio.wire.program import Generalised, LessonView, Reach
from meshforge.studio.workers import Workers

RESTART_DELAY = 0.03
"""Seconds that a change waits for the next one before a lesson begins."""
STOP_TIMEOUT = 30.0
"""Seconds to wait for a lesson that was told to stop."""

Result = TypeVar("Result")


class LearningScheduler:
    """Begins lessons and takes their outcomes; of several begun, only the last one counts.

    taught: whether anything is demonstrated; learned: called when a lesson is over, before pages are told so and its
    reach is measured, so that who sees that it is over sees its program, too.
    """

    def __init__(
        self, learner: Learner, shown: PageState, taught: Callable[[], bool], learned: Callable[[LessonView], None]
    ) -> None:
        self._learner, self._shown = learner, shown
        self._can_learn, self._on_outcome = taught, learned
        self._lock = RLock()
        self._number, self._paused = 0, False
        self._timer: Timer | None = None
        self._running: Future[LessonView] | None = None

    def restart(self) -> None:
        """Begin a lesson, in the place of one that is under way."""
        number = self._stop()
        if not self._can_learn():
            self._shown.set_lesson(None, learning=False)
            self.measure_reach()
            return
        self._shown.set_lesson(self._shown.lesson, learning=True)
        with self._lock:
            if number == self._number:
                self._timer = Timer(RESTART_DELAY, self._begin, [number])
                self._timer.daemon = True
                self._timer.start()

    def stop(self) -> None:
        """Stop the lesson that is under way; the one before stays shown."""
        self._stop()
        self._shown.set_lesson(self._shown.lesson, learning=False)

    def pause(self) -> None:
        """Stop the lesson that is under way, and wait until it no longer writes anything."""
        self._stop()
        self._paused = True
        running = self._running
        if running:
            try:
                running.result(STOP_TIMEOUT)
            except (Exception, CancelledError):  # it is over, which is all that matters here
                return

    def resume(self) -> None:
        """Begin the lesson anew that a pause has stopped."""
        if self._paused:
            self._paused = False
            self.restart()

    def is_latest(self, number: int) -> bool:
        """Whether a lesson is the last one that was begun."""
        return number == self._number

    def measure_reach(self) -> None:
        """Measure what the accepted program does on all assets."""
        text = self._shown.program.text
        if not text or self._shown.program.error:
            self._shown.set_reach(self._number, ())
            return
        number = self._number
        self._when_done(self._learner.reach(number, text), lambda reach: self._show_reach(number, reach))

    def generalise(self, extractor: str, rule: int) -> Future[Generalised]:
        """What an extractor selects on all assets."""
        return self._learner.generalise(extractor, rule, self._shown.program.text or None)

    def close(self) -> None:
        """Stop for good."""
        self._stop()
        self._learner.close()

    def _stop(self) -> int:
        with self._lock:
            self._number += 1
            if self._timer:
                self._timer.cancel()
            number = self._number
        self._learner.interrupt()
        return number

    def _begin(self, number: int) -> None:
        with self._lock:
            if number != self._number:
                return
            try:
                self._running = self._learner.learn(number, False)
            except MeshForgeError:  # the studio is being closed
                return
        self._running.add_done_callback(partial(self._finish, number))

    def _finish(self, number: int, future: Future[LessonView]) -> None:
        try:
            lesson = future.result()
        except CancelledError:
            return
        except Exception as error:  # whatever it is, the page is told that the lesson is over
            lesson = LessonView(number=number, status="error", error=describe_error(error))
        if number != self._number:
            return
        try:
            self._on_outcome(lesson)
        finally:
            self._show(number, lesson)
        self.measure_reach()

    def _show(self, number: int, lesson: LessonView) -> None:
        with self._lock:  # so that no other lesson begins meanwhile
            if number == self._number:
                self._shown.set_lesson(lesson, learning=False)

    def _show_reach(self, number: int, reach: tuple[Reach, ...]) -> None:
        if number == self._number:
            self._shown.set_reach(number, reach)

    def _when_done(self, future: Future[Result], then: Callable[[Result], None]) -> None:
        def arrived(done: Future[Result]) -> None:
            try:
                result = done.result()
            except (MeshForgeError, CancelledError):  # superseded, or its process died: the next one is measured anew
                return
            then(result)

        future.add_done_callback(arrived)


class Learner:
    """Learns a project's program in a process of its own, which starts with the first call.

    One thing is done at a time, lessons first. What is asked for ends what was asked for before of its kind, a lesson
    the reach of the one before, too; of what has not begun then, and of a reach that is ended, the result is
    Superseded. Where the process dies, the result is a MeshForgeError, and the next call has a new one.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._workers = Workers(1)
        self._line = LatestOnlyQueue(self._workers)
        self._bell = CancelFlag()

    def learn(self, number: int, take: bool) -> Future[LessonView]:
        """Learn now. take: what is found becomes the project's program even if a person wrote the present one.

        A lesson that is interrupted has the status `timeout`; what goes wrong is told in its error.
        """
        self.interrupt()
        return self._line.put("lesson", process.learn, self._folder, self._bell.make_token("lesson"), number, take)

    def reach(self, number: int, program: str) -> Future[tuple[Reach, ...]]:
        """What a program does on every asset that `work.reach` looks at; number: of the lesson that it comes from.

        Raises ProgramError for a text that is no program, or a template that is not there.
        """
        self._bell.cancel("reach")
        return self._line.put("reach", process.compute_reach, self._folder, self._bell.make_token("reach"), program)

    def generalise(self, extractor: str, rule: int, program: str | None) -> Future[Generalised]:
        """What an extractor selects on the same assets as a rule of that number meets them, after those of a program.

        Raises ProgramError for a text that is no extractor.
        """
        self._bell.cancel("generalise")
        ticket = self._bell.make_token("generalise")
        return self._line.put("generalise", process.generalise, self._folder, ticket, extractor, rule, program)

    def interrupt(self) -> None:
        """End the lesson that is learned, and the reach that is worked out, soon."""
        self._bell.cancel("lesson", "reach")

    def close(self) -> None:
        """Stop the process."""
        self._line.close()
        self._workers.close()
        self._bell.close()
