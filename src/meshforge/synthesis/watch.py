"""A budget of time that a search asks as it goes."""

from __future__ import annotations

import time
from collections.abc import Callable

Clock = Callable[[], float]
"""Seconds from any fixed moment."""


class OutOfTime(Exception):  # noqa: N818 (not an error: the search's way out)
    """The budget is spent; caught by the learner."""


class Watch:
    """Counts down from the moment it is made."""

    __slots__ = ("_clock", "_end", "_start")

    def __init__(self, budget: float, clock: Clock = time.monotonic) -> None:
        self._clock = clock
        self._start = clock()
        self._end = self._start + budget

    def check(self) -> None:
        """Raise OutOfTime when the budget is spent."""
        if self._clock() >= self._end:
            raise OutOfTime

    @property
    def elapsed(self) -> float:
        """Time since the start [s]."""
        return self._clock() - self._start
