"""What is learned on families of real assets, taught on the meshes as they come and on each decomposition."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from benchmark.evaluation.figures import (
    Groups,
    acts,
    by_task,
    count_settled_wrong,
    count_solved,
    format_pair,
    fpr,
    fpr_of_reference,
    fpr_on_true,
    person_seconds,
    spread,
)
from benchmark.journal import run_units
from benchmark.real.samples import ALL_SETTINGS, family_samples
from benchmark.real.tasks import real_task
from benchmark.report import Cell, Goal, Table, Tell
from benchmark.study import CONDITIONS, FLAT, MOST, REPORTED, TRUE, Bench, Session, teach_task
from benchmark.study.condition import PROPAGATED, SYSTEMATIC
from benchmark.tasks import DIFFICULTIES

TAUGHT = (TRUE, FLAT, SYSTEMATIC, PROPAGATED[2])
"""The conditions, all with the person who helps the tool in no way."""
LEAST = MOST + 3
"""Meshes that a family needs at a decomposition, to be taught on it."""
_COLUMNS = (
    "tasks",
    "sessions",
    "SSR",
    "sessions right",
    "k",
    "labels right, %",
    "FPR",
    "of the reference, same labels",
    "of the reference, true labels",
    "acts",
    "person, s",
    "settled but wrong",
)


def teach_families(names: Sequence[str], settings: Sequence[str], tell: Tell, quick: bool) -> list[Session]:
    """The sessions of all tasks of some families: a demonstrator for each decomposition, under each condition."""
    conditions = TAUGHT[:1] if quick else TAUGHT
    units = [(name, level, one.name, settings) for name in names for level in DIFFICULTIES for one in conditions]
    rows = run_units("real-sessions", teach_real_task, units, tell)
    return [Session.of_json(row) for unit in rows for row in unit]


def teach_real_task(name: str, difficulty: str, condition: str, settings: Sequence[str]) -> list[dict[str, Any]]:
    """One task under one condition, at each decomposition of which the family has enough meshes."""
    one, found = real_task(name, difficulty), list[dict[str, Any]]()
    for seed, setting in zip(REPORTED, settings, strict=False):
        samples = family_samples(name, setting)
        if len(samples) >= LEAST:
            found.append(teach_task(Bench(one, samples), CONDITIONS[condition], seed).to_json())
    return found


def tell_families(rows: Sequence[Session]) -> Table:
    """What sessions come to, family by family, the worst under each condition last of it; then all families."""
    lines: list[tuple[Cell, ...]] = []
    for condition in dict.fromkeys(row.condition for row in rows):
        mine = [row for row in rows if row.condition == condition]
        families = sorted({_family_of(row) for row in mine}, key=lambda name: (-_share_right(mine, name), name))
        lines += [
            (condition, name, *_figures([row for row in mine if _family_of(row) == name], condition))
            for name in families
        ]
        lines.append((condition, "all", *_figures(mine, condition)))
    title = "Taught on real families, the worst family of each condition last before all"
    return Table(title, ("condition", "family", *_COLUMNS), tuple(lines))


def tell_settings(rows: Sequence[Session]) -> Table:
    """The same by decomposition, true labels."""
    mine = [row for row in rows if row.condition == TRUE.name]
    lines = [
        (setting.replace("_", " "), *_figures([row for row in mine if row.setting == setting], TRUE.name))
        for setting in ALL_SETTINGS
    ]
    return Table(
        "Taught on real families under true labels, by decomposition", ("decomposition", *_COLUMNS), tuple(lines)
    )


def find_goals(rows: Sequence[Session]) -> list[Goal]:
    """How many tasks were taught rightly at all decompositions; and in the worst family."""
    mine = [row for row in rows if row.condition == TRUE.name]
    if not mine:
        return []
    groups = by_task(mine, TRUE.name)
    solved = 100 * count_solved(groups) / len(groups)
    families = {_family_of(row) for row in mine}
    worst = min(sorted(families), key=lambda name: _share_right(mine, name))
    return [
        Goal("tasks synthesized, true labels, %", "at least", 100.0, solved),
        Goal(f"sessions right in the worst family ({worst}), true labels, %", "at least", 90.0,
             100 * _share_right(mine, worst)),
        Goal("settled and accepted, yet wrong, all conditions", "at most", 0.0, float(count_settled_wrong(rows))),
    ]  # fmt: skip


def _family_of(row: Session) -> str:
    return row.task.removeprefix("real-").rpartition("-")[0]


def _share_right(rows: Sequence[Session], family: str) -> float:
    mine = [row for row in rows if _family_of(row) == family]
    return sum(row.right for row in mine) / max(len(mine), 1)


def _figures(rows: Sequence[Session], condition: str) -> list[Cell]:
    groups: Groups = by_task(rows, condition)
    return [
        len(groups),
        len(rows),
        f"{count_solved(groups)}/{len(groups)}",
        f"{sum(row.right for row in rows)}/{len(rows)}",
        format_pair(spread(groups, lambda row: row.k), 1),
        100 * spread(groups, lambda row: row.labels_right)[0],
        *(format_pair(spread(groups, figure)) for figure in (fpr, fpr_of_reference, fpr_on_true)),
        *(format_pair(spread(groups, figure), 0) for figure in (acts, person_seconds)),
        count_settled_wrong(rows),
    ]
