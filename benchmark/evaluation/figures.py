"""What sessions come to: means over demonstrators, then over tasks, as the paper has it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from statistics import mean, stdev

from benchmark.study import Session
from benchmark.study.keystrokes import count_acts, model_seconds
from benchmark.tasks import DIFFICULTIES, task

Groups = Mapping[str, Sequence[Session]]
"""Sessions by task."""


def by_task(rows: Iterable[Session], condition: str) -> dict[str, list[Session]]:
    """The sessions of a condition, task by task."""
    found = defaultdict(list)
    for row in rows:
        if row.condition == condition:
            found[row.task].append(row)
    return dict(found)


def all_sessions(groups: Groups) -> list[Session]:
    """The sessions of all tasks."""
    return [row for rows in groups.values() for row in rows]


def of_difficulty(groups: Groups, difficulty: str) -> dict[str, Sequence[Session]]:
    """The tasks of a difficulty, or `all`."""
    return {name: rows for name, rows in groups.items() if difficulty in ("all", task(name).difficulty)}


LEVELS = (*DIFFICULTIES, "all")


def count_solved(groups: Groups, is_right: Callable[[Session], bool] = lambda row: row.right) -> int:
    """Tasks that all demonstrators taught rightly."""
    return sum(all(map(is_right, rows)) for rows in groups.values())


def count_settled_wrong(rows: Iterable[Session]) -> int:
    """Sessions that a person accepted and the tool called settled, though the program is wrong."""
    return sum(row.accepted and row.settled and not row.right for row in rows)


def is_right_everywhere(row: Session) -> bool:
    """Whether a program is right under true labels, and on the other decompositions of the assets as well."""
    return row.right_on_true and row.right_elsewhere is not False


def first_right(row: Session) -> int | None:
    """Demonstrations plus answers from which on every program was right; None where the last one was not."""
    since = None
    for one in reversed(row.rounds):
        if not one.right:
            break
        since = one.demonstrations + one.answers
    return since


def share_solved_at(groups: Groups, k: int) -> float:
    """The share of tasks that all demonstrators have had right from then on."""
    firsts = [[first_right(row) for row in rows] for rows in groups.values()]
    return mean(all(first is not None and first <= k for first in row) for row in firsts) if firsts else 0.0


def spread(groups: Groups, figure: Callable[[Session], float | None]) -> tuple[float, float]:
    """Mean and standard deviation over tasks of the mean over demonstrators; None is left out."""
    rows = [[x for row in sessions if (x := figure(row)) is not None] for sessions in groups.values()]
    means = [mean(row) for row in rows if row]
    return (mean(means), stdev(means) if len(means) > 1 else 0.0) if means else (0.0, 0.0)


def format_pair(pair: tuple[float, float], digits: int = 2) -> str:
    """Mean and deviation as text."""
    return f"{pair[0]:.{digits}f} ± {pair[1]:.{digits}f}"


def fpr(row: Session) -> float:
    """The share of the meshes, neither demonstrated nor labelled before, whose edit meets the criterion."""
    return 1 - len(row.failures) / max(row.judged, 1)


def fpr_pure(row: Session) -> float | None:
    """The same of the meshes whose hulls that matter are of one part each."""
    return 1 - row.failed_pure / row.judged_pure if row.judged_pure else None


def fpr_of_reference(row: Session) -> float:
    """The same by the reference program under the same labels."""
    return 1 - row.reference_failed / max(row.judged, 1)


def fpr_on_true(row: Session) -> float:
    """The same by the reference program under true labels."""
    return 1 - row.ceiling_failed / max(row.judged, 1)


def synthesis(row: Session) -> float:
    """Seconds of the tool, all rounds."""
    return sum(r.seconds["all"] for r in row.rounds)


def tool_seconds(row: Session, part: str) -> float:
    """Seconds of the tool in one part of its work, `search` or `replay`, all rounds."""
    return sum(r.seconds.get(part, 0.0) for r in row.rounds)


def demonstrations(row: Session) -> float:
    """How many meshes were demonstrated."""
    return float(len(row.shown))


def confirmations(row: Session) -> float:
    """How many labels a person was asked about."""
    return float(row.confirmed + row.refused)


def acts(row: Session) -> float:
    """All that the person did."""
    return float(count_acts(row))


def person_seconds(row: Session) -> float:
    """The person's time, modelled."""
    return sum(model_seconds(row).values())
