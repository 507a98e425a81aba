"""The same person at a terminal, by files of answers alone."""

from __future__ import annotations

from collections.abc import Sequence
from operator import eq

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
"""Tasks whose sessions under noisy labels are held by real processes too, one person a task."""


def measure(tell: Tell, quick: bool) -> Result:
    """Sign the families off by `review --answers` under noisy labels, and from none."""
    names = [name for name in list_tasks() if not quick or name == "cup-easy"]
    people = 1 if quick else max(len(list_people(names[0], one)) for one in _WANTED)
    units = [
        Unit(name, one.name, list_people(name, one)[place], None, AnswersClient.name)
        for place in range(people)
        for name in names
        for one in _WANTED
    ]
    rows = run_sessions(units, tell)
    same = [place for place, one in enumerate(units) if _is_held_again(one)][: 1 if quick else len(_BY_PROCESSES)]
    again = run_sessions([units[place]._replace(client=ProcessClient.name) for place in same], tell)
    return summarize(read_reviews(rows), read_reviews([rows[place] for place in same]), read_reviews(again))


def _is_held_again(unit: Unit) -> bool:
    return unit.task in _BY_PROCESSES and unit.condition == FLAT.name


def summarize(rows: Sequence[Review], same: Sequence[Review], again: Sequence[Review]) -> Result:
    """What the sessions come to; same, again: some of them in one process, and by processes of their own."""
    groups = {(one.name, AnswersClient.name): [row for row in rows if row.condition == one.name] for one in _WANTED}
    goals = [
        Goal(f"right and signed off when done, {one.name}, %", "at least", wanted,
             mean_over_tasks(groups[one.name, AnswersClient.name], right_when_done))
        for one, wanted in _WANTED.items()
    ]  # fmt: skip
    worst = max(mean_over_tasks(mine, wrong_when_done) for mine in groups.values())
    goals.append(Goal("signed off, yet wrong, most of all conditions, %", "at most", 1.0, worst))
    agree = share(sum(map(eq, same, again)), len(again))
    goals.append(Goal("sessions by processes of their own that come to the same, %", "at least", 100.0, agree))
    tables = (tell_ends(groups), tell_amiss([(AnswersClient.name, row) for row in rows]), tell_long(groups))
    return Result("terminal_sessions", "By files of answers alone", tables, tuple(goals), _NOTES)


_NOTES = (
    "*Answers alone*: the person demonstrates where `review --json` asks for it, and replies by `review --answers FILE "
    "--json`. Of a result that is wrong the file says which hulls rules should have selected, or which labels are "
    "wrong; where neither helps, no more than that it is wrong. Three people a task, on three decompositions.",
    "The commands run in one process; five sessions are held again by a process for each command, and must come to the "
    "same, act by act. A person's seconds are those of clicks: who types names of hulls takes longer.",
    "Who says *wrong* and no more, as all did before anything was changed, was measured once, by one person a task: "
    "under noisy labels 99.7% ended right and signed off, from none 83.6%. There, on chairs and dispensers, labels "
    "that nobody gave are thought of on all hulls far from the labelled ones, so most results are wrong, and *wrong* "
    "alone says nothing of labels. What is not known to be right needs review; 0.2% were signed off wrong.",
    "What would make these figures fail: a result that no further answer can make right, as nobody says what is right "
    "of it; such an asset needs review to the end, and is not counted as right.",
)
