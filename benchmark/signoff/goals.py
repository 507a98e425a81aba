"""What sign-offs are to reach, on generated and on real families."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from benchmark.report import Goal
from benchmark.signoff.calibration import calibrate
from benchmark.signoff.conditions import ERRS, NONE
from benchmark.signoff.outcomes import (
    Group,
    mean_over_tasks,
    person_time,
    right_when_done,
    share,
    share_signed_off,
    share_sooner,
    time_by_keys,
    wrong_when_done,
)
from benchmark.signoff.queue import Review
from benchmark.signoff.session_tables import (
    MANY,
    MUCH_WRONG,
    is_amiss,
    share_all_right,
    share_corrected_by_hand,
    share_early,
    share_early_wrong,
    share_named_first,
    share_right_at_once,
)
from benchmark.signoff.tables import pairs_of
from benchmark.study import FLAT, TRUE, Condition
from benchmark.study.condition import PROPAGATED, SYSTEMATIC, TELLING

RIGHT: Mapping[Condition, float] = {
    TRUE: 99.0, TELLING: 99.0, FLAT: 99.0, SYSTEMATIC: 99.0, PROPAGATED[2]: 99.0, NONE: 99.0, ERRS: 98.0
}  # fmt: skip
RIGHT_ON_REAL: Mapping[Condition, float] = {
    TRUE: 98.5, FLAT: 98.5, SYSTEMATIC: 98.5, PROPAGATED[2]: 96.0, NONE: 96.0
}  # fmt: skip
"""Percent right and signed off when done."""
_SECONDS: Mapping[Condition, float] = {TRUE: 45.0, FLAT: 60.0, PROPAGATED[2]: 200.0, NONE: 170.0}
_BY_KEYS: Mapping[Condition, float] = {PROPAGATED[2]: 110.0, NONE: 110.0}
"""Seconds by the mouse, and by keys and look-alikes."""
_EARLY = (FLAT, SYSTEMATIC, PROPAGATED[2], NONE)


def list_goals(groups: Sequence[Group], right: Mapping[Condition, float]) -> Iterator[Goal]:
    """right: what is asked of each condition; of those that were not run nothing is said."""
    by_name = {one.condition: one for one in groups}
    every = [row for one in groups for row in one.reviews]
    for condition, wanted in right.items():
        if one := by_name.get(condition.name):
            figure = mean_over_tasks(one.reviews, right_when_done)
            yield Goal(f"right and signed off when done, {condition.name}, %", "at least", wanted, figure)
    most = max(groups, key=lambda one: mean_over_tasks(one.reviews, wrong_when_done))
    told = f"signed off, yet wrong, most of all conditions ({most.condition}), %"
    yield Goal(told, "at most", 1.0, mean_over_tasks(most.reviews, wrong_when_done))
    least = min(groups, key=lambda one: mean_over_tasks(one.reviews, share_signed_off))
    told = f"signed off when done, least of all conditions ({least.condition}), %"
    yield Goal(told, "at least", 97.0, mean_over_tasks(least.reviews, share_signed_off))
    for condition, most_seconds in _SECONDS.items():
        if one := by_name.get(condition.name):
            seconds = mean_over_tasks(one.reviews, person_time)
            yield Goal(f"a person's time until done, {condition.name}, s", "at most", most_seconds, seconds)
    for condition, most_seconds in _BY_KEYS.items():
        if one := by_name.get(condition.name):
            seconds = mean_over_tasks(one.reviews, time_by_keys)
            yield Goal(f"… by keys and look-alikes, {condition.name}, s", "at most", most_seconds, seconds)
            if right is RIGHT_ON_REAL:
                told = f"sessions sooner than all by hand, {condition.name}, by keys and look-alikes, %"
                yield Goal(told, "at least", 75.0, share_sooner(one.reviews))
    told = f"sessions broken off, or with more than {MUCH_WRONG:.0f}% signed off wrong"
    yield Goal(told, "at most", 0.0, sum(map(is_amiss, every)))
    told = f"sessions with {MANY} or more results corrected one by one, %"
    yield Goal(told, "at most", 2.0, share_corrected_by_hand(every))
    if compared := [one for one in groups if one.before]:
        told = "conditions in which a person's time is less than by hand, %"
        yield Goal(told, "at least", 100.0, share(sum(map(_is_sooner, compared)), len(compared)))
    yield from _list_goals_of_probabilities(groups, every)


def _list_goals_of_probabilities(groups: Sequence[Group], every: Sequence[Review]) -> Iterator[Goal]:
    before, first = map(calibrate, pairs_of(groups))
    for one in groups:
        if one.openings and one.condition in (TELLING.name, FLAT.name):
            right = mean_over_tasks(one.openings, lambda row: share(row.right, row.possible))
            yield Goal(f"right before any question, {one.condition}, %", "at least", 88.0, right)
    yield Goal("calibration error at the first program, ten bins", "at most", 0.06, first.error)
    yield Goal("AUROC at the first program", "at least", 0.93, first.order)
    if before.count:
        yield Goal("calibration error, taught as before", "at most", 0.05, before.error)
        yield Goal("AUROC, taught as before", "at least", 0.91, before.order)
        told = "doubtful assets named at recall 0.95, taught as before: wrong, %"
        yield Goal(told, "at least", 50.0, 100 * before.precision)
    early = [row for one in groups if one.condition in {c.name for c in _EARLY} for row in one.reviews]
    if early:
        pooled = "labels noisy (flat), systematic, from 2 and none"
        yield Goal(f"signed off before any look, {pooled}, %", "at least", 35.0, share_early(early))
        yield Goal("of these wrong, %", "at most", 1.5, share_early_wrong(early))
    told = "wrong assets among the quarter that is named first, sessions with at most a fifth wrong, %"
    yield Goal(told, "at least", 85.0, share_named_first(every))
    if one_wrong := [row for row in every if row.misnamed == 1]:
        told = "one wrong label on what was demonstrated first: sessions"
        yield Goal(f"{told} with all others right at the first program, %", "at least", 45.0,
                   share_right_at_once(one_wrong))  # fmt: skip
        yield Goal(f"{told} with all right when done, %", "at least", 95.0, share_all_right(one_wrong))


def _is_sooner(one: Group) -> bool:
    by_hand = mean_over_tasks(one.before, lambda row: row.brute.seconds)
    return mean_over_tasks(one.reviews, person_time) < by_hand
