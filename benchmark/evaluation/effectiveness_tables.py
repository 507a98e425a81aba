"""The tables of effectiveness: what is learned, what becomes of the meshes, and what a person does for it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from operator import attrgetter

from benchmark.evaluation import paper
from benchmark.evaluation.failures import list_failures
from benchmark.evaluation.figures import (
    LEVELS,
    Groups,
    acts,
    all_sessions,
    confirmations,
    count_solved,
    demonstrations,
    format_pair,
    fpr,
    fpr_of_reference,
    fpr_on_true,
    is_right_everywhere,
    of_difficulty,
    person_seconds,
    share_solved_at,
    spread,
    synthesis,
    tool_seconds,
)
from benchmark.report import Cell, Table
from benchmark.study import FLAT, TRUE, Session
from benchmark.study.condition import KIND, MAIN
from benchmark.study.keystrokes import PRICES, model_seconds
from benchmark.tasks import task

KS = range(1, 9)
_PHASES = ("demonstrating", "labelling", "answering", "confirming", "looking", "approving")
Conditions = Mapping[str, Groups]
"""Sessions by task, by condition."""


def list_tables(groups: Conditions) -> tuple[Table, ...]:
    """All tables, in the order of the page."""
    true, noisy = groups[TRUE.name], groups[FLAT.name]
    return (
        _levels("True labels", true),
        _levels(f"{FLAT.name.capitalize()}, repair on", noisy),
        _programs(groups),
        _edits(groups),
        _acts(groups),
        _phases(groups),
        Table("Prices of the acts, modelled", ("act", "s"), tuple(PRICES.items())),
        _few_shot(groups),
        _tasks(true, noisy),
        list_failures({one.name: groups[one.name] for one in (TRUE, KIND)}),
    )


def _levels(title: str, groups: Groups) -> Table:
    columns = (
        "difficulty",
        "N",
        "demonstrations (paper)",
        "demonstrations",
        "answers",
        "k = both",
        "SSR (paper)",
        "SSR",
        "FPR (paper)",
        "FPR",
        "FPR of the reference",
        "synthesis, s (paper)",
        "synthesis, s",
    )
    return Table(title, columns, tuple(_level(level, of_difficulty(groups, level)) for level in LEVELS))


def _level(level: str, groups: Groups) -> tuple[Cell, ...]:
    _, demos, ssr, functional, seconds = paper.RQ1[level]
    return (
        level,
        len(groups),
        demos,
        format_pair(spread(groups, demonstrations), 1),
        format_pair(spread(groups, lambda row: row.answers), 1),
        format_pair(spread(groups, lambda row: row.k), 1),
        ssr,
        f"{count_solved(groups)}/{len(groups)}",
        functional,
        format_pair(spread(groups, fpr)),
        format_pair(spread(groups, fpr_of_reference)),
        seconds,
        format_pair(spread(groups, synthesis)),
    )


def _by_condition(title: str, columns: Sequence[str], groups: Conditions, row: Callable[[Groups], list[Cell]]) -> Table:
    rows = [(name, _count_people(found), *row(found)) for name, found in groups.items()]
    absent = ("labels of a VLM", *["not run"] * (len(columns) + 1))
    return Table(title, ("condition", "people", *columns), (*rows, absent))


def _count_people(groups: Groups) -> int:
    return len({row.seed for row in all_sessions(groups)})


def _programs(groups: Conditions) -> Table:
    columns = (
        "SSR",
        "sessions right",
        "right if labels were",
        "and on all decompositions",
        "k",
        "settled, %",
        "settled but wrong",
    )
    return _by_condition("What is learned", columns, groups, _programs_row)


def _programs_row(found: Groups) -> list[Cell]:
    every = all_sessions(found)
    accepted = [row for row in every if row.accepted]
    return [
        f"{count_solved(found)}/{len(found)}",
        *(
            f"{sum(map(is_so, every))}/{len(every)}"
            for is_so in (attrgetter("right"), attrgetter("right_on_true"), is_right_everywhere)
        ),
        format_pair(spread(found, lambda row: row.k), 1),
        100 * sum(row.settled for row in accepted) / max(len(accepted), 1),
        sum(row.settled and not row.right for row in accepted),
    ]


def _edits(groups: Conditions) -> Table:
    columns = ("labels right, %", "F1", "FPR", "of the reference, same labels", "of the reference, true labels")
    return _by_condition(
        "What becomes of the meshes, and what the reference makes of them", columns, groups, _edits_row
    )


def _edits_row(found: Groups) -> list[Cell]:
    return [
        100 * spread(found, lambda row: row.labels_right)[0],
        format_pair(spread(found, lambda row: row.f1), 3),
        *(format_pair(spread(found, figure)) for figure in (fpr, fpr_of_reference, fpr_on_true)),
    ]


def _acts(groups: Conditions) -> Table:
    columns = (
        "demonstrations",
        "steps",
        "hulls selected",
        "labels given",
        "labels inspected",
        "answers",
        "confirmations",
        "of these right, %",
        "taken back",
        "looks",
        "approvals",
        "acts in all",
        "seconds in all",
    )
    return _by_condition("What a person does, a task, and what it costs", columns, groups, _acts_row)


def _acts_row(found: Groups) -> list[Cell]:
    proposed = sum(map(confirmations, all_sessions(found)))
    figures: list[Callable[[Session], float | None]] = [
        demonstrations,
        lambda row: row.steps_shown,
        lambda row: row.hulls_shown,
        lambda row: row.typed,
        lambda row: row.inspected,
        lambda row: row.answers,
        confirmations,
        lambda row: row.taken_back + row.set_aside,
        lambda row: row.glances,
        lambda row: row.approvals,
    ]
    means: list[Cell] = [spread(found, figure)[0] for figure in figures]
    right: Cell = 100 * sum(row.rightly for row in all_sessions(found)) / proposed if proposed else "–"
    return [
        *means[:7],
        right,
        *means[7:],
        format_pair(spread(found, acts), 0),
        format_pair(spread(found, person_seconds), 0),
    ]


def _phases(groups: Conditions) -> Table:
    rows = []
    for condition in (one for one in MAIN if one.name in groups):
        found = groups[condition.name]
        tool = [spread(found, partial(tool_seconds, part=part)) for part in ("search", "replay")]
        person = [spread(found, partial(_seconds_of, part=part)) for part in _PHASES]
        rows.append((condition.name, *(format_pair(x) for x in tool), *(format_pair(x, 0) for x in person)))
    title = "Time by phase, s a task: the tool's is measured, the person's is modelled by keystrokes"
    return Table(title, ("condition", "search", "replay", *_PHASES), tuple(rows))


def _seconds_of(row: Session, part: str) -> float:
    return model_seconds(row)[part]


def _few_shot(groups: Conditions) -> Table:
    columns = ("condition", "difficulty", *(f"k = {k}" for k in KS))
    rows: list[tuple[Cell, ...]] = [("paper", "all", *(paper.FEW_SHOT.get(k, "") for k in KS))]
    for condition in (one for one in (*MAIN, KIND) if one.name in groups):
        for level in LEVELS if condition in (TRUE, FLAT) else ("all",):
            found = of_difficulty(groups[condition.name], level)
            rows.append((condition.name, level, *(100 * share_solved_at(found, k) for k in KS)))
    return Table("SSR at k demonstrations plus answers, %", columns, tuple(rows))


def _tasks(true: Groups, noisy: Groups) -> Table:
    columns = (
        "task",
        "rules",
        "k",
        "SSR",
        "person, s",
        "FPR",
        "reference",
        "pure meshes",
        "flat noise: k",
        "SSR",
        "person, s",
        "FPR",
        "reference",
    )
    return Table("Task by task", columns, tuple(_task(name, true[name], noisy.get(name, [])) for name in true))


def _task(name: str, true: Sequence[Session], noisy: Sequence[Session]) -> tuple[Cell, ...]:
    judged = sum(row.judged for row in true)
    return (
        name,
        len(task(name).program.rules),
        *_task_figures(name, true),
        f"{100 * sum(row.judged_pure for row in true) / max(judged, 1):.0f}%",
        *_task_figures(name, noisy),
    )


def _task_figures(name: str, rows: Sequence[Session]) -> list[Cell]:
    one = {name: rows}
    ssr = f"{sum(row.right for row in rows)}/{len(rows)}"
    return [
        spread(one, lambda row: row.k)[0],
        ssr,
        *(spread(one, figure)[0] for figure in (person_seconds, fpr, fpr_of_reference)),
    ]
