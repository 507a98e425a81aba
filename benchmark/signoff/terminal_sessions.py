"""The same person at a terminal, by files of answers alone: a result is called right or wrong, and no more is said."""

from __future__ import annotations

from collections.abc import Sequence

from benchmark.report import Goal, Result, Tell
from benchmark.signoff.conditions import NONE, list_people, list_tasks
from benchmark.signoff.outcomes import mean_over_tasks, right_when_done, share, wrong_when_done
from benchmark.signoff.queue import Review
from benchmark.signoff.session_tables import tell_amiss, tell_ends, tell_long
from benchmark.signoff.sessions import Unit, read_reviews, run_sessions
from benchmark.signoff.terminal import AnswersClient, ProcessClient
from benchmark.study import FLAT

_WANTED = {FLAT: 98.0, NONE: 97.0}
_BY_PROCESSES = ("cup-easy", "knife-easy", "chair-easy", "dispenser-medium", "table-medium")
_MANY = len(_BY_PROCESSES)
"""Sessions that are held by real processes too, one person a task."""


def measure(tell: Tell, quick: bool) -> Result:
    """Sign the families off by `review --answers` under noisy labels, and from none."""
    names = [name for name in list_tasks() if not quick or name == "cup-easy"]
    people = max(len(list_people(names[0], one)) for one in _WANTED)
    units = [
        Unit(name, one.name, list_people(name, one)[place], None, AnswersClient.name)
        for place in range(1 if quick else people)
        for name in names
        for one in _WANTED
    ]
    rows = read_reviews(run_sessions(units, tell))
    same = [one for one in units if one.task in _BY_PROCESSES and one.condition == FLAT.name][: 1 if quick else _MANY]
    again = read_reviews(run_sessions([one._replace(client=ProcessClient.name) for one in same], tell))
    return summarize(rows, again)


def summarize(rows: Sequence[Review], again: Sequence[Review]) -> Result:
    """What the sessions come to; again: some of them, held by real processes."""
    some = {one: [row for row in rows if row.condition == one.name] for one in _WANTED}
    groups = {(one.name, AnswersClient.name): mine for one, mine in some.items()}
    goals = [
        Goal(f"right and signed off when done, {one.name}, %", "at least", _WANTED[one],
             mean_over_tasks(mine, right_when_done))
        for one, mine in some.items()
    ]  # fmt: skip
    worst = max(mean_over_tasks(mine, wrong_when_done) for mine in some.values())
    goals.append(Goal("signed off, yet wrong, most of all conditions, %", "at most", 1.0, worst))
    agree = share(sum(row in rows for row in again), len(again))
    goals.append(Goal("sessions by processes of their own that come to the same, %", "at least", 100.0, agree))
    tables = (tell_ends(groups), tell_amiss([(AnswersClient.name, row) for row in rows]), tell_long(groups))
    return Result("terminal_sessions", "By files of answers alone", tables, tuple(goals), _NOTES)


_NOTES = (
    "The person demonstrates where `review --json` asks for it, and replies by `review --answers FILE --json`; of a "
    "result that is wrong they say no more than that. The commands run in one process; some sessions are held "
    "again by a process for each command, and must come to the same, act by act.",
    "What would make these figures fail: a result that no further answer can make right, as nobody says what is right "
    "of it; such an asset needs review to the end, and is not counted as right.",
    "Not reached, and why. *From none*: on chairs and dispensers, labels that nobody gave are thought of on all hulls "
    "far from the labelled ones, so most results are wrong and few are sure; *wrong* alone says nothing of labels, and "
    "the groups that would are worth less than the next result, as each counts its own hulls alone. What is not known "
    "to be right needs review; hardly anything is signed off wrong.",
)
