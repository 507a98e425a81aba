"""Programs that are learned and signed off on meshes with hulls that span parts, as they are and rebuilt, beside
meshes whose solids were decomposed one by one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np

from benchmark.assets import MERGED, SEPARATE, Sample, samples
from benchmark.evaluation.sessions import QUICK
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.signoff.outcomes import (
    last,
    mean_over_tasks,
    person_time,
    right_when_done,
    share,
    share_signed_off,
    wrong_when_done,
)
from benchmark.signoff.queue import CAP, DONE, Review, sign_off
from benchmark.spanning.course import SURE, warm_cache
from benchmark.spanning.family import BY_PIECES, KNOWN, choose_known, open_family, replace_hulls
from benchmark.study import REPORTED, Bench
from benchmark.study.condition import PROPAGATED
from benchmark.study.desk import Start
from benchmark.tasks import Task, task, tasks
from meshforge.label_model import SpanPosterior
from meshforge.symbolic import Label

PartLabels = Mapping[str, Label]
"""Labels of hulls of rebuilt assets, by name."""
NO_LABELS: PartLabels = MappingProxyType({})
FINE = SEPARATE[-1]
"""The set that is compared with."""
AS_IT_IS, REBUILT = "as it is", "rebuilt"
MOST_BELOW = 5.0
"""How far right edits may be below those on the fine set [% of the assets]."""
LEVEL = "medium"
"""The difficulty of the tasks, one of each category."""
_CONDITION = PROPAGATED[KNOWN]
_COLUMNS = (
    "set",
    "hulls that span",
    "tasks",
    "possible, %",
    "the reference, same labels, %",
    "when done: right, %",
    "of all assets, %",
    "signed off, %",
    "signed off, yet wrong, %",
    "done within the cap, %",
    "a person's time, s",
)
_TASK_COLUMNS = ("set", "hulls that span", "task", "hulls", "possible", "right and signed off", "wrong", "s")


def measure(tell: Tell, quick: bool) -> Result:
    """Sign a family of each category off on each set."""
    names = [one.name for one in list_chosen() if not quick or one.category == QUICK]
    rows = sign_sets(names, tell)
    groups = list(dict.fromkeys((row["set"], row["spanning"]) for row in rows))
    return Result(
        "programs",
        "Hulls that span parts: programs learned",
        (
            Table(
                f"Signed off, labels propagated from {KNOWN} assets",
                _COLUMNS,
                tuple((*group, *_list_figures(_reviews_of(rows, *group))) for group in groups),
            ),
            Table("Task by task, of 25 assets", _TASK_COLUMNS, tuple(map(_list_task, rows))),
        ),
        tuple(list_goals(rows)),
        _NOTES,
    )


def list_chosen() -> list[Task]:
    """The task of each category that is learned."""
    return [one for one in tasks() if one.difficulty == LEVEL]


def sign_sets(names: Sequence[str], tell: Tell) -> list[dict[str, Any]]:
    """A row for each task on each set: the set, what is done with hulls that span, how many hulls there are then, and
    the `Review` as JSON."""
    warm_cache([task(name).category for name in names], tell, False)
    units = [(name, setting) for setting in (FINE, *MERGED) for name in names]
    return [row for rows in run_units("spanning-learned", sign_set, units, tell) for row in rows]


def sign_set(name: str, setting: str) -> list[dict[str, Any]]:
    """A task signed off on a set, whose hulls that span are left, split and rebuilt; the fine set is left as it is."""
    one = task(name)
    if setting == FINE:
        meshes = {AS_IT_IS: [(sample, NO_LABELS) for sample in samples(one.category, False, (FINE,))]}
    else:
        family = open_family(one.category, setting)
        places = list(enumerate(family.samples))
        meshes = {
            AS_IT_IS: [(sample, NO_LABELS) for sample in family.samples],
            REBUILT: [rebuild_sample(sample, family.infer(place, BY_PIECES)) for place, sample in places],
        }
    return [
        {
            "set": setting,
            "spanning": spanning,
            "hulls": sum(len(sample.mesh.hulls) for sample, _ in rows),
            "review": asdict(sign_off(open_bench(one, rows), _CONDITION, REPORTED[0])),
        }
        for spanning, rows in meshes.items()
    ]


def open_bench(one: Task, rows: Sequence[tuple[Sample, PartLabels]]) -> Bench:
    """A task with a family of which those assets are labelled by hand by whose labels hulls that span are found.

    rows: the meshes, with the labels that hulls of rebuilt assets have from that.
    """
    known = tuple(rows[place][0].name for place in sorted(choose_known(len(rows))))
    return Bench(one, [sample for sample, _ in rows], Start(known, {sample.name: labels for sample, labels in rows}))


def rebuild_sample(sample: Sample, posterior: SpanPosterior) -> tuple[Sample, PartLabels]:
    """The mesh with all hulls rebuilt part by part where one likely spans, all hulls with their true labels; and those
    of the new hulls, as `prepare` writes them. posterior: of which the asset is the first."""
    if posterior.chances_of(0).max() < SURE:
        return sample, NO_LABELS
    made = posterior.rebuild(0, np.arange(len(sample.mesh.hulls)))
    rebuilt = replace_hulls(sample, [one.shape for one in made])
    rows = zip(rebuilt.mesh.hulls, made, strict=True)
    return rebuilt, {hull.name: Label(one.label, round(one.share, 3), "rebuild") for hull, one in rows}


def _reviews_of(rows: Sequence[dict[str, Any]], setting: str, spanning: str) -> list[Review]:
    return [Review.of_json(row["review"]) for row in rows if (row["set"], row["spanning"]) == (setting, spanning)]


def _right_of_all(row: Review) -> float:
    """Percent of all assets that are right and signed off in the end."""
    return share(last(row).sure, row.assets)


def _list_figures(reviews: Sequence[Review]) -> tuple[Cell, ...]:
    mean = partial(mean_over_tasks, reviews)
    return (
        len(reviews),
        mean(lambda row: share(row.possible, row.assets)),
        mean(lambda row: share(row.reference, row.possible)),
        mean(right_when_done),
        mean(_right_of_all),
        mean(share_signed_off),
        mean(wrong_when_done),
        share(sum(row.ended == DONE for row in reviews), len(reviews)),
        mean(person_time),
    )


def _list_task(row: dict[str, Any]) -> tuple[Cell, ...]:
    review = Review.of_json(row["review"])
    end = last(review)
    return row["set"], row["spanning"], review.task, row["hulls"], review.possible, end.sure, end.wrong, end.seconds


def list_goals(rows: Sequence[dict[str, Any]]) -> Iterator[Goal]:
    """How far each set is below the fine one."""
    fine = _reviews_of(rows, FINE, AS_IT_IS)
    figures: tuple[tuple[str, Callable[[Review], float]], ...] = (
        ("of the possible", right_when_done),
        ("of all assets", _right_of_all),
    )
    for setting in MERGED:
        reviews = _reviews_of(rows, setting, REBUILT)
        for told, figure in figures:
            below = mean_over_tasks(fine, figure) - mean_over_tasks(reviews, figure)
            what = f"{setting}, {REBUILT}: right and signed off, {told}, below the {FINE} set, %"
            yield Goal(what, "at most", MOST_BELOW, below)


_NOTES = (
    f"Tasks of the difficulty *{LEVEL}*, one of each category, each with a family of 25 assets, signed off by one "
    f"person of `signoff.md` (*{_CONDITION.name}*), whose figures these are: an asset is *right* if its rules select "
    "what the reference selects under true labels, and the edited mesh meets the criterion; *possible*: the reference "
    "itself meets it there under true labels. The goals of `signoff.md` are about shares of the possible; *of all "
    "assets* counts those too where no edit is right since hulls span. Sessions are broken off after "
    f"{CAP:.0f} s.",
    f"A person labels the fine pieces of {KNOWN} assets, and by these assets are rebuilt on all 25, "
    f"from a probability of {SURE} on, as `prepare --rebuild-spanning` does. On each set the hulls of the same "
    f"{KNOWN} assets have labels by hand when the session begins; new hulls have those that `prepare` gives, "
    "and all other labels are propagated from those by hand.",
    f"*{FINE}*: each connected solid decomposed by itself, as in `signoff.md`.",
)
