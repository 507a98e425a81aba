"""All sessions of simulated demonstrators, task by task and condition by condition."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from benchmark.assets import SEPARATE
from benchmark.journal import run_units
from benchmark.report import Tell
from benchmark.study import CONDITIONS, REPORTED, TUNING, Condition, Session, open_bench, teach_task
from benchmark.tasks import tasks

QUICK = "cup"
"""The category of a quick run, which has one seed."""


def sessions(conditions: Sequence[Condition], tell: Tell, quick: bool, tuning: bool = False) -> list[Session]:
    """The sessions of all tasks under some conditions, by the reported demonstrators.

    tuning: on the calibration set, by the demonstrators that anything may be tuned on.
    """
    seeds = TUNING if tuning else REPORTED
    names = [one.name for one in tasks() if not quick or one.category == QUICK]
    chosen = seeds[:1] if quick else seeds
    units = [(name, one.name, one.seeds(chosen), tuning) for name in names for one in conditions]
    rows = run_units("sessions", teach, units, tell)
    return [Session.of_json(row) for unit in rows for row in unit]


def teach(name: str, condition: str, seeds: Iterable[int], calibration: bool = False) -> list[dict[str, Any]]:
    """One task under one condition, by each demonstrator."""
    return [_teach(name, CONDITIONS[condition], seed, calibration).to_json() for seed in seeds]


def _teach(name: str, condition: Condition, seed: int, calibration: bool) -> Session:
    """One session, judged on the other decompositions as well where there are any like it."""
    setting = condition.setting(seed)
    others = [one for one in SEPARATE if one != setting] if setting in SEPARATE else []
    benches = [open_bench(name, one, calibration) for one in (setting, *others)]
    return teach_task(benches[0], condition, seed, benches[1:])
