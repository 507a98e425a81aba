"""Tables of sessions by their labels and by what a person does them with: how they end, what was signed off early, and
which ones went wrong or took long."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import mean

from benchmark.report import Cell, Table
from benchmark.signoff.calibration import calibrate
from benchmark.signoff.outcomes import last, mean_over_tasks, person_time, right_when_done, share, wrong_when_done
from benchmark.signoff.queue import DONE, Review

MANY = 8
"""Results corrected one by one, from which on a session counts as one that goes the long way."""
MUCH_WRONG = 5.0
"""Percent of a family signed off wrong, above which a session is listed."""
_LONG = 2.0  # times the mean of its condition
_FEW_WRONG = 0.2  # a share of wrong assets, up to which a list that names a quarter can name them all
Groups = Mapping[tuple[str, str], Sequence[Review]]
"""Sessions by the name of the condition and of the client."""


def tell_ends(groups: Groups) -> Table:
    """How sessions stand when they are over."""
    columns = (
        "condition",
        "by",
        "sessions",
        "right and signed off when done, %",
        "signed off, yet wrong, %",
        "excluded, %",
        "needs review, %",
        "until done, s",
        "not ended as done",
        "results corrected one by one",
        f"sessions with {MANY} or more, %",
    )
    return Table("When done", columns, tuple(_end_row(*key, rows) for key, rows in groups.items()))


def _end_row(condition: str, client: str, rows: Sequence[Review]) -> tuple[Cell, ...]:
    return (
        condition,
        client,
        len(rows),
        mean_over_tasks(rows, right_when_done),
        mean_over_tasks(rows, wrong_when_done),
        mean_over_tasks(rows, lambda row: share(len(row.aside), row.assets)),
        mean_over_tasks(rows, lambda row: share(last(row).held, row.assets)),
        mean_over_tasks(rows, person_time),
        sum(row.ended != DONE for row in rows),
        mean(map(count_corrected, rows)),
        share_corrected_by_hand(rows),
    )


def count_corrected(row: Review) -> int:
    """Results that the person corrected one by one."""
    return row.acts.get("correction", 0)


def share_corrected_by_hand(rows: Sequence[Review]) -> float:
    """Percent of the sessions in which many results were corrected one by one."""
    return share(sum(count_corrected(row) >= MANY for row in rows), len(rows))


def share_early(rows: Sequence[Review]) -> float:
    """Percent of the assets nobody demonstrated that are signed off when there is the first program."""
    return share(sum(row.early for row in rows), sum(row.unseen for row in rows))


def share_early_wrong(rows: Sequence[Review]) -> float:
    """Percent of these that are not right."""
    early = sum(row.early for row in rows)
    return share(sum(row.early_wrong for row in rows), early) if early else 0.0


def tell_early(groups: Groups) -> Table:
    """What the first program's probabilities are worth, and what is signed off by them before any look."""
    columns = ("condition", "by", "assets", "right, %", "calibration error", "AUROC",
               "signed off before any look, %", "of these wrong")  # fmt: skip
    every = [(client, row) for (_, client), rows in groups.items() for row in rows]
    named = [(*key, rows) for key, rows in groups.items()]
    whole = [("all", client, [row for one, row in every if one == client]) for client in dict(every)]
    lines = tuple(_early_row(*one) for one in [*named, *whole])
    return Table("The first program: assets that nobody demonstrated", columns, lines)


def _early_row(condition: str, client: str, rows: Sequence[Review]) -> tuple[Cell, ...]:
    found = calibrate([pair for row in rows for pair in row.first])
    wrong = sum(row.early_wrong for row in rows)
    return condition, client, found.count, 100 * found.right, found.error, found.order, share_early(rows), wrong


def share_named_first(rows: Sequence[Review]) -> float:
    """Percent of the wrong assets that are among the least probable quarter at the first program, over the sessions in
    which some are wrong, and at most a fifth."""
    named = wrong = 0
    for row in rows:
        amiss = sum(not right for _, right in row.first)
        if 0 < amiss <= _FEW_WRONG * len(row.first):
            wrong += amiss
            named += sum(not right for _, right in sorted(row.first)[: -(-len(row.first) // 4)])
    return share(named, wrong)


def tell_misnamed(groups: Groups) -> Table:
    """Sessions in which exactly one label of the meshes demonstrated first was wrong."""
    columns = ("condition", "by", "sessions", "all others right at the first program, %", "all right when done, %")
    rows: list[tuple[Cell, ...]] = []
    for key, some in groups.items():
        if mine := [row for row in some if row.misnamed == 1]:
            rows.append((*key, len(mine), share_right_at_once(mine), share_all_right(mine)))
    return Table("One wrong label on what was demonstrated first", columns, tuple(rows))


def share_right_at_once(rows: Sequence[Review]) -> float:
    """Percent of the sessions whose first program gets all other assets right."""
    return share(sum(all(right for _, right in row.first) for row in rows), len(rows))


def share_all_right(rows: Sequence[Review]) -> float:
    """Percent of the sessions in which all assets that can be right are, and are signed off."""
    return share(sum(last(row).sure == row.possible for row in rows), len(rows))


def tell_amiss(sessions: Sequence[tuple[str, Review]]) -> Table:
    """Sessions that did not end as done, or with much signed off wrong; each with what it was done with."""
    columns = ("task", "condition", "by", "ended", "s", "right, %", "wrong, %", "excluded", "corrected")
    rows = [
        (one.task, one.condition, client, one.ended, person_time(one), right_when_done(one), wrong_when_done(one),
         len(one.aside), count_corrected(one))
        for client, one in sessions
        if is_amiss(one)
    ]  # fmt: skip
    return Table(f"Sessions not done, or with more than {MUCH_WRONG:.0f}% signed off wrong", columns, tuple(rows))


def is_amiss(row: Review) -> bool:
    """Whether a session was broken off, or ended with much signed off wrong."""
    return row.ended != DONE or wrong_when_done(row) > MUCH_WRONG


def tell_long(groups: Groups) -> Table:
    """Sessions that took more than twice the mean of their condition, and what they took it for."""
    rows: list[tuple[Cell, ...]] = []
    for (condition, client), some in groups.items():
        usual = mean_over_tasks(some, person_time)
        rows += [
            (row.task, condition, client, person_time(row), usual, _explain(row, some))
            for row in some
            if person_time(row) > _LONG * usual
        ]
    return Table("Sessions that took more than twice the mean", ("task", "condition", "by", "s", "mean, s", "why"),
                 tuple(rows))  # fmt: skip


def _explain(row: Review, usual: Sequence[Review]) -> str:
    """The two kinds of acts that took most beyond what they usually take."""
    extra = {what: taken - mean(one.seconds.get(what, 0.0) for one in usual) for what, taken in row.seconds.items()}
    most = sorted(extra, key=lambda what: -extra[what])[:2]
    return "; ".join(f"{row.acts.get(what, 0)} × {what}, {extra[what]:+.0f} s" for what in most)
