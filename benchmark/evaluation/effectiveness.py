"""RQ1: whether programs are learned from few demonstrations, and whether the edited meshes do what they are for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from benchmark.evaluation import effectiveness_notes
from benchmark.evaluation.effectiveness_tables import Conditions, list_tables
from benchmark.evaluation.figures import (
    all_sessions,
    by_task,
    confirmations,
    count_settled_wrong,
    count_solved,
    is_right_everywhere,
    share_solved_at,
    spread,
    tool_seconds,
)
from benchmark.evaluation.sessions import sessions
from benchmark.report import Goal, Result, Tell
from benchmark.study import FLAT, TRUE, Session
from benchmark.study.condition import CONDITIONS, HELP, KIND, MAIN, MERGED_SETS

ASKED = (*MAIN, *HELP, *MERGED_SETS)
_QUICK = (*MAIN, KIND, *MERGED_SETS)


def measure(tell: Tell, quick: bool) -> Result:
    """Teach all tasks under each kind of labels, by people who help the tool in no way, and by kinder ones."""
    return summarize(sessions(_QUICK if quick else ASKED, tell, quick), "effectiveness", "RQ1: effectiveness")


def summarize(rows: Sequence[Session], part: str, title: str) -> Result:
    """What sessions under all these conditions come to."""
    groups = {one.name: found for one in ASKED if (found := by_task(rows, one.name))}
    return Result(
        part,
        title,
        list_tables(groups),
        tuple(_goals(groups)),
        tuple(effectiveness_notes.NOTES),
        tuple(row.summarize() for row in rows),
    )


def _goals(groups: Conditions) -> Iterator[Goal]:
    true, noisy = groups[TRUE.name], groups[FLAT.name]
    every, many = all_sessions(true), max(len(true), 1)
    yield Goal("tasks synthesized, true labels, %", "at least", 100.0, 100 * count_solved(true) / many)
    everywhere = 100 * count_solved(true, is_right_everywhere) / many
    yield Goal("the same, right on all decompositions, %", "at least", 100.0, everywhere)
    yield Goal(f"tasks synthesized, {FLAT.name}, %", "at least", 100.0, 100 * count_solved(noisy) / many)
    for k, wanted in ((1, 60.0), (2, 90.0), (3, 100.0)):
        yield Goal(f"SSR at k = {k}, true labels, %", "at least", wanted, 100 * share_solved_at(true, k))
    yield Goal("demonstrations plus answers a task, mean", "at most", 1.8, spread(true, lambda row: row.k)[0])
    among = [known for row in every for known in row.known_among]
    yield Goal("true behaviour among the readings, % of rules", "at least", 99.0, 100 * sum(among) / max(len(among), 1))
    accepted = [row for row in every if row.accepted]
    settled = sum(row.settled for row in accepted)
    yield Goal("settled, % of accepted runs", "at least", 90.0, 100 * settled / max(len(accepted), 1))
    wrong = sum(count_settled_wrong(all_sessions(groups.get(name, {}))) for name in CONDITIONS)
    yield Goal("settled and accepted, yet wrong, all conditions", "at most", 0.0, float(wrong))
    replayed = max((tool_seconds(row, "replay") / len(row.rounds) for row in every), default=0.0)
    yield Goal("replay over the family, slowest session, a round, s", "at most", 1.0, replayed)
    yield Goal(f"{FLAT.name}: confirmations a task", "at most", 1.5, spread(noisy, confirmations)[0])
    rows = all_sessions(noisy)
    asked = sum(map(confirmations, rows))
    right = 100 * sum(row.confirmed for row in rows) / asked if asked else 0.0
    yield Goal(f"{FLAT.name}: proposed corrections that are right, %", "at least", 95.0, right)
