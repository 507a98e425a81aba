"""One family from the labels of three assets to the split hulls of all others: the unit of work of all figures."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from benchmark.assets import CATEGORIES, MERGED, Sample
from benchmark.assets.decomposition import volumes_in_parts
from benchmark.evaluation.sessions import QUICK
from benchmark.journal import run_units
from benchmark.report import Tell
from benchmark.spanning.family import (
    NO_SURFACE,
    WAYS,
    Parts,
    SpanFamily,
    divide_truly,
    is_spanning,
    make_pieces,
    open_family,
    replace_hulls,
    split_hulls,
)
from benchmark.spanning.sets import find_sample, list_names, list_tasks
from benchmark.tasks import Task
from meshforge.geometry import HullPart, Polytope, convex_hull
from meshforge.label_model import SpanPosterior

SURE = (0.5, 0.9)
"""Probabilities from which on a hull is split; the first one is that of all figures that name none."""


@dataclass(frozen=True, slots=True)
class SplitPart:
    """A part of a hull that was split. vertices: (n, 3) [m]; label: the likeliest one; volumes: in true parts, by
    label [m^3]."""

    vertices: list[list[float]]
    label: str
    volumes: dict[str, float]


@dataclass(frozen=True, slots=True)
class SplitHull:
    """A hull of an asset that nobody labelled. chance: the probability that it spans; volumes: in true parts, by label
    [m^3]; parts: what it is split into where that is likely, else none; seconds: of the split."""

    asset: str
    number: int
    chance: float
    spans: bool
    volumes: dict[str, float]
    parts: tuple[SplitPart, ...]
    seconds: float

    def is_split(self, sure: float = SURE[0]) -> bool:
        """Whether it is split where that is done from such a probability on."""
        return self.chance >= sure and bool(self.parts)

    def parts_at(self, sure: float = SURE[0]) -> list[dict[str, float]]:
        """The volumes in true parts, by label [m^3], of each of its parts, or of itself where it is not split."""
        return [part.volumes for part in self.parts] if self.is_split(sure) else [self.volumes]

    @staticmethod
    def of_json(data: dict[str, Any]) -> SplitHull:
        return SplitHull(**{**data, "parts": tuple(SplitPart(**part) for part in data["parts"])})


@dataclass(frozen=True, slots=True)
class Edit:
    """Why the reference program, with true labels, fails on a mesh with hulls that span: as it is, with its hulls
    split, with them split by true labels of the pieces, and with all hulls rebuilt part by part; None: it does not."""

    task: str
    mesh: str
    before: str | None
    split: str | None
    truly: str | None
    rebuilt: str | None


@dataclass(frozen=True, slots=True)
class SplitFamily:
    """What became of a family. labelled: of `WAYS`; rebuilt: how many hulls each asset has that is rebuilt part by part
    since a hull of it likely spans; seconds: to infer all from what is known of it."""

    category: str
    setting: str
    labelled: str
    hulls: tuple[SplitHull, ...]
    edits: tuple[Edit, ...]
    rebuilt: dict[str, int]
    seconds: float

    @staticmethod
    def of_json(data: dict[str, Any]) -> SplitFamily:
        hulls = tuple(map(SplitHull.of_json, data["hulls"]))
        return SplitFamily(**{**data, "hulls": hulls, "edits": tuple(Edit(**row) for row in data["edits"])})


def split_families(tell: Tell, quick: bool, calibration: bool = False) -> list[SplitFamily]:
    """All families in both settings and in all ways to know labels; quick: of one category."""
    categories = [name for name in CATEGORIES if not quick or name == QUICK]
    return split_some(categories, tell, calibration)


def split_some(
    categories: Sequence[str], tell: Tell, calibration: bool = False, sets: Sequence[str] = MERGED
) -> list[SplitFamily]:
    """The families of some categories in some sets, by default both of generated assets, and in all ways to know
    labels."""
    warm_cache(categories, tell, calibration, sets)
    units = [(category, setting, calibration) for category in categories for setting in sets]
    return [SplitFamily.of_json(row) for rows in run_units("spanning", split_family, units, tell) for row in rows]


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


def split_family(category: str, setting: str, calibration: bool) -> list[dict[str, Any]]:
    """What becomes of a family in all ways to know labels, each a `SplitFamily` as JSON."""
    family = open_family(category, setting, calibration)
    fixed = {place: _edit_truly(sample, family.pieces[place]) for place, sample in family.unknown}
    return [asdict(_split_labelled(family, category, setting, labelled, fixed)) for labelled in WAYS]


def _split_labelled(
    family: SpanFamily, category: str, setting: str, labelled: str, fixed: Mapping[int, Sequence[Edit]]
) -> SplitFamily:
    """The same for one way. fixed: what edits of each asset do that no way changes, by its number."""
    started = time.process_time()
    posterior = family.infer(labelled)
    seconds = time.process_time() - started
    hulls, edits, counts = list[SplitHull](), list[Edit](), dict[str, int]()
    for place, sample in family.unknown:
        rows = list(_split_asset(sample, posterior, place))
        rebuilt = sample
        if labelled != NO_SURFACE and posterior.chances_of(place).max() >= SURE[0]:
            made = posterior.rebuild(place, np.arange(len(sample.mesh.hulls)))
            rebuilt = replace_hulls(sample, [part.shape for _, part in made])
            counts[sample.asset.name] = len(made)
        hulls += rows
        edits += _edit_asset(fixed[place], sample, rows, rebuilt) if labelled != NO_SURFACE else ()
    return SplitFamily(category, setting, labelled, tuple(hulls), tuple(edits), counts, seconds)


def _split_asset(sample: Sample, posterior: SpanPosterior, place: int) -> Iterator[SplitHull]:
    asset = sample.asset
    chances = posterior.chances_of(place)
    for number, (hull, share) in enumerate(zip(sample.decomposition.hulls, sample.shares, strict=True)):
        started, divided = time.process_time(), tuple[HullPart, ...]()
        if chances[number] >= SURE[0]:
            divided = posterior.divide(place, number)
        seconds = time.process_time() - started
        parts = tuple(
            SplitPart(
                part.shape.vertices.tolist(),
                posterior.labels[part.kind],
                volumes_in_parts(part.shape, asset.parts, asset.pose),
            )
            for part in divided
            if len(divided) > 1
        )
        volumes = volumes_in_parts(hull, asset.parts, asset.pose)
        yield SplitHull(asset.name, number, float(chances[number]), is_spanning(share), volumes, parts, seconds)


def parts_of(rows: Sequence[SplitHull], sure: float = SURE[0]) -> Parts:
    """The parts of the hulls of an asset that are split."""
    return {
        row.number: tuple(convex_hull(np.array(part.vertices)) for part in row.parts)
        for row in rows
        if row.is_split(sure)
    }


def _edit_truly(sample: Sample, pieces: Sequence[Polytope]) -> list[Edit]:
    """What the edits of an asset do before any split, and after one by true labels of its pieces."""
    concerned = _list_concerned(sample)
    truly = split_hulls(sample, divide_truly(sample, pieces)) if concerned else sample
    return [Edit(task.name, sample.name, _try(task, sample), None, _try(task, truly), None) for task in concerned]


def _edit_asset(fixed: Sequence[Edit], sample: Sample, rows: Sequence[SplitHull], rebuilt: Sample) -> Iterator[Edit]:
    split = split_hulls(sample, parts_of(rows)) if fixed else sample
    for edit, task in zip(fixed, _list_concerned(sample), strict=True):
        yield replace(edit, split=_try(task, split), rebuilt=_try(task, rebuilt))


def _list_concerned(sample: Sample) -> list[Task]:
    """The tasks that are about hulls of an asset which span parts."""
    return [task for task in list_tasks(sample.asset.category, sample.setting) if task.impure(sample)]


def _try(task: Task, sample: Sample) -> str | None:
    """Why the reference program fails on a mesh; None: it does not."""
    return task.failure(sample, task.run(task.program, sample.mesh))
