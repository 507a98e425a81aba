"""The paper's rows beside what the queue makes of them: tasks that come out right, after how much, by which repairs."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from statistics import mean

from benchmark.journal import ROOT
from benchmark.report import Cell, Table
from benchmark.signoff.outcomes import last, share
from benchmark.signoff.queue import Review
from benchmark.signoff.session_tables import count_corrected
from benchmark.study import FLAT, TRUE
from benchmark.study.condition import TELLING

_WITHOUT = ROOT / "benchmark" / "results" / "evaluation-effectiveness.json"
_KS: Mapping[int, str] = {1: "33.3", 2: "–", 3: "91.7"}
"""SSR of the paper after so many demonstrations."""


_WHY = (
    "Here a task counts only where each of three people ends with every asset right that can be, and signed off, on "
    "three decompositions, and a corrected result counts as a demonstration; the paper counts the demonstrations after "
    "which the program is right."
)


def is_right(row: Review) -> bool:
    """Whether all assets that can be right are, and are signed off, and none is signed off that is not."""
    return last(row).sure == row.possible and not last(row).wrong


def count_shown(row: Review) -> int:
    """Meshes on which a person showed what is wanted: demonstrations, and results that were corrected."""
    return row.acts.get("demonstration", 0) + count_corrected(row)


def count_replies(row: Review) -> int:
    """The same, and answers about the program."""
    return count_shown(row) + row.acts.get("candidate", 0) + row.acts.get("selection", 0)


def share_of_tasks(
    rows: Sequence[Review], most: int | None = None, count: Callable[[Review], int] = count_replies
) -> float:
    """Percent of the tasks that each person got right, with so many replies at most."""
    by_task = defaultdict[str, list[bool]](list)
    for row in rows:
        by_task[row.task].append(is_right(row) and (most is None or count(row) <= most))
    return share(sum(map(all, by_task.values())), len(by_task))


def describe_gaps(table: Table) -> str:
    """Where we are behind the paper, and why."""
    behind = [
        f"{what}: {told} in the paper, {ours:.3g} here"
        for what, told, _, ours in table.rows
        if told != "–" and (float(told) < float(ours) if "confirmations" in str(what) else float(told) > float(ours))
    ]
    return f"Behind the paper: {'; '.join(behind)}. {_WHY}" if behind else "Nowhere behind the paper's rows."


def tell_paper(groups: Mapping[str, Sequence[Review]]) -> Table:
    """groups: sessions by the name of the condition; of those that are missing there is no row."""
    without = {goal["what"]: goal["measured"] for goal in json.loads(_WITHOUT.read_text("utf-8"))["goals"]}
    rows: list[tuple[Cell, ...]] = []
    if true := groups.get(TRUE.name):
        for k, told in _KS.items():
            shown = share_of_tasks(true, k, count_shown)
            rows.append((f"tasks right, true labels, k = {k} meshes shown, %", told, "–", shown))
            alone = without[f"SSR at k = {k}, true labels, %"]
            rows.append((f"… answers about the program counted too, k = {k}, %", "–", alone, share_of_tasks(true, k)))
    for one in (TELLING, FLAT):
        if some := groups.get(one.name):
            alone = without.get(f"tasks synthesized, {one.name}, %", "–")
            rows.append((f"tasks right, {one.name}, %", "95.8", alone, share_of_tasks(some)))
    if flat := groups.get(FLAT.name):
        asked = [row.acts.get("repair", 0) for row in flat]
        right = share(sum(asked) - sum(row.refused for row in flat), sum(asked))
        confirmations, corrections = f"{FLAT.name}: confirmations a task", "proposed corrections that are right, %"
        rows.append((confirmations, 3.6, without[confirmations], mean(asked)))
        rows.append((f"{FLAT.name}: {corrections}", "–", without[f"{FLAT.name}: {corrections}"], right))
    return Table("Beside the paper", ("figure", "paper", "without the queue", "with the queue"), tuple(rows))
