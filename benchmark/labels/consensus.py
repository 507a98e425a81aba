"""The posterior over labels: its weights, fitted on calibration families, and how good it is on families that nothing
was fitted on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize

from benchmark.assets import CATEGORIES, SEPARATE, Sample
from benchmark.assets.storage import read, stem_of
from benchmark.labels.metric import PURE
from benchmark.study.labels import mislabel, noisy
from meshforge.geometry import Floats
from meshforge.label_model import EVIDENCE, FamilyModel, FamilyPosterior, FamilyTable, Observations
from meshforge.label_model.consensus import FamilyContext, infer_chances, softmax
from meshforge.symbolic import Label

SORTS = ("flat", "telling", "systematic", "true", "1", "2", "3")
"""Labels of a family: noisy ones, systematic errors, true ones; or those of one, two or three meshes alone."""
ROUNDS = 3
_STRAY = 1e-3  # cost of the squares of the weights
_START = (1.0, 0.5, 0.5, 0.2, 0.2, 0.2, 0.0, 0.1)


@dataclass(frozen=True, eq=False)
class FamilyCase:
    """A family with some labels. truth: the code of each hull among the labels of `seen`, or -1; counted: hulls of one
    part of which no person spoke."""

    category: str
    sort: str
    said: tuple[Label | None, ...]
    table: FamilyTable
    seen: Observations
    truth: npt.NDArray[np.int64]
    counted: npt.NDArray[np.bool_]

    @cached_property
    def context(self) -> FamilyContext:
        return FamilyContext(self.table, self.seen)


def draw_families(folder: Path, seed: int, metrics: Mapping[str, Floats] | None = None) -> Iterator[FamilyCase]:
    """Calibration families of a folder, each with every sort of labels.

    metrics: of each category, one that was fitted without it; None for the one that ships.
    """
    for category in CATEGORIES:
        every = list(read(folder, stem_of(category, True)))
        for setting in SEPARATE:
            rows = [row for row in every if row.setting == setting]
            table = FamilyModel([row.mesh for row in rows], metrics[category] if metrics else None).table
            for sort in SORTS:
                yield label_family(category, sort, table, rows, seed)


def label_family(category: str, sort: str, table: FamilyTable, rows: Sequence[Sample], seed: int) -> FamilyCase:
    """A family with labels of one sort; table: of its meshes."""
    said = [label for labels in _say(sort, rows, seed) for label in labels]
    seen = Observations.of(said)
    places = {label: place for place, label in enumerate(seen.labels)}
    truth = np.array([places.get(str(hull.label), -1) for row in rows for hull in row.mesh.hulls])
    pure = np.array([purity >= PURE for row in rows for purity in row.purities])
    return FamilyCase(category, sort, tuple(said), table, seen, truth, pure & ~seen.fixed)


def _say(sort: str, rows: Sequence[Sample], seed: int) -> Iterator[list[Label | None]]:
    if sort.isdigit():
        chosen = set(np.random.default_rng(seed).permutation(len(rows))[: int(sort)].tolist())
        for place, row in enumerate(rows):
            yield [Label(str(hull.label)) if place in chosen else None for hull in row.mesh.hulls]
        return
    wrong = mislabel({row.name: row.mesh for row in rows}, (seed, 7)) if sort == "systematic" else {}
    for place, row in enumerate(rows):
        mesh = row.mesh if sort == "true" else wrong.get(row.name)
        mesh = mesh or noisy(row.mesh, (seed, place), telling=sort == "telling")
        yield [Label(str(hull.label), hull.confidence or 0.0, "vlm") for hull in mesh.hulls]


def fit_weights(families: Sequence[FamilyCase]) -> Floats:
    """The weights (ROUNDS, evidence) by the log loss of the true label, round after round."""
    chances = [one.context.start() for one in families]
    rounds = []
    for _ in range(ROUNDS):
        evidence = [one.context.collect_evidence(some) for one, some in zip(families, chances, strict=True)]
        rounds.append(_fit_round(families, evidence))
        chances = [one.context.hold(softmax(some @ rounds[-1])) for one, some in zip(families, evidence, strict=True)]
    return np.array(rounds)


def _fit_round(families: Sequence[FamilyCase], evidence: Sequence[Floats]) -> Floats:
    used = [one.counted & (one.truth >= 0) for one in families]
    rows = [(some[use], one.truth[use]) for one, some, use in zip(families, evidence, used, strict=True)]
    count = sum(len(truth) for _, truth in rows)

    def loss(weights: Floats) -> tuple[float, Floats]:
        total, slope = 0.0, np.zeros_like(weights)
        for some, truth in rows:
            shares, at = softmax(some @ weights), np.arange(len(truth))
            total -= float(np.log(shares[at, truth] + 1e-12).sum())
            slope += np.einsum("nl,nlk->k", shares, some) - some[at, truth].sum(axis=0)
        return total / count + _STRAY * float(weights @ weights), slope / count + 2 * _STRAY * weights

    assert len(_START) == len(EVIDENCE)
    found: Floats = minimize(loss, np.array(_START), jac=True, method="L-BFGS-B").x
    return found


@dataclass(frozen=True, eq=False)
class LabelScore:
    """before, after: shares of labels that are right; whole: of the meshes, those with all labels right; chances: of
    the label that each hull gets, right: whether it is."""

    before: float
    after: float
    whole: float
    chances: Floats
    right: npt.NDArray[np.bool_]

    @staticmethod
    def of(family: FamilyCase, weights: Floats | None = None) -> LabelScore:
        chances, by_others = infer_chances(family.table, family.seen, weights)
        agreed = FamilyPosterior(family.table, family.seen, chances, by_others).agree(family.said)
        codes = np.array([family.seen.labels.index(label.name) if label else -1 for label in agreed])
        right, use = codes == family.truth, family.counted
        meshes = [right[span][use[span]] for span in family.table.spans.values()]
        return LabelScore(
            float((family.seen.codes == family.truth)[use].mean()),
            float(right[use].mean()),
            float(np.mean([some.all() for some in meshes if len(some)])),
            chances[np.arange(len(codes)), codes][use],
            right[use],
        )
