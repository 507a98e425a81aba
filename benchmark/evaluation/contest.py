"""How long one rule takes by the size of its extractor: ours, the paper's algorithms and cvc5, all taking turns."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from statistics import mean

from benchmark.evaluation.sessions import QUICK
from benchmark.learning.cases import FAMILY, Case
from benchmark.learning.contest import READINGS, limit_of, run_contests
from benchmark.learning.larger import SHOWN as LARGER_SHOWN
from benchmark.learning.larger import LargerCases
from benchmark.learning.ratios import Row
from benchmark.learning.search_tables import contest_goals, contest_tables, describe_contest
from benchmark.learning.task_cases import task_cases
from benchmark.report import Goal, Result, Tell
from benchmark.study import REPORTED
from meshforge.common import pluralize

SHOWN = (1, 3, 8)
"""Meshes on which each rule of a task is shown."""
_LARGER = "larger ones"


def measure(tell: Tell, quick: bool) -> Result:
    """Let all contestants take turns on every rule of the tasks, and on problems that need larger extractors."""
    larger = LargerCases(1, (5, 7), ("lamp",)) if quick else LargerCases()
    rows, details = list[Row](), []
    tasks = defaultdict[tuple[str, int], list[Row]](list)
    for problem, row, told in run_contests(_problems(larger, quick), quick):
        rows.append(row)
        details.append(told)
        if row.group != _LARGER:
            tasks[problem.family, len(problem.shown)].append(row)
        tell(f"contest: {len(rows)} rules, {problem.family}")
    return Result(
        "contest",
        "Speed by size of the extractor, against the paper's algorithms and cvc5",
        contest_tables(rows),
        tuple(_goals(tasks, rows)),
        tuple(_notes(larger, limit_of(quick))),
        tuple(details),
    )


def _problems(larger: LargerCases, quick: bool) -> Iterator[tuple[str, Case]]:
    for problem in task_cases(REPORTED[:1], SHOWN, QUICK if quick else None, calibration=False):
        yield f"tasks' rules, {pluralize(len(problem.shown), 'mesh', 'meshes')} shown", problem
    for problem in larger:
        yield _LARGER, problem


def _goals(tasks: Mapping[tuple[str, int], Sequence[Row]], rows: Sequence[Row]) -> Iterator[Goal]:
    yield from contest_goals(rows)
    spent = [sum(row.seconds[READINGS] for row in rules) for rules in tasks.values()]
    yield Goal("search and readings of all rules of a task, mean, s", "at most", 0.05, mean(spent))


def _notes(larger: LargerCases, limit: float) -> Iterator[str]:
    yield (
        "*Tasks' rules*: each rule of each task that the first demonstrator (seed 100) shows on the first mesh; and "
        "the same with two and with seven more meshes, drawn at random. Meshes are as the earlier rules leave them, "
        "contacts known, labels true. Few of these need more than one or two nodes."
    )
    yield (
        f"*Larger ones*: two of the extractors that people want of a family of {FAMILY} meshes of boxes "
        "(`benchmark/learning/targets.py`), joined by `Union`, `Intersect` or `Diff`, and shown on "
        f"{LARGER_SHOWN} meshes. {larger.drawn} were drawn, in an order that is fixed, the families by turns; kept are "
        f"for each of 5, 7 and 9 nodes the first {larger.each} whose smallest extractor that agrees with what was "
        "shown has so many. Size alone decides, not time."
    )
    yield (
        "After one demonstration a label alone agrees nearly always, or one `Attach` or `Geo`. The paper's search "
        "finds that in a fraction of a millisecond, while ours first compares the hulls of all meshes; so where a "
        "small extractor is enough, the paper's is faster."
    )
    yield from describe_contest(limit)
