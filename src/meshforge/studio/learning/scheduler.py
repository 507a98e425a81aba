"""Learning after every change: a new run, in a process of its own, takes the place of the one before."""

from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from functools import partial
from pathlib import Path
from threading import RLock, Timer

from meshforge.common import MeshForgeError, describe_error
from meshforge.studio.learning import process
from meshforge.studio.learning.queue import LearningProcess, Superseded
from meshforge.studio.pages import PageState
from meshforge.studio.wire.events import AssessmentChanged, OutcomeChanged, ReachChanged
from meshforge.studio.wire.family import AssessmentView
from meshforge.studio.wire.program import CoverageView, OutcomeView, Reach

RESTART_DELAY = 0.03
"""Seconds that a change waits for the next one before a learning run starts."""
STOP_TIMEOUT = 30.0
"""Seconds to wait for a learning run that is to stop."""


class LearningScheduler:
    """Starts learning runs, takes their outcomes and has the edits judged; of several runs only the last one counts.

    can_learn: whether anything is demonstrated; on_outcome: called when a run is over, before pages see that and its
    reach is measured, so that a page that sees the end of the run sees its program, too; refresh: called once pages see
    how sure the edits are, and where a run was stopped.
    """

    def __init__(
        self,
        folder: Path,
        pages: PageState,
        can_learn: Callable[[], bool],
        on_outcome: Callable[[OutcomeView], None],
        refresh: Callable[[], None],
    ) -> None:
        self._process, self._pages = LearningProcess(folder), pages
        self._can_learn, self._on_outcome, self._refresh = can_learn, on_outcome, refresh
        self._lock = RLock()
        self._number, self._paused = 0, False
        self._timer: Timer | None = None
        self._running: Future[OutcomeView] | None = None

    def restart(self) -> None:
        """Start a learning run, in place of the one that is under way."""
        learns = self._can_learn()
        number = self._stop(assessing=learns)
        if not learns:
            self._pages.show(OutcomeChanged(outcome=None, learning=False))
            self.measure_reach()
            self.assess()
            return
        self._pages.show(OutcomeChanged(outcome=self._pages.shown.outcome, learning=True))
        with self._lock:
            if number == self._number:
                self._timer = Timer(RESTART_DELAY, self._begin, [number])
                self._timer.daemon = True
                self._timer.start()

    def stop(self) -> None:
        """Stop the learning run that is under way; the outcome of the one before stays shown."""
        self._stop()
        self._pages.show(OutcomeChanged(outcome=self._pages.shown.outcome, learning=False))
        self._refresh()

    def pause(self) -> None:
        """Stop the learning run that is under way, and wait until it no longer writes anything."""
        self._stop(assessing=True)  # as soon as it is resumed
        self._paused = True
        running = self._running
        if running:
            try:
                running.result(STOP_TIMEOUT)
            except (Exception, CancelledError):  # it is over, which is all that matters here
                return

    def resume(self) -> None:
        """Start the learning run again that a pause has stopped."""
        if self._paused:
            self._paused = False
            self.restart()

    def is_latest(self, number: int) -> bool:
        """Return whether a learning run is the last one that was started."""
        return number == self._number

    def measure_reach(self) -> None:
        """Measure what the accepted program does on all assets."""
        text = self._pages.shown.program.text
        if not text or self._pages.shown.program.error:
            self._pages.show(ReachChanged(reach=()))
            return
        reach = self._process.call("reach", process.compute_reach, text)
        reach.add_done_callback(partial(self._show_reach, self._number))

    def assess(self) -> None:
        """Judge anew how sure the edits are under the program as it is after the last learning run, and what to ask."""
        outcome, number = self._pages.shown.outcome, self._number
        is_there = outcome is not None and outcome.number == number and outcome.status not in ("timeout", "error")
        if not (is_there and self._can_learn()):
            self._show_assessment(number, None)
            return
        with self._lock:
            if number == self._number:
                self._pages.show(AssessmentChanged(assessment=self._pages.shown.assessment, assessing=True))
        assessment = self._process.call("assess", process.assess, number)
        assessment.add_done_callback(partial(self._take_assessment, number))

    def generalise(self, extractor: str, rule: int) -> Future[CoverageView]:
        """Return what an extractor selects on all assets."""
        text = self._pages.shown.program.text or None
        return self._process.call("generalise", process.generalise, extractor, rule, text)

    def close(self) -> None:
        """Stop for good."""
        self._stop()
        self._process.close()

    def _stop(self, assessing: bool = False) -> int:
        """Stop what is under way. assessing: edits will be judged anew, so that no page sees an end in between."""
        with self._lock:
            self._number += 1
            if self._timer:
                self._timer.cancel()
            number = self._number
        self._process.cancel("learn", "reach", "assess")
        self._pages.show(AssessmentChanged(assessment=None, assessing=assessing))
        return number

    def _begin(self, number: int) -> None:
        with self._lock:
            if number != self._number:
                return
            try:
                self._running = self._process.call("learn", process.learn, number)
            except MeshForgeError:  # the studio is being closed
                return
        self._running.add_done_callback(partial(self._finish, number))

    def _finish(self, number: int, future: Future[OutcomeView]) -> None:
        try:
            outcome = future.result()
        except CancelledError:
            return
        except Exception as error:  # whatever it is, the page must see that learning is over
            outcome = OutcomeView(number=number, status="error", error=describe_error(error))
        if number != self._number:
            return
        try:
            self._on_outcome(outcome)
        finally:
            with self._lock:  # so that no other run starts meanwhile
                if number == self._number:
                    self._pages.show(OutcomeChanged(outcome=outcome, learning=False))
        self.measure_reach()
        self.assess()

    def _take_assessment(self, number: int, future: Future[AssessmentView]) -> None:
        try:
            found = future.result()
        except Superseded:
            return
        except (MeshForgeError, CancelledError):  # nothing is known, and the page says so
            found = None
        self._show_assessment(number, found)

    def _show_assessment(self, number: int, found: AssessmentView | None) -> None:
        with self._lock:  # so that no change makes it old meanwhile
            if number != self._number:
                return
            self._pages.show(AssessmentChanged(assessment=found, assessing=False))
        self._refresh()

    def _show_reach(self, number: int, future: Future[tuple[Reach, ...]]) -> None:
        try:
            reach = future.result()
        except (MeshForgeError, CancelledError):  # superseded, or its process died: the next one is measured again
            return
        if number == self._number:
            self._pages.show(ReachChanged(reach=reach))
