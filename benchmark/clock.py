"""Fair times: contestants take turns in one warm process, and medians are compared, so that slow moments hit all."""

from __future__ import annotations

import gc
import statistics
import time
from collections.abc import Callable, Mapping, Sequence

Run = Callable[[], Callable[[], object]]
"""Prepares a run, which is not timed, and gives what is."""


def in_turns(
    contestants: Mapping[str, Run],
    rounds: int,
    enough: float = float("inf"),
    repeats: int = 1,
    slow: float = float("inf"),
) -> dict[str, list[float]]:
    """Seconds of each contestant in each round, after one round that does not count.

    enough: seconds after which no further round begins; repeats: runs in a row in a turn, of which the quickest counts,
    for work so short that it is mostly the cache of the processor that a single run measures. slow: seconds of a turn,
    preparation included; who takes longer in the first round has this one only, and it counts.
    """
    times: dict[str, list[float]] = {name: [] for name in contestants}
    began, single = time.perf_counter(), set[str]()
    for turn in range(rounds + 1):
        if turn > 1 and time.perf_counter() - began > enough:
            break
        for name, prepare in contestants.items():
            if name in single:
                continue
            start = time.perf_counter()
            seconds = min(once(prepare()) for _ in range(repeats))
            if not turn and time.perf_counter() - start > slow:
                single.add(name)
            if turn or name in single:
                times[name].append(seconds)
    return times


def once(run: Callable[[], object]) -> float:
    """Seconds of one run, without the garbage collector."""
    gc.disable()
    try:
        start = time.perf_counter()
        run()
        return time.perf_counter() - start
    finally:
        gc.enable()


def medians(times: Mapping[str, Sequence[float]]) -> dict[str, float]:
    """The median seconds of each contestant."""
    return {name: statistics.median(seconds) for name, seconds in times.items()}
