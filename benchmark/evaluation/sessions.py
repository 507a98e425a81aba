"""All sessions of simulated demonstrators, task by task and condition by condition."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Any

from benchmark.journal import run_units
from benchmark.report import Tell
from benchmark.study import CONDITIONS, REPORTED, TUNING, Bench, Condition, Session, teach_task
from benchmark.tasks import task, tasks

QUICK = "cup"
"""The category of a quick run, which has one seed."""


def sessions(conditions: Sequence[Condition], tell: Tell, quick: bool, tuning: bool = False) -> list[Session]:
    """The sessions of all tasks under some conditions, by the reported demonstrators.

    tuning: on the calibration set, by the demonstrators that anything may be tuned on.
    """
    seeds = TUNING if tuning else REPORTED
    names = [one.name for one in tasks() if not quick or one.category == QUICK]
    chosen = list(seeds)[:1] if quick else list(seeds)
    units = [(name, condition.name, chosen, tuning) for name in names for condition in conditions]
    rows = run_units("sessions", teach, units, tell)
    return [Session.of_json(row) for unit in rows for row in unit]


def teach(name: str, condition: str, seeds: Iterable[int], calibration: bool = False) -> list[dict[str, Any]]:
    """One task under one condition, by each demonstrator."""
    bench = _bench(name, calibration)
    return [teach_task(bench, CONDITIONS[condition], seed).to_json() for seed in seeds]


@lru_cache(maxsize=1)
def _bench(name: str, calibration: bool) -> Bench:
    return Bench(task(name), calibration)
