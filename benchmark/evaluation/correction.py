"""RQ3, second part: what label repair does, in all sessions and in ten fixed near misses."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import mean, stdev
from typing import Any, get_args

from benchmark.evaluation import paper
from benchmark.evaluation.figures import by_task, confirmations, count_solved, format_pair, fpr, spread
from benchmark.evaluation.sessions import QUICK, sessions
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.study import FLAT, REPORTED, Session
from benchmark.study.condition import UNREPAIRED
from benchmark.study.instances import Way, instance, mend
from benchmark.tasks import tasks

WAYS: tuple[Way, ...] = get_args(Way)
INSTANCES = 10


def measure(tell: Tell, quick: bool) -> Result:
    """Compare sessions with and without repair, and three ways on the same instances."""
    seeds = UNREPAIRED.seeds(REPORTED)
    rows = [row for row in sessions((FLAT, UNREPAIRED), tell, quick) if row.seed in seeds]
    names = [one.name for one in tasks() if not quick or one.category == QUICK]
    found = [row for row in run_units("instances", compare_ways, [(name,) for name in names], tell) if row][:INSTANCES]
    ways = {way: [row for instance in found for row in instance if row["way"] == way] for way in WAYS}
    rates = {way: mean(row["right"] for row in mine) if mine else 0.0 for way, mine in ways.items()}
    return Result(
        "correction",
        "RQ3: label repair",
        (_sessions(rows), _study(ways)),
        (Goal("ten near misses with ABI: SSR", "at least", 1.0, rates["ABI"]),),
        (
            "The first table has the same three demonstrators in both rows. Confidence tells nothing of errors.",
            f"{len(found)} instances: for each task the first draw of noisy labels and demonstrations for which "
            "two demonstrations are not enough without repair, but would be if all their labels were right; the first "
            "ten tasks with such a draw. All ways start from the same two demonstrations, and add at most three more "
            "from the same pool.",
            "The person's time is modelled by keystrokes, the tool's is measured; the paper measured real people, "
            "end to end. We cannot simulate its ratings (cognitive burden, interaction efficiency), and leave them "
            "out.",
            "*Triggered*: tasks in which a person was asked to confirm a correction.",
        ),
        tuple(row for instance in found for row in instance),
    )


def compare_ways(name: str) -> list[dict[str, Any]]:
    """All ways on the instance of a task, nothing where it has none."""
    found = instance(name)
    return [mend(found, way).to_json() for way in WAYS] if found else []


def _sessions(rows: Sequence[Session]) -> Table:
    columns = ("", "SSR", "sessions right", "FPR", "demonstrations", "confirmations a task", "right, %",
               "tasks triggered, a person")  # fmt: skip
    lines: list[tuple[Cell, ...]] = [
        ("paper, with ABI", "23/24", "", "0.92 ± 0.08", "2.2 ± 1.1", paper.CONFIRMATIONS, 100, paper.TRIGGERED)
    ]
    for condition in (FLAT, UNREPAIRED):
        groups = by_task(rows, condition.name)
        every = [row for sessions in groups.values() for row in sessions]
        asked = sum(row.confirmed + row.refused for row in every)
        seeds = {row.seed for row in every}
        triggered = [sum(bool(row.confirmed + row.refused) for row in every if row.seed == seed) for seed in seeds]
        lines.append(
            (
                condition.name,
                f"{count_solved(groups)}/{len(groups)}",
                f"{sum(row.right for row in every)}/{len(every)}",
                format_pair(spread(groups, fpr)),
                format_pair(spread(groups, lambda row: len(row.shown)), 1),
                format_pair(spread(groups, confirmations), 1),
                100 * sum(row.confirmed for row in every) / asked if asked else "–",
                mean(triggered) if triggered else 0.0,
            )
        )
    return Table("All sessions under noisy labels", columns, tuple(lines))


def _study(ways: dict[Way, list[dict[str, Any]]]) -> Table:
    columns = (
        "",
        "SSR (paper)",
        "SSR",
        "s, end to end (paper)",
        "person, s, modelled",
        "tool, s",
        "demonstrations",
        "hulls inspected",
        "labels typed",
        "confirmations",
    )
    rows = []
    for way, mine in ways.items():
        ssr, seconds = paper.REPAIR[way]
        asked = [row["confirmed"] + row["refused"] for row in mine]
        rows.append(
            (
                way,
                ssr,
                mean(row["right"] for row in mine) if mine else "–",
                seconds,
                _mean([row["person"] for row in mine]),
                _mean([row["seconds"] for row in mine]),
                _mean([row["demonstrations"] for row in mine]),
                _mean([row["inspected"] for row in mine]),
                _mean([row["typed"] for row in mine]),
                _mean(asked),
            )
        )
    return Table("Ten near misses, a task", columns, tuple(rows))


def _mean(values: Sequence[float]) -> str:
    return f"{mean(values):.1f} ± {stdev(values) if len(values) > 1 else 0.0:.1f}" if values else "–"
