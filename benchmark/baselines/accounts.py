"""What asking a model came to, as a table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from benchmark.baselines.refinement import Answer
from benchmark.baselines.run import BaselineRun
from benchmark.evaluation.figures import by_task, count_solved, demonstrations, format_pair, fpr_pure, spread
from benchmark.report import Cell, Table
from benchmark.study import Condition, Session

_COLUMNS = (
    "",
    "condition",
    "sessions",
    "SSR",
    "FPR, pure meshes",
    "demonstrations",
    "do as was shown, %",
    "rounds",
    "nothing readable",
    "tokens in, a session",
    "tokens out",
    "$ a session",
    "$ in all",
)


def accounts(
    rows: Sequence[tuple[str, BaselineRun, bool]], conditions: Sequence[Condition], *, is_priced: bool
) -> Table:
    """By baseline and condition; rows: the name, what came of it, and whether what is written has rules to compare."""
    cells = [
        _cells(name, played, condition, has_rules=has_rules, is_priced=is_priced)
        for name, played, has_rules in rows
        for condition in conditions
    ]
    return Table("Asking the model", _COLUMNS, tuple(cells))


def _cells(
    name: str, played: BaselineRun, condition: Condition, *, has_rules: bool, is_priced: bool
) -> tuple[Cell, ...]:
    pairs = list(_of(played, condition))
    groups, written = by_task([session for session, _ in pairs], condition.name), [one for _, one in pairs]
    many = max(len(pairs), 1)
    cost = sum(one.cost for one in written)
    return (
        name,
        condition.name,
        len(pairs),
        f"{count_solved(groups)}/{len(groups)}" if has_rules else "–",
        format_pair(spread(groups, fpr_pure)),
        format_pair(spread(groups, demonstrations), 1),
        100 * sum(one.fits for one in written) / many,
        sum(one.rounds for one in written) / many,
        sum(one.text is None for one in written),
        sum(one.input for one in written) / many,
        sum(one.output for one in written) / many,
        cost / many if is_priced else "–",
        cost if is_priced else "–",
    )


def _of(played: BaselineRun, condition: Condition) -> Iterator[tuple[Session, Answer]]:
    for session, written in zip(played.sessions, played.written, strict=True):
        if session.condition == condition.name:
            yield session, written
