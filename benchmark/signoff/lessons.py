"""What is taught without a queue, on labels as the tool takes them: programs that are right, repairs that are not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from benchmark.evaluation.figures import by_task, count_solved
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.signoff.conditions import list_tasks, open_family
from benchmark.study import CONDITIONS, FLAT, REPORTED, TRUE, Session, teach_task
from benchmark.study.instances import instance, mend

DOZEN = CONDITIONS[f"{FLAT.name}: the tool's dozen"]
"""The person looks at the results that the tool proposes."""
_CONDITIONS = (TRUE, FLAT, DOZEN)
_QUICK = "cup"
_INSTANCES = 10


def measure(tell: Tell, quick: bool) -> Result:
    """Teach all tasks under true and noisy labels, and mend ten near misses."""
    names = [name for name in list_tasks() if not quick or name.startswith(_QUICK)]
    units = [(name, one.name, quick) for name in names for one in _CONDITIONS]
    rows = [Session.of_json(row) for unit in run_units("lessons", teach, units, tell) for row in unit]
    near = [row for row in run_units("near-misses", mend_near_miss, [(name,) for name in names], tell) if row]
    near = near[:_INSTANCES]
    return Result(
        "lessons",
        "Taught without a queue",
        (_session_table(rows), _near_table(near)),
        tuple(_list_goals(rows, near)),
        _NOTES,
        (*(row.summarize() for row in rows), *(one for pair in near for one in pair)),
    )


def teach(name: str, condition: str, quick: bool) -> list[dict[str, Any]]:
    """One task under one condition by each person, on labels as the tool takes them before anything is shown."""
    one, seeds = CONDITIONS[condition], REPORTED[: 1 if quick else None]
    families = ((seed, open_family(name, one.setting(seed))) for seed in seeds)
    return [teach_task(bench, one, seed, takes_labels=True).to_json() for seed, bench in families]


def mend_near_miss(name: str) -> list[dict[str, Any]]:
    """The near miss of a task by repair, on its labels as they are and as the tool takes them; nothing without one."""
    found = instance(name)
    if found is None:
        return []
    return [mend(found, "ABI").to_json(), mend(found, "ABI", takes_labels=True).to_json()]


def _list_goals(rows: Sequence[Session], near: Sequence[list[dict[str, Any]]]) -> Iterator[Goal]:
    for one, told, tasks in ((DOZEN, "the tool's dozen", 24), (FLAT, "a random dozen", 22)):
        groups = by_task(rows, one.name)
        solved = 100 * count_solved(groups) / max(len(groups), 1)
        yield Goal(f"tasks right, {FLAT.name}, {told}, %", "at least", round(100 * tasks / 24, 1), solved)
    guided = [row for row in rows if row.condition == DOZEN.name]
    right = 100 * sum(row.right for row in guided) / max(len(guided), 1)
    yield Goal(f"sessions right, {FLAT.name}, the tool's dozen, %", "at least", 100.0, right)
    yield Goal("ten near misses right", "at least", 1.0, _share_right(near, 1))
    true = [row for row in rows if row.condition == TRUE.name]
    yield Goal("false repairs of right labels, of 250 lessons", "at most", 1.0, 250 * _share_false(true))


def _share_right(near: Sequence[list[dict[str, Any]]], way: int) -> float:
    return float(sum(pair[way]["right"] for pair in near)) / max(len(near), 1)


def _share_false(rows: Sequence[Session]) -> float:
    """Of lessons, each after a new demonstration, those in which a repair was proposed that is none."""
    return sum(row.refused for row in rows) / max(sum(len(row.shown) for row in rows), 1)


def _session_table(rows: Sequence[Session]) -> Table:
    columns = ("condition", "tasks right", "sessions right", "k", "lessons", "repairs proposed", "of these false")
    lines: list[tuple[Cell, ...]] = []
    for one in _CONDITIONS:
        mine, groups = [row for row in rows if row.condition == one.name], by_task(rows, one.name)
        refused = sum(row.refused for row in mine)
        lines.append(
            (
                one.name,
                f"{count_solved(groups)}/{len(groups)}",
                f"{sum(row.right for row in mine)}/{len(mine)}",
                sum(row.k for row in mine) / max(len(mine), 1),
                sum(len(row.shown) for row in mine),
                refused + sum(row.confirmed for row in mine),
                refused,
            )
        )
    return Table("Programs", columns, tuple(lines))


def _near_table(near: Sequence[list[dict[str, Any]]]) -> Table:
    ways = ("repair, labels as they are", "repair, labels as the tool takes them")
    lines = [
        (
            told,
            len(near),
            _share_right(near, way),
            sum(pair[way]["demonstrations"] for pair in near) / max(len(near), 1),
            sum(pair[way]["confirmed"] for pair in near),
            sum(pair[way]["refused"] for pair in near),
        )
        for way, told in enumerate(ways)
    ]
    return Table("Near misses", ("", "instances", "right", "demonstrations", "confirmed", "refused"), tuple(lines))


_NOTES = (
    "A session as before there was a queue: demonstrations, the tool's questions and repairs, and looks at a dozen "
    "results, until all of them are as the reference's on the same labels. *Right*: on every mesh that was not shown "
    "the program selects what the reference selects under the same labels; a task is right if all five sessions are. "
    "Here the labels are first taken as all that is known of the family speaks for them; `script/bench effectiveness` "
    "measures sessions on labels as they come.",
    "*False*: a repair that a person refuses, as the label is right. *A lesson*: learning after a new demonstration.",
    "*Near misses*: the ten of `script/bench correction`, in which two demonstrations do not suffice without repair, "
    "though they would if their labels were right; at most three more are given.",
)
