"""What the contestants took on one problem, and how many times as long as we: known from below where one was stopped.

A median stays right as a lower bound when a stopped contestant counts as having taken as long as it was let. A
geometric mean does not tell: it takes only the problems that were finished, and says how many it leaves out.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import exp, log
from statistics import mean, median, median_high

from benchmark.report import Cell, format_cell


@dataclass(frozen=True, slots=True)
class Quantity:
    """A time or a ratio of times; stopped: the contestant was, so the true value is larger."""

    value: float
    stopped: bool = False

    def cell(self, scale: float = 1.0) -> Cell:
        """As a cell of a table, times a scale."""
        value = scale * self.value
        return f"at least {format_cell(value)}" if self.stopped else value


@dataclass(frozen=True, slots=True)
class Row:
    """One problem: its kind, what each contestant took [s], and the size of what it found, None where it was stopped.

    alarms: wrong labels that label repair saw where all were right.
    """

    group: str
    seconds: Mapping[str, float]
    sizes: Mapping[str, int | None]
    alarms: int = 0

    def time(self, name: str) -> Quantity:
        """What a contestant took [s]."""
        return Quantity(self.seconds[name], self.sizes[name] is None)

    def ratio(self, them: str, us: str) -> Quantity:
        """How many times as long as we another contestant took. We have to have finished."""
        assert self.sizes[us] is not None, "a ratio to a stopped one would be no lower bound"
        return Quantity(self.seconds[them] / self.seconds[us], self.sizes[them] is None)


def median_of(quantities: Iterable[Quantity]) -> Quantity:
    """The median; a lower bound of the true one where a stopped contestant is at or below it."""
    every = list(quantities)
    values = [one.value for one in every]
    high = median_high(values)
    return Quantity(median(values), any(one.stopped and one.value <= high for one in every))


def most_of(quantities: Iterable[Quantity]) -> Quantity:
    """The largest; a lower bound where any contestant was stopped."""
    every = list(quantities)
    return Quantity(max(one.value for one in every), any(one.stopped for one in every))


def geometric_mean(quantities: Sequence[Quantity]) -> float | None:
    """The geometric mean of those whose contestants finished; None where none has."""
    values = [one.value for one in quantities if not one.stopped]
    return exp(mean(map(log, values))) if values else None
