"""How long a person takes until every asset of a family of 25 is right, and whether the tool knows which are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

from benchmark.journal import run_units
from benchmark.report import Goal, Result, Tell
from benchmark.signoff.before import read_before
from benchmark.signoff.calibration import calibrate
from benchmark.signoff.conditions import ASKED, ERRS, MAKE, NONE, PEOPLE, list_benches, list_tasks, open_bench_of
from benchmark.signoff.opening import FirstLook, open_review
from benchmark.signoff.outcomes import (
    Group,
    group,
    mean_over_tasks,
    person_time,
    right_when_done,
    share,
    share_signed_off,
    wrong_when_done,
)
from benchmark.signoff.queue import CAP, Review
from benchmark.signoff.sessions import Unit, read_reviews, run_sessions
from benchmark.signoff.tables import list_tables, pairs_of
from benchmark.study import CONDITIONS, FLAT, TRUE, Condition
from benchmark.study.condition import PROPAGATED, SYSTEMATIC, TELLING

_QUICK = ("cup", (TRUE, FLAT))
"""The category and the conditions of a quick run, which has one person."""


def measure(tell: Tell, quick: bool) -> Result:
    """Sign all families off under all conditions."""
    names = [name for name in list_tasks() if not quick or name.startswith(_QUICK[0])]
    found = run(names, _QUICK[1] if quick else ASKED, tell, few=quick)
    return summarize("review", "A family signed off", *found, before=True)


def run(
    names: Sequence[str], conditions: Sequence[Condition], tell: Tell, folder: str | None = None, few: bool = False
) -> tuple[list[Review], list[FirstLook]]:
    """The sessions of some tasks by the reported people; folder: on families to tune on, by people to tune on.

    few: by one of them.
    """
    units = [
        Unit(name, one.name, seed, folder)
        for name in names
        for one in conditions
        for seed, _ in list_benches(name, one, folder, few)
    ]
    openings = run_units("signoff-opening", open_family_of, [unit[:4] for unit in units], tell)
    return read_reviews(run_sessions(units, tell)), list(map(FirstLook.of_json, openings))


def open_family_of(name: str, condition: str, seed: int, folder: str | None) -> dict[str, Any]:
    """How a family stands before any question."""
    one = CONDITIONS[condition]
    return asdict(open_review(open_bench_of(name, one, seed, folder), one, seed))


def summarize(
    part: str, title: str, reviews: Sequence[Review], openings: Sequence[FirstLook], *, before: bool
) -> Result:
    """What sessions come to; before: beside the tool as it was."""
    groups = group([one.name for one in ASKED], reviews, openings, read_before() if before else ())
    return Result(
        part,
        title,
        list_tables(groups),
        tuple(_list_goals(groups)),
        _NOTES,
        tuple(_summarize_session(row) for row in reviews),
    )


def _summarize_session(row: Review) -> dict[str, Any]:
    """All of it but the probabilities, which the tables are about."""
    return {key: value for key, value in asdict(row).items() if key != "first"}


def _list_goals(groups: Sequence[Group]) -> Iterator[Goal]:
    by_name = {one.condition: one for one in groups}
    for condition in (TELLING, FLAT):
        if one := by_name.get(condition.name):
            right = mean_over_tasks(one.openings, lambda row: share(row.right, row.possible))
            yield Goal(f"right before any question, {condition.name}, %", "at least", 88.0, right)
    for condition, wanted in ((TELLING, 98.0), (FLAT, 98.0), (SYSTEMATIC, 97.0), (PROPAGATED[2], 98.0), (ERRS, 95.0)):
        if one := by_name.get(condition.name):
            right = mean_over_tasks(one.reviews, right_when_done)
            yield Goal(f"right and signed off when done, {condition.name}, %", "at least", wanted, right)
    least = min(groups, key=lambda one: mean_over_tasks(one.reviews, share_signed_off))
    told = f"signed off when done, least of all conditions ({least.condition}), %"
    yield Goal(told, "at least", 97.0, mean_over_tasks(least.reviews, share_signed_off))
    most = max(groups, key=lambda one: mean_over_tasks(one.reviews, wrong_when_done))
    told = f"signed off, yet wrong, most of all conditions ({most.condition}), %"
    yield Goal(told, "at most", 1.0, mean_over_tasks(most.reviews, wrong_when_done))
    for condition, most_seconds in ((TRUE, 60.0), (TELLING, 100.0), (FLAT, 100.0), (NONE, 200.0)):
        if one := by_name.get(condition.name):
            seconds = mean_over_tasks(one.reviews, person_time)
            yield Goal(f"a person's time until done, {condition.name}, s", "at most", most_seconds, seconds)
    if compared := [one for one in groups if one.before]:
        sooner = sum(_is_sooner(one) for one in compared)
        told = "conditions in which that is less than by hand, %"
        yield Goal(told, "at least", 100.0, share(sooner, len(compared)))
    found = calibrate(pairs_of(groups)[0])
    yield Goal("calibration error before any question, ten bins", "at most", 0.05, found.error)
    yield Goal("AUROC before any question", "at least", 0.9, found.order)
    yield Goal("doubtful assets named at recall 0.95: wrong, %", "at least", 50.0, 100 * found.precision)


def _is_sooner(one: Group) -> bool:
    by_hand = mean_over_tasks(one.before, lambda row: row.brute.seconds)
    return mean_over_tasks(one.reviews, person_time) < by_hand


_NOTES = (
    f"Families of 25 different assets at one decomposition; {PEOPLE} people, one for each of the decompositions. An "
    "asset is *right* if its rules select what the reference selects under true labels, and the edited mesh meets the "
    "criterion. *Possible*: the reference itself meets it there under true labels; shares of right assets are of "
    "these, as on the others no edit is right: there, a result that is as the reference's is neither right nor wrong. "
    "Means over people, then over tasks.",
    "*When done* counts what is right and signed off; what is held or set aside is not right.",
    "*As it was*: the tool before it had a queue, frozen in `benchmark/signoff/before.json` with the command and the "
    "commit that made it. *Then by hand*: that person glances at all results and mends what differs in each wrong one, "
    "at the prices at which the queue's person mends; *anew*: makes the whole edit again. By hand, who errs leaves "
    "hulls out and overlooks results; the people of *as it was* err in answers and confirmations only, those of the "
    "queue in all acts, demonstrations too.",
    f"Sessions are broken off after {CAP:.0f} s; their time counts as it stands then, so it is a lower bound, and what "
    "is held then is not right.",
    "*Before any question*: the task is taught as before, on the labels as the tool takes them now, until all of a "
    "dozen results look right; the tool is told so. *The first program*: after the demonstrations that begin a session "
    "of the queue. The probabilities are of possible assets that nobody showed or looked at; the goals are about all "
    "conditions together.",
    "A change of protocol: until this run the tool was not told of that dozen, and as it trusts no program of which "
    "nobody has seen a result (decision 0034), it could not say more than 92% of any asset.",
    "The person of the queue does all in a project on disk, by the methods of `Project`: shows an asset, and another "
    "one while a rule has had nothing to do, replies to each question by what is true, says which results are wrong, "
    "and shows the edit there. Where a mesh is turned wrongly, or no program fits what was shown on it, the person "
    "looks through its labels one by one, and corrects those that are wrong; where that does not help, the "
    "demonstration is taken back. What is set aside or flagged counts as not right. Where no label is there at the "
    "start, the hulls of a mesh that is shown are named by hand; after labels by hand come those by consensus.",
    "What would make these figures fail: labels that are wrong alike on look-alike hulls of most assets, which no vote "
    "finds; a rule about parts that few assets have, which no demonstration shows; a criterion that a right selection "
    "does not meet, which the tool cannot know of.",
    f"Nothing is tuned on these families: `{MAKE}` makes others of 25, and `python -m benchmark.signoff tune FOLDER` "
    "measures the same on them.",
)
