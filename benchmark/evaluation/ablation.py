"""RQ3, first part: the layers of the extractors, left out one by one."""

from __future__ import annotations

from benchmark.evaluation import paper
from benchmark.evaluation.figures import Groups, by_task, count_solved, format_pair, fpr, spread
from benchmark.evaluation.sessions import sessions
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.study import TRUE
from benchmark.study.condition import ABLATIONS
from benchmark.tasks import DIFFICULTIES, task

_NEEDED = 5.0
"""Points of SSR that a layer must be worth: two tasks of 24; one task may be an accident."""


def measure(tell: Tell, quick: bool) -> Result:
    """Teach all tasks with some layers missing."""
    conditions = [*ABLATIONS, TRUE]
    rows = sessions(conditions, tell, quick)
    groups = {condition.options.layers: by_task(rows, condition.name) for condition in conditions}
    columns = ("layers", "SSR (paper)", "SSR", *(f"SSR, {level}" for level in DIFFICULTIES), "FPR", "demonstrations")
    shares = {layers: count_solved(found) / max(len(found), 1) for layers, found in groups.items()}
    missing = {one.name: 100 * (shares["S+T+G"] - shares[one.options.layers]) for one in ABLATIONS}
    return Result(
        "ablation",
        "RQ3: layers of the extractors",
        (Table("SSR with true labels", columns, tuple(_row(layers, found) for layers, found in groups.items())),),
        tuple(
            Goal(f"SSR lost with {layers} alone, points", "at least", _NEEDED, lost) for layers, lost in missing.items()
        ),
        (
            "S: `All` and `Is` under set operators; T: `Attach`; G: `Geo`. All have orientation by landmarks.",
            paper.CONDITIONS,
        ),
        tuple(row.summarize() for row in rows if row.condition != TRUE.name),
    )


def _row(layers: str, groups: Groups) -> tuple[Cell, ...]:
    levels = [{name: rows for name, rows in groups.items() if task(name).difficulty == level} for level in DIFFICULTIES]
    return (
        layers,
        paper.LAYERS[layers],
        f"{count_solved(groups)}/{len(groups)} = {count_solved(groups) / max(len(groups), 1):.3f}",
        *(f"{count_solved(level)}/{len(level)}" for level in levels),
        format_pair(spread(groups, fpr)),
        format_pair(spread(groups, lambda row: len(row.shown)), 1),
    )
