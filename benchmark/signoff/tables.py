"""The tables of what it takes to sign families off."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from functools import partial

from benchmark.report import Cell, Table
from benchmark.signoff.calibration import Calibration, Pairs, calibrate
from benchmark.signoff.outcomes import (
    TIMES,
    Group,
    brute_of,
    last,
    mean_over_tasks,
    person_time,
    right_before,
    right_by_hand,
    right_by_queue,
    right_when_done,
    share,
    share_signed_off,
    share_sooner,
    spread_over_tasks,
    time_by_keys,
    wrong_when_done,
)
from benchmark.signoff.queue import DONE, Review
from benchmark.study.keystrokes import BY_KEYS, PRICES

CURVES = "Edits right after so many seconds of a person, %"
QUEUE, BEFORE, BY_HAND, REFERENCE = "the queue", "as it was", "then by hand", "the reference, same labels"


def list_tables(groups: Sequence[Group]) -> tuple[Table, ...]:
    """All of them, in the order of the page."""
    return (
        _tell_right(groups),
        _tell_time(groups),
        _tell_acts(groups),
        _tell_by_keys(groups),
        _tell_calibration(groups),
        _tell_curves(groups),
        *(_tell_tasks(one) for one in groups if "flat" in one.condition and "errs" not in one.condition),
        _tell_ends(groups),
        Table("Prices of the acts, modelled", ("act", "s"), tuple(PRICES.items())),
        Table("Prices by keys and look-alikes", ("act", "s"), tuple(BY_KEYS.items())),
    )


def _tell_right(groups: Sequence[Group]) -> Table:
    columns = (
        "condition",
        "sessions",
        "possible, %",
        "before the queue: right, %",
        "the reference, same labels",
        "before any question: right, %",
        "when done: right, %",
        "of all assets, %",
        "signed off, %",
        "excluded, %",
        "signed off, yet wrong, %",
    )
    return Table("Edits that are right", columns, tuple(map(_right_row, groups)))


def _right_row(one: Group) -> tuple[Cell, ...]:
    return (
        one.condition,
        len(one.reviews),
        mean_over_tasks(one.reviews, lambda row: share(row.possible, row.assets)),
        _format_known(
            one.before, lambda: mean_over_tasks(one.before, lambda row: share(last(row).right, row.possible))
        ),
        _format_known(one.before, lambda: mean_over_tasks(one.before, lambda row: share(row.reference, row.possible))),
        _format_known(one.openings, lambda: mean_over_tasks(one.openings, lambda row: share(row.right, row.possible))),
        mean_over_tasks(one.reviews, right_when_done),
        mean_over_tasks(one.reviews, lambda row: share(last(row).sure, row.assets)),
        mean_over_tasks(one.reviews, share_signed_off),
        mean_over_tasks(one.reviews, lambda row: share(len(row.aside), row.assets)),
        mean_over_tasks(one.reviews, wrong_when_done),
    )


def _format_known(rows: Sequence[object], figure: Callable[[], Cell]) -> Cell:
    return figure() if rows else "–"


def _tell_time(groups: Sequence[Group]) -> Table:
    columns = (
        "condition",
        "until done, s",
        "done within the cap, %",
        "as it was, s",
        "then by hand, s",
        "each made anew, s",
        "right by hand, %",
        "sessions sooner than by hand, %",
        "as it was, settled: wrong, %",
    )
    return Table("A person's time, modelled", columns, tuple(map(_time_row, groups)))


def _time_row(one: Group) -> tuple[Cell, ...]:
    brute = brute_of(one)
    pairs = [(row, brute[row.task, row.seed]) for row in one.reviews if (row.task, row.seed) in brute]
    sooner = sum(person_time(row) < other.brute.seconds for row, other in pairs)
    return (
        one.condition,
        "{:.0f} ± {:.0f}".format(*spread_over_tasks(one.reviews, person_time)),
        share(sum(row.ended == DONE for row in one.reviews), len(one.reviews)),
        _format_known(one.before, lambda: mean_over_tasks(one.before, lambda row: last(row).seconds)),
        _format_known(one.before, lambda: mean_over_tasks(one.before, lambda row: row.brute.seconds)),
        _format_known(one.before, lambda: mean_over_tasks(one.before, lambda row: row.anew)),
        _format_known(
            one.before, lambda: mean_over_tasks(one.before, lambda row: share(row.brute.right, row.possible))
        ),
        _format_known(pairs, lambda: share(sooner, len(pairs))),
        _format_known(one.before, lambda: mean_over_tasks(one.before, lambda row: share(last(row).wrong, row.assets))),
    )


def _tell_acts(groups: Sequence[Group]) -> Table:
    kinds = sorted({what for one in groups for row in one.reviews for what in row.acts})
    rows = tuple((one.condition, *(_tell_act(one, kind) for kind in kinds)) for one in groups)
    return Table("What a person does, a family: how often, and seconds", ("condition", *kinds), rows)


def _tell_act(one: Group, kind: str) -> str:
    count = mean_over_tasks(one.reviews, lambda row: row.acts.get(kind, 0))
    return f"{count:.1f}: {mean_over_tasks(one.reviews, lambda row: row.seconds.get(kind, 0.0)):.0f} s"


def _tell_by_keys(groups: Sequence[Group]) -> Table:
    kinds = sorted({what for one in groups for row in one.reviews for what in row.by_keys})
    columns = ("condition", "until done", "each asset by hand", "sessions sooner than that, %", *kinds)
    return Table("Seconds by keys and look-alikes", columns, tuple(_by_keys_row(one, kinds) for one in groups))


def _by_keys_row(one: Group, kinds: Sequence[str]) -> tuple[Cell, ...]:
    done = mean_over_tasks(one.reviews, time_by_keys)
    hand = mean_over_tasks(one.reviews, lambda row: row.all_by_hand)
    spent = (mean_over_tasks(one.reviews, partial(_seconds_of, kind)) for kind in kinds)
    return (one.condition, done, hand, share_sooner(one.reviews), *spent)


def _seconds_of(kind: str, row: Review) -> float:
    return row.by_keys.get(kind, 0.0)


def _tell_calibration(groups: Sequence[Group]) -> Table:
    columns = (
        "condition",
        "when",
        "assets",
        "right, %",
        "calibration error",
        "AUROC",
        "Brier",
        "of a constant",
        "named at recall 0.95",
        "of these wrong, %",
    )
    rows = [
        (name, when, *_calibration_row(calibrate(pairs)))
        for name, *both in [*((one.condition, *pairs_of([one])) for one in groups), ("all", *pairs_of(groups))]
        for when, pairs in zip(("taught as before", "the first program"), both, strict=True)
        if pairs
    ]
    return Table("The probabilities of assets that nobody showed", columns, tuple(rows))


def pairs_of(groups: Sequence[Group]) -> tuple[Pairs, Pairs]:
    """The probabilities of assets that nobody showed, before any question, and when there was the first program."""
    openings = [pair for one in groups for row in one.openings for pair in row.pairs]
    return openings, [pair for one in groups for row in one.reviews for pair in row.first]


def _calibration_row(one: Calibration) -> tuple[Cell, ...]:
    return (
        one.count,
        100 * one.right,
        one.error,
        one.order,
        one.brier,
        one.constant,
        one.named,
        100 * one.precision if one.named else "–",
    )


def _tell_curves(groups: Sequence[Group]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for one in groups:
        at = [float(seconds) for seconds in TIMES]
        queue = (mean_over_tasks(one.reviews, partial(right_by_queue, t)) for t in at)
        rows.append((one.condition, QUEUE, *queue))
        if one.before:
            before = (mean_over_tasks(one.before, partial(right_before, t)) for t in at)
            by_hand = (mean_over_tasks(one.before, partial(right_by_hand, t)) for t in at)
            reference = mean_over_tasks(one.before, lambda row: share(row.reference, row.possible))
            rows += [(one.condition, BEFORE, *before), (one.condition, BY_HAND, *by_hand)]
            rows.append((one.condition, REFERENCE, *[reference] * len(TIMES)))
    return Table(CURVES, ("condition", "by", *map(str, TIMES)), tuple(rows))


def _tell_tasks(one: Group) -> Table:
    brute = brute_of(one)
    columns = ("task", "possible", "right when done, %", "signed off, yet wrong, %", "excluded", "s", "by hand, s")
    rows: list[tuple[Cell, ...]] = []
    for name in dict.fromkeys(row.task for row in one.reviews):
        mine = [row for row in one.reviews if row.task == name]
        hand = [brute[row.task, row.seed].brute.seconds for row in mine if (row.task, row.seed) in brute]
        rows.append(
            (
                name,
                sum(row.possible for row in mine) / len(mine),
                mean_over_tasks(mine, right_when_done),
                mean_over_tasks(mine, wrong_when_done),
                sum(len(row.aside) for row in mine) / len(mine),
                mean_over_tasks(mine, person_time),
                sum(hand) / len(hand) if hand else "–",
            )
        )
    return Table(f"Task by task, {one.condition}", columns, tuple(rows))


def _tell_ends(groups: Sequence[Group]) -> Table:
    ends = sorted({row.ended for one in groups for row in one.reviews}, key=lambda end: (end != DONE, end))
    counts = [Counter(row.ended for row in one.reviews) for one in groups]
    rows: list[tuple[Cell, ...]] = []
    for one, count in zip(groups, counts, strict=True):
        rows.append((one.condition, *(count[end] for end in ends)))
    return Table("How sessions end", ("condition", *ends), tuple(rows))
