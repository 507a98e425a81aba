"""One family from the labels of three assets to the rebuilt meshes of all others: the unit of work of all figures."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from benchmark.assets import CATEGORIES, MERGED, Sample
from benchmark.evaluation.sessions import QUICK
from benchmark.journal import run_units
from benchmark.report import Tell
from benchmark.spanning.family import (
    LABELLED,
    SpanFamily,
    is_spanning,
    make_pieces,
    open_family,
    replace_hulls,
)
from benchmark.spanning.sets import find_sample, list_names, list_tasks
from benchmark.tasks import Task

SURE = 0.5
"""The probability from which on a hull counts as found, and its asset is rebuilt."""


@dataclass(frozen=True, slots=True)
class HullChance:
    """A hull of an asset that nobody labelled. chance: the probability that it spans; spans: whether it does."""

    asset: str
    number: int
    chance: float
    spans: bool


@dataclass(frozen=True, slots=True)
class Edit:
    """Why the reference program, with true labels, fails on a mesh with hulls that span: as it is, and with all hulls
    rebuilt part by part; None: it does not."""

    task: str
    mesh: str
    before: str | None
    rebuilt: str | None


@dataclass(frozen=True, slots=True)
class FamilyOutcome:
    """What became of a family. labelled: of `LABELLED`; rebuilt: how many hulls each asset has that is rebuilt part by
    part since a hull of it likely spans; seconds: to infer all from what is known of it."""

    category: str
    setting: str
    labelled: str
    hulls: tuple[HullChance, ...]
    edits: tuple[Edit, ...]
    rebuilt: dict[str, int]
    seconds: float

    @staticmethod
    def of_json(data: dict[str, Any]) -> FamilyOutcome:
        hulls, edits = (HullChance(**row) for row in data["hulls"]), (Edit(**row) for row in data["edits"])
        return FamilyOutcome(**{**data, "hulls": tuple(hulls), "edits": tuple(edits)})


def judge_families(tell: Tell, quick: bool, calibration: bool = False) -> list[FamilyOutcome]:
    """All families in both settings and in all ways to know labels; quick: of one category."""
    categories = [name for name in CATEGORIES if not quick or name == QUICK]
    return judge_some(categories, tell, calibration)


def judge_some(
    categories: Sequence[str], tell: Tell, calibration: bool = False, sets: Sequence[str] = MERGED
) -> list[FamilyOutcome]:
    """The families of some categories in some sets, by default both of generated assets, and in all ways to know
    labels."""
    warm_cache(categories, tell, calibration, sets)
    units = [(category, setting, calibration) for category in categories for setting in sets]
    return [FamilyOutcome.of_json(row) for rows in run_units("spanning", judge_family, units, tell) for row in rows]


def warm_cache(categories: Sequence[str], tell: Tell, calibration: bool, sets: Sequence[str] = MERGED) -> None:
    """Decompose all assets of some categories finely, asset by asset, so that families find them in the cache."""
    units = [
        (category, setting, calibration, name)
        for category in categories
        for setting in sets
        for name in list_names(category, setting, calibration)
    ]
    run_units("spanning-pieces", count_pieces, units, tell)


def count_pieces(category: str, setting: str, calibration: bool, name: str) -> int:
    """How many fine pieces an asset has; they are in the cache from then on."""
    return len(make_pieces(find_sample(category, setting, name, calibration)))


def judge_family(category: str, setting: str, calibration: bool) -> list[dict[str, Any]]:
    """What becomes of a family in all ways to know labels, each a `FamilyOutcome` as JSON."""
    family = open_family(category, setting, calibration)
    before = {
        place: {task.name: _try(task, sample) for task in _list_concerned(sample)} for place, sample in family.unknown
    }
    return [asdict(_judge_labelled(family, category, setting, labelled, before)) for labelled in LABELLED]


def _judge_labelled(
    family: SpanFamily, category: str, setting: str, labelled: str, before: dict[int, dict[str, str | None]]
) -> FamilyOutcome:
    """The same for one way. before: why tasks fail on each asset as it is, by its number."""
    seconds, hulls, edits, counts = 0.0, list[HullChance](), list[Edit](), dict[str, int]()
    for place, sample in family.unknown:
        started = time.process_time()
        posterior = family.infer(place, labelled)
        chances = posterior.chances_of(0)
        seconds += time.process_time() - started
        rebuilt = sample
        if chances.max() >= SURE:
            made = posterior.rebuild(0, np.arange(len(sample.mesh.hulls)))
            rebuilt = replace_hulls(sample, [one.shape for one in made])
            counts[sample.asset.name] = len(made)
        hulls += _judge_hulls(sample, chances.tolist())
        edits += [Edit(task, sample.name, why, _try_named(task, rebuilt)) for task, why in before[place].items()]
    return FamilyOutcome(category, setting, labelled, tuple(hulls), tuple(edits), counts, seconds)


def _judge_hulls(sample: Sample, chances: Sequence[float]) -> Iterator[HullChance]:
    for number, (chance, share) in enumerate(zip(chances, sample.shares, strict=True)):
        yield HullChance(sample.asset.name, number, chance, is_spanning(share))


def _list_concerned(sample: Sample) -> list[Task]:
    """The tasks that are about hulls of an asset which span parts."""
    return [task for task in list_tasks(sample.asset.category, sample.setting) if task.impure(sample)]


def _try_named(name: str, sample: Sample) -> str | None:
    return next(_try(task, sample) for task in list_tasks(sample.asset.category, sample.setting) if task.name == name)


def _try(task: Task, sample: Sample) -> str | None:
    """Why the reference program fails on a mesh; None: it does not."""
    return task.failure(sample, task.run(task.program, sample.mesh))
