"""How long a person takes until every asset of a family of 25 is right, and whether the tool knows which are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from benchmark.journal import run_units
from benchmark.report import Result, Tell
from benchmark.signoff.before import read_before
from benchmark.signoff.client import Client
from benchmark.signoff.conditions import ASKED, MAKE, PEOPLE, list_benches, list_tasks, open_bench_of
from benchmark.signoff.goals import RIGHT, RIGHT_ON_REAL, list_goals
from benchmark.signoff.opening import FirstLook, open_review
from benchmark.signoff.outcomes import group
from benchmark.signoff.paper import describe_gaps, tell_paper
from benchmark.signoff.queue import CAP, Review
from benchmark.signoff.session_tables import tell_amiss, tell_early, tell_ends, tell_long, tell_misnamed
from benchmark.signoff.sessions import Unit, read_reviews, run_sessions
from benchmark.signoff.tables import list_tables
from benchmark.study import CONDITIONS, FLAT, TRUE, Condition

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
    people = {
        (name, one.name): [seed for seed, _ in list_benches(name, one, folder, few)]
        for name in names
        for one in conditions
    }
    units = [
        Unit(name, one, some[place], folder)
        for place in range(max(map(len, people.values())))  # so that a run that stops has had some people whole
        for (name, one), some in people.items()
        if place < len(some)
    ]
    reviews = read_reviews(run_sessions(units, tell))
    ones = [unit[:4] for unit in units if unit.seed == people[unit.task, unit.condition][0]]
    return reviews, list(map(FirstLook.of_json, run_units("signoff-opening", open_family_of, ones, tell)))


def open_family_of(name: str, condition: str, seed: int, folder: str | None) -> dict[str, Any]:
    """How a family stands before any question."""
    one = CONDITIONS[condition]
    return asdict(open_review(open_bench_of(name, one, seed, folder), one, seed))


def summarize(
    part: str, title: str, reviews: Sequence[Review], openings: Sequence[FirstLook], *, before: bool
) -> Result:
    """What sessions come to; before: beside the tool as it was."""
    groups = group([one.name for one in ASKED], reviews, openings, read_before() if before else ())
    by_client = {(one.condition, Client.name): one.reviews for one in groups}
    more = (
        tell_ends(by_client),
        tell_early(by_client),
        tell_misnamed(by_client),
        tell_amiss([(Client.name, row) for row in reviews]),
        tell_long(by_client),
    )
    paper = tell_paper({one.condition: one.reviews for one in groups}) if part == "review" else None
    return Result(
        part,
        title,
        (*([paper] if paper else []), *list_tables(groups), *more),
        tuple(list_goals(groups, RIGHT_ON_REAL if part == "real_families" else RIGHT)),
        _NOTES,
        tuple(_summarize_session(row) for row in reviews),
        describe_gaps(paper) if paper else "",
    )


def _summarize_session(row: Review) -> dict[str, Any]:
    """All of it but the probabilities, which the tables are about."""
    return {key: value for key, value in asdict(row).items() if key != "first"}


_NOTES = (
    f"Families of 25 different assets at one decomposition; {PEOPLE} people, one for each of the decompositions. An "
    "asset is *right* if its rules select what the reference selects under true labels, and the edited mesh meets the "
    "criterion. *Possible*: the reference itself meets it there under true labels; shares of right assets are of "
    "these, as on the others no edit is right: there, a result that is as the reference's is neither right nor wrong. "
    "Means over people, then over tasks.",
    "*When done* counts what is right and signed off; what needs review or is excluded is not right.",
    "*As it was*: the tool before it had a queue, frozen in `benchmark/signoff/before.json` with the command and the "
    "commit that made it. *Then by hand*: that person glances at all results and mends what differs in each wrong one, "
    "at the prices at which the queue's person mends; *anew*: makes the whole edit again. By hand, who errs leaves "
    "hulls out and overlooks results; the people of *as it was* err in answers and confirmations only, those of the "
    "queue in all acts, demonstrations too.",
    f"Sessions are broken off after {CAP:.0f} s; their time counts as it stands then, so it is a lower bound, and what "
    "needs review then is not right.",
    "*Before any question*, by the first of the people: the task is taught as before, on the labels as the tool takes "
    "them now, until all of a dozen results look right; the tool is told so. *The first program*: after the "
    "demonstrations that begin a session of the queue. The probabilities are of possible assets that nobody showed or "
    "looked at; the goals are about all conditions together.",
    "The person of the queue does all in a project on disk, by the methods of `Project`: shows an asset, and another "
    "one while a rule has had nothing to do, replies to each question by what is true, and says which results are "
    "wrong, and which hulls the rules should have taken there; where a mesh is turned wrongly, or no program fits what "
    "was shown on it, which labels are wrong, after a look at each; where that does not help, the demonstration is "
    "taken back. Where no label is there at the start, the hulls of a mesh that is shown are named by hand; after "
    "labels by hand come those that are propagated.",
    "*k* beside the paper counts demonstrations and corrected results, and in the rows below answers about the program "
    "too, as it does without the queue. A task is right if each person ends with every asset that can be right "
    "signed off, and none that is not; the paper and the sessions without the queue ask for the program alone, on "
    "labels as they come.",
    "*One wrong label*: of the labels as they came, exactly one was wrong on the meshes that were demonstrated before "
    "the first program; elsewhere as many as the condition has, 8% where they are noisy.",
    "A change of protocol: until this run all sessions but those of *Through the product, before anything was changed* "
    "went through another implementation of replies, by one person a task; these go through `Project`, by three. "
    "Goals are those of the third edition.",
    "Not reached, and why. *Before any look*: of the assets that are said to be right at 98% one in 500 is wrong, of "
    "those at 95% one in 40; a lower threshold would sign a fifth off, and more of it wrong than is allowed. "
    "*Seconds*: under true labels the demonstration takes 23 of them, answers about the program 11, results looked at "
    "10. *From 2 and none*: labels that are carried from one or two meshes are wrong alike on look-alike hulls; a "
    "label that these meshes lack is then thought of on all hulls that are far from theirs, so nothing is sure; and a "
    "group is worth its own hulls alone, though what is said of them is carried to others, so that results are "
    "corrected one by one instead. *A person who errs*: a picture or a hull taken by mistake, which nothing "
    "contradicts, makes a longer rule that is right wherever anybody looked. *One wrong label*: the first rule is "
    "bent to it; the questions that follow find it.",
    "What would make these figures fail: labels that are wrong alike on look-alike hulls of most assets, which no vote "
    "finds; a rule about parts that few assets have, which no demonstration shows; a criterion that a right selection "
    "does not meet, which the tool cannot know of.",
    f"Nothing is tuned on these families: `{MAKE}` makes others of 25, and `python -m benchmark.signoff tune FOLDER` "
    "measures the same on them.",
)
