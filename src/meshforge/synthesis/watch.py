"""A budget of time that a search asks as it goes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

Clock = Callable[[], float]
"""Seconds from any fixed moment."""


class OutOfTime(Exception):  # noqa: N818 (not an error: the search's way out)
    """The budget is spent, or a person does not want to wait; caught by the learner."""


class Watch:
    """Counts down from the moment it is made; stop: says whether to stop before."""

    __slots__ = ("_clock", "_end", "_start", "_stop")

    def __init__(self, budget: float, clock: Clock = time.monotonic, stop: Callable[[], bool] | None = None) -> None:
        self._clock, self._stop = clock, stop
        self._start = clock()
        self._end = self._start + budget

    def check(self) -> None:
        """Raise OutOfTime when the budget is spent."""
        if self._clock() >= self._end or (self._stop and self._stop()):
            raise OutOfTime

    @contextmanager
    def pause(self) -> Iterator[None]:
        """While a person thinks, no time passes."""
        began = self._clock()
        try:
            yield
        finally:
            away = self._clock() - began
            self._start, self._end = self._start + away, self._end + away

    @property
    def elapsed(self) -> float:
        """Time since the start [s]."""
        return self._clock() - self._start
