"""Waiting between attempts: doubled each time, as long as the server says, and cut short by a stop."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from meshforge.perception.vlm.faults import EndError

LONGEST = 60.0
"""The longest wait [s] of our own accord."""
BEARABLE = 300.0
"""The longest wait [s] that a server may want; one that wants more is asked another day."""
_GLANCE = 0.05  # seconds between looks at whether to stop


class Patience:
    """When the server may be asked again; safe to use from several threads.

    What it says to one question holds for all, since it counts them together.
    """

    def __init__(self, first: float, stop: Callable[[], bool]) -> None:
        self._first, self._stop = first, stop
        self._lock = threading.Lock()
        self._closed_until = 0.0

    def back_off(self, attempt: int, after: float | None, spread: float) -> None:
        """Wait after failed attempt number `attempt`, counted from 0; after [s]: what the server wants.

        spread in 0..1 keeps questions apart that failed at one time. Raises EndError: that is too long, or a stop.
        """
        if after is not None and after > BEARABLE:
            raise EndError(
                f"the server wants to be left alone for {after / 60:.0f} minutes",
                remedy="Go on then; what was answered is not asked again.",
            )
        if after:
            with self._lock:
                self._closed_until = max(self._closed_until, time.monotonic() + after)
        self._wait_until(time.monotonic() + min(self._first * 2**attempt, LONGEST) * (0.75 + spread / 2))

    def wait(self) -> None:
        """Wait as long as the server wants no question. Raises EndError for a stop."""
        while True:
            with self._lock:
                until = self._closed_until
            self._wait_until(until)
            with self._lock:
                if self._closed_until <= until:
                    return

    def _wait_until(self, moment: float) -> None:
        while (left := moment - time.monotonic()) > 0:
            self.raise_if_stopped()
            time.sleep(min(left, _GLANCE))
        self.raise_if_stopped()

    def raise_if_stopped(self) -> None:
        """Raises EndError where a stop is wanted."""
        if self._stop():
            raise EndError("stopped", remedy="What was answered is kept, and is not asked again.")
