"""The rules of the tasks, searched by us, by the paper's algorithms and by cvc5, all taking turns."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from statistics import mean

from benchmark.evaluation.sessions import QUICK
from benchmark.learning.contest import READINGS, Contest
from benchmark.learning.search_tables import Row, by_group, by_size, contest_goals, contestants
from benchmark.learning.task_cases import task_cases
from benchmark.report import Goal, Result, Tell
from benchmark.study import REPORTED
from meshforge.common import pluralize

SHOWN = (1, 3)
"""Meshes on which each rule is shown."""
LIMIT, _ROUNDS = 20.0, 3
"""Seconds for one rule; who takes longer counts as having taken so long, so that ratios are lower bounds."""


def measure(tell: Tell, quick: bool) -> Result:
    """Let all contestants take turns on every rule, as the first demonstrator shows it, and with more meshes shown."""
    rows, names, details = list[Row](), list[tuple[str, int]](), []
    for case in task_cases(REPORTED[:1], SHOWN, QUICK if quick else None, calibration=False):
        contest = Contest(case, 2.0 if quick else LIMIT)
        seconds = contest.seconds(1 if quick else _ROUNDS)
        names.append((case.family, len(case.shown)))
        rows.append(
            Row(f"shown on {pluralize(len(case.shown), 'mesh', 'meshes')}", seconds, contest.sizes(), contest.alarms)
        )
        details.append({"task": case.family, **contest.to_json(seconds)})
        tell(f"contest: {len(rows)} rules, {case.family}")
    return Result(
        "contest",
        "Against the paper's algorithms and cvc5, on the tasks' rules",
        (contestants(rows), by_size(rows), by_group(rows)),
        tuple(_goals(names, rows)),
        (
            "Each rule of each task that the first demonstrator (seed 100) shows on the first mesh; and the same "
            "with two more meshes, drawn at random. Meshes are as the earlier rules leave them, contacts known, "
            "labels true. The [learning page](results/learning.md) explains the contestants.",
            "After one demonstration a label alone fits nearly always, or one `Attach` or `Geo`. The paper's search "
            "finds that in a fraction of a millisecond, while ours first compares the hulls of all meshes. See the "
            "table by size.",
            "We first measured this on one demonstrated mesh only, where the paper's search is faster on all rules "
            "together, and added three meshes after we saw that. The table of ratios lists both; the goals are over "
            "both together.",
            f"A contestant that takes longer than {LIMIT:.0f} s is stopped, and counts as {LIMIT:.0f} s: ratios to it "
            "are lower bounds.",
        ),
        tuple(details),
    )


def _goals(names: Sequence[tuple[str, int]], rows: Sequence[Row]) -> Iterator[Goal]:
    spent = defaultdict[tuple[str, int], float](float)
    for name, row in zip(names, rows, strict=True):
        spent[name] += row.seconds[READINGS]
    yield Goal("search and readings of a task, mean, s", "at most", 0.05, mean(spent.values()))
    yield from contest_goals(rows)
