"""How sure a label is: fitted on families that the metric was not learned on, and tried on families of real assets."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from typing import Literal

import numpy as np
from scipy.optimize import minimize

from benchmark.assets import CATEGORIES, SEPARATE, Sample, family
from benchmark.labels.metric import PURE, Bools, fit_metric, rows_of
from benchmark.labels.propagation import calibration_error
from benchmark.labels.variety import choose_differing
from benchmark.real.family import families as real_families
from benchmark.real.samples import choose_samples
from benchmark.report import Cell, Goal, Result, Table, Tell
from meshforge.geometry import Floats
from meshforge.label_model import (
    FamilyModel,
    FamilyPosterior,
    FamilyTable,
    MeshDescriber,
    Observations,
    correct_upright,
    find_doubtful_sides,
    to_confidence,
)
from meshforge.label_model.describe import describe_mesh
from meshforge.labels.label_by_like import WIDER, find_nearest, measure_bound
from meshforge.labels.like_reference import find_sample
from meshforge.labels.summary import SURE
from meshforge.rendering import UNSURE
from meshforge.samples import FAMILIES
from meshforge.symbolic import Label, SymbolicMesh

LIKE = {"cup": "cups", "chair": "chairs", "table": "tables", "dispenser": "bottles"}
"""The bundled family of the kind that a category is of."""
_COUNTS, _DRAWS, _SEED = (1, 2, 3), 2, 0
_MIXED = 5  # meshes of each of two categories in a family of mixed kinds
_CROSSED_WORTH = 0.25  # what a family of mixed kinds counts
_RIDGE = 1e-3
Way = Literal["family", "like"]
Kind = Sequence[tuple[SymbolicMesh, Bools]]
"""The meshes of a family with their true labels, and which of their hulls are of one part."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """Hulls of a family that nobody labelled. chances: of their likeliest labels (n,); right: whether these are; worth:
    of the family."""

    chances: Floats
    right: Bools
    worth: float = 1.0


def fit_confidence(tell: Tell) -> list[list[float]]:
    """The level and slope of the logit of confidence over that of chance, by what is labelled: assets of the family, or
    of another one."""
    return [_fit([*draw_families(tell)]), _fit([*draw_references(tell)])]


def _fit(cases: Sequence[Outcome]) -> list[float]:
    """By the log loss; hulls of a family count together what it is worth."""
    right = np.concatenate([one.right for one in cases]).astype(float)
    x = np.concatenate([np.log(some / (1 - some)) for one in cases for some in [np.clip(one.chances, 1e-4, 1 - 1e-4)]])
    worth = np.concatenate([np.full(len(one.right), one.worth / max(len(one.right), 1)) for one in cases])

    def loss(weights: Floats) -> float:
        z = weights[0] + weights[1] * x
        return float((worth * (np.logaddexp(0, z) - right * z)).sum() / worth.sum() + _RIDGE * weights[1] ** 2)

    return [round(float(one), 3) for one in minimize(loss, np.array([0.0, 1.0]), method="L-BFGS-B").x]


def draw_families(tell: Tell) -> Iterator[Outcome]:
    """Families of which one to three meshes are labelled: of each category with a metric that was learned without it,
    of two categories together, and those that ship."""
    every = {name: [family(name, setting, True) for setting in SEPARATE] for name in CATEGORIES}
    described = {name: list(map(rows_of, some)) for name, some in every.items()}
    metrics = {}
    for name, families in every.items():
        tell(f"confidence: without {name}")
        others = [one for other, some in described.items() if other != name for one in some]
        metrics[name] = fit_metric(others)
        mixed = [choose_differing([row for some in families for row in some], 8, draw) for draw in range(_DRAWS)]
        for rows in (*families, *mixed):
            yield from label_some(_of_samples(rows), metrics[name])
    for one, other in combinations(CATEGORIES, 2):
        rows = [*every[one][0][:_MIXED], *every[other][0][:_MIXED]]
        yield from label_some(_of_samples(rows), metrics[one], _CROSSED_WORTH)
    for sample in FAMILIES:
        yield from label_some(_of_bundled(sample.name))


def label_some(kind: Kind, metric: Floats | None = None, worth: float = 1.0) -> Iterator[Outcome]:
    """What is found where some meshes of a family, drawn at random, are labelled by hand."""
    model, draw = FamilyModel([mesh for mesh, _ in kind], metric), np.random.default_rng(_SEED)
    for count in (count for count in _COUNTS for _ in range(_DRAWS) if count < len(kind)):
        chosen = set(draw.permutation(len(kind))[:count].tolist())
        found = model.infer([
            Label(hull.label) if place in chosen and hull.label else None
            for place, (mesh, _) in enumerate(kind)
            for hull in mesh.hulls
        ])  # fmt: skip
        yield _compare(kind, found, [k not in chosen for k in range(len(kind))], worth)


def draw_references(tell: Tell) -> Iterator[Outcome]:
    """Generated families with the labels of bundled ones, and the other way round; where kinds differ, the pairs that
    pass as one kind count together as one."""
    of_kinds = list[Outcome]()
    for name in CATEGORIES:
        tell(f"confidence: {name} beside bundled families")
        for sample in FAMILIES:
            for setting in SEPARATE:
                two = _of_samples(family(name, setting, True)), _of_bundled(sample.name)
                for own, other in (two, two[::-1]):
                    if found := label_like(own, other):
                        if LIKE.get(name) == sample.name:
                            yield found
                        else:
                            of_kinds.append(found)
    yield from (Outcome(one.chances, one.right, 1 / len(of_kinds)) for one in of_kinds)


def label_like(own: Kind, other: Kind) -> Outcome | None:
    """What is found in a family beside another one, all labelled; None where it is refused as of another kind."""
    labels: list[Label | None] = [None for mesh, _ in own for _ in mesh.hulls]
    labels += [Label(hull.label, 1.0, "file") if hull.label else None for mesh, _ in other for hull in mesh.hulls]
    described = [describe_mesh(mesh) for mesh, _ in (*own, *other)]
    table, seen = FamilyTable.of([(one.rows, one.touching) for one in described]), Observations.of(labels)
    sides = find_doubtful_sides(table, seen, lambda k: described[k].sides[: None if k < len(own) else 0])
    closer = {k: [MeshDescriber(own[k][0]).describe_side(side) for side in some] for k, some in sides if some}
    found = FamilyPosterior.of(correct_upright(table, seen, closer), seen)
    table, first = found.table, int(np.searchsorted(table.owner, len(own)))
    taught = first + np.flatnonzero(seen.known[first:])
    rows = table.rows[taught] * table.metric
    apart = find_nearest(table.rows[:first], rows, table.metric)[1]
    if np.median(apart) * WIDER > measure_bound(rows, table.owner[taught]):
        return None
    return _compare(own, found, [True] * len(own), 1.0)


def _compare(kind: Kind, found: FamilyPosterior, asked: Sequence[bool], worth: float) -> Outcome:
    """asked: which meshes count; hulls of several parts do not, nor those whose part is not known."""
    true = [hull.label for mesh, _ in kind for hull in mesh.hulls]
    counted = np.concatenate(
        [pure if use else np.zeros(len(pure), bool) for (_, pure), use in zip(kind, asked, strict=True)]
    )
    chances = found.chances[: len(true)]
    names = np.array(found.seen.labels)[chances.argmax(axis=1)]
    return Outcome(chances.max(axis=1)[counted], (names == np.array(true, dtype=object))[counted], worth)


def _of_samples(rows: Sequence[Sample]) -> Kind:
    return [
        (
            row.mesh,
            np.array(
                [
                    hull.label is not None and purity >= PURE
                    for hull, purity in zip(row.mesh.hulls, row.purities, strict=True)
                ]
            ),
        )
        for row in rows
    ]


@cache
def _of_bundled(name: str) -> Kind:
    meshes = [one.read_mesh() for one in find_sample(name)[1]]
    return [(mesh, np.array([hull.label is not None for hull in mesh.hulls])) for mesh in meshes]


def measure(tell: Tell, quick: bool) -> Result:
    """How sure labels of real families are, before and after the fit."""
    names = real_families()[: 1 if quick else None]
    kinds = {name: _of_samples(choose_samples(name)) for name in names}
    bundled = {one.name for one in FAMILIES}
    tell("confidence: real families")
    own = [one for kind in kinds.values() for one in label_some(kind)]
    beside = [one for name in names if name in bundled for one in [label_like(kinds[name], _of_bundled(name))] if one]
    ways: tuple[tuple[str, Way, list[Outcome]], ...] = (
        ("some of its assets labelled", "family", own),
        ("like the bundled family", "like", beside),
    )
    rows = [_row(f"{what}: {how}", some, change) for what, by, some in ways for how, change in _changes(by)]
    after = rows[1]
    goals = (
        Goal("calibration error, real families", "at most", 0.05, float(after[3])),
        Goal("sure labels of real families right", "at least", 0.97, float(after[6])),
    )
    columns = ("", "hulls", "right", "calibration error", "wrong, not unsure, %", "sure, %", "of these right")
    return Result(
        "confidence",
        "How sure labels are, between families",
        (Table("Real families", columns, tuple(rows)),),
        goals,
        _NOTES,
    )


def _changes(by: Way) -> tuple[tuple[str, Callable[[Floats], Floats]], ...]:
    return ("chance", lambda chances: chances), ("confidence", lambda chances: to_confidence(chances, by))


def _row(title: str, cases: Sequence[Outcome], change: Callable[[Floats], Floats]) -> tuple[Cell, ...]:
    right, sure = np.concatenate([one.right for one in cases]), change(np.concatenate([one.chances for one in cases]))
    is_sure, unseen = sure >= SURE, (sure >= UNSURE) & ~right
    return (
        title,
        len(right),
        float(right.mean()),
        calibration_error(right, sure),
        100 * float(unseen.mean()),
        100 * float(is_sure.mean()),
        float(right[is_sure].mean()),
    )


_NOTES = (
    "*Chance* is what the label model finds, *confidence* what a label says: a logistic curve of the chance, fitted by "
    "`python -m benchmark.labels confidence` on generated families, each with a metric that was learned without its "
    "category, on families of two categories, and on the bundled ones. The real families had no part in that.",
    "One to three assets of a family are labelled by hand, two draws of each; the bundled family of the kind: cups, "
    "chairs and tables. Parts that no labelled asset has count as wrong. *Wrong, not unsure*: of all hulls, those that "
    f"are wrong with {UNSURE} or more; *sure*: {SURE} or more.",
)
