"""What sessions come to, condition by condition: means over people, then over tasks."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from statistics import mean, stdev
from typing import Protocol, TypeVar

from benchmark.signoff.before import Before
from benchmark.signoff.opening import FirstLook
from benchmark.signoff.point import Point, right_at
from benchmark.signoff.queue import CAP, Review

TIMES = (0, 15, 30, 45, 60, 80, 100, 125, 150, 200, 250, 300, 400, 500, 600)
"""Seconds at which curves are told."""


class _Row(Protocol):
    @property
    def task(self) -> str: ...

    @property
    def condition(self) -> str: ...


RowT = TypeVar("RowT", bound=_Row)


@dataclass(frozen=True, slots=True)
class Group:
    """The sessions under one condition: by the queue, before any question, and by the tool as it was."""

    condition: str
    reviews: tuple[Review, ...]
    openings: tuple[FirstLook, ...]
    before: tuple[Before, ...]


def group(
    conditions: Iterable[str], reviews: Sequence[Review], openings: Sequence[FirstLook], before: Sequence[Before]
) -> list[Group]:
    """The sessions by condition; of the tool as it was those of the same people."""
    asked = {(row.task, row.condition, row.seed) for row in reviews}
    same = [row for row in before if (row.task, row.condition, row.seed) in asked]
    found = (Group(name, _of(reviews, name), _of(openings, name), _of(same, name)) for name in conditions)
    return [one for one in found if one.reviews]


def _of(rows: Sequence[RowT], condition: str) -> tuple[RowT, ...]:
    return tuple(row for row in rows if row.condition == condition)


def spread_over_tasks(rows: Sequence[RowT], figure: Callable[[RowT], float]) -> tuple[float, float]:
    """Mean and standard deviation over tasks of the mean over people."""
    by_task = defaultdict(list)
    for row in rows:
        by_task[row.task].append(figure(row))
    means = [mean(values) for values in by_task.values()]
    return (mean(means), stdev(means) if len(means) > 1 else 0.0) if means else (0.0, 0.0)


def mean_over_tasks(rows: Sequence[RowT], figure: Callable[[RowT], float]) -> float:
    """The mean over tasks of the mean over people."""
    return spread_over_tasks(rows, figure)[0]


def share(count: int, among: int) -> float:
    """In percent; 100 of nothing."""
    return 100 * count / among if among else 100.0


def right_when_done(row: Review) -> float:
    """Percent of the possible assets that are right and signed off in the end."""
    return share(last(row).sure, row.possible)


def share_signed_off(row: Review) -> float:
    """Percent of all assets that are signed off in the end."""
    return share(last(row).signed_off, row.assets)


def wrong_when_done(row: Review) -> float:
    """Percent of all assets that are signed off in the end, yet not right though they could be."""
    return share(last(row).wrong, row.assets)


def person_time(row: Review) -> float:
    """Seconds of the person, until done or broken off."""
    return last(row).seconds


def time_by_keys(row: Review) -> float:
    """The same at prices by keys and look-alikes."""
    return sum(row.by_keys.values())


def share_sooner(rows: Sequence[Review]) -> float:
    """Percent of the sessions that take less than editing each asset by hand, without the tool, both by keys."""
    return share(sum(time_by_keys(row) < row.all_by_hand for row in rows), len(rows))


def last(row: Review | Before) -> Point:
    """How a session ends."""
    return row.points[-1] if row.points else Point(CAP, 0)


def right_by_queue(seconds: float, row: Review) -> float:
    """Percent of the possible assets that are right after so many seconds."""
    return share(right_at(row.points, seconds), row.possible)


def right_before(seconds: float, row: Before) -> float:
    """The same with the tool as it was."""
    return share(right_at(row.points, seconds), row.possible)


def right_by_hand(seconds: float, row: Before) -> float:
    """The same by the person who then mends by hand, at an even pace."""
    end = last(row)
    if seconds < end.seconds:
        return right_before(seconds, row)
    done = min((seconds - end.seconds) / max(row.brute.seconds - end.seconds, 1e-9), 1.0)
    return share(1, row.possible) * (end.right + done * (row.brute.right - end.right))


def brute_of(group: Group) -> dict[tuple[str, int], Before]:
    """The sessions of the tool as it was, by task and person."""
    return {(row.task, row.seed): row for row in group.before}
