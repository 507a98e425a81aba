"""The posterior over labels: its weights, fitted on calibration families, and how good they are on categories that they
were not fitted on."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize

from benchmark.assets import Sample
from benchmark.labels.metric import PURE
from benchmark.labels.variety import CROSSED, FOLDS, draw_families
from benchmark.report import Tell
from benchmark.study.labels import mislabel, noisy
from meshforge.geometry import Floats
from meshforge.label_model import EVIDENCE, FamilyModel, FamilyPosterior, FamilyTable, Observations
from meshforge.label_model.consensus import FamilyContext, infer_chances, softmax
from meshforge.symbolic import Label

SORTS = ("flat", "telling", "systematic", "true", "1", "2", "3")
"""Labels of a family: noisy ones, systematic errors, true ones; or those of one, two or three meshes alone."""
ROUNDS = 3
_STRAY = 1e-3  # cost of the squares of the weights
_START = (1.0, 0.5, 0.0, 0.0, 0.5, 0.2, 0.2, 0.2, 0.0, 0.1)
_WORTH = {"systematic": 2.0}
"""What a family counts by its labels, 1 else: errors of a kind are the hardest to find."""


@dataclass(frozen=True, eq=False)
class FamilyCase:
    """A family with some labels. kind: of its meshes; truth: the code of each hull among the labels of `seen`, or -1;
    counted: hulls of one part of which no person spoke."""

    kind: str
    sort: str
    said: tuple[Label | None, ...]
    table: FamilyTable
    seen: Observations
    truth: npt.NDArray[np.int64]
    counted: npt.NDArray[np.bool_]

    @cached_property
    def context(self) -> FamilyContext:
        return FamilyContext(self.table, self.seen)


def draw_cases(folder: Path, fold: Sequence[str], seed: int) -> Iterator[FamilyCase]:
    """Calibration families of some categories, each with every sort of labels; no hull of one category is labelled by
    hand for another."""
    for kind, rows in draw_families(folder, fold):
        table = FamilyModel([row.mesh for row in rows]).table
        for sort in SORTS:
            if not (sort.isdigit() and kind == CROSSED):
                yield label_family(kind, sort, table, rows, seed)


def label_family(kind: str, sort: str, table: FamilyTable, rows: Sequence[Sample], seed: int) -> FamilyCase:
    """A family with labels of one sort; table: of its meshes."""
    said = [label for labels in _say(sort, rows, seed) for label in labels]
    seen = Observations.of(said)
    places = {label: place for place, label in enumerate(seen.labels)}
    truth = np.array([places.get(str(hull.label), -1) for row in rows for hull in row.mesh.hulls])
    pure = np.array([purity >= PURE for row in rows for purity in row.purities])
    return FamilyCase(kind, sort, tuple(said), table, seen, truth, pure & ~seen.fixed)


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
    """The weights (ROUNDS, evidence) by the log loss of the true label, round after round; families count alike."""
    chances = [one.context.start() for one in families]
    rounds = []
    for _ in range(ROUNDS):
        evidence = [one.context.collect_evidence(some) for one, some in zip(families, chances, strict=True)]
        rounds.append(_fit_round(families, evidence))
        chances = [
            one.context.fix_known(softmax(some @ rounds[-1])) for one, some in zip(families, evidence, strict=True)
        ]
    return np.array(rounds)


def _fit_round(families: Sequence[FamilyCase], evidence: Sequence[Floats]) -> Floats:
    rows = []
    for one, some in zip(families, evidence, strict=True):
        used = one.counted & (one.truth >= 0)
        rows.append((some[used], one.truth[used], _WORTH.get(one.sort, 1.0) / max(int(used.sum()), 1)))
    total = sum(worth * len(truth) for _, truth, worth in rows)

    def loss(weights: Floats) -> tuple[float, Floats]:
        found, slope = 0.0, np.zeros_like(weights)
        for some, truth, worth in rows:
            shares, at = softmax(some @ weights), np.arange(len(truth))
            found -= worth * float(np.log(shares[at, truth] + 1e-12).sum())
            slope += worth * (np.einsum("nl,nlk->k", shares, some) - some[at, truth].sum(axis=0))
        return found / total + _STRAY * float(weights @ weights), slope / total + 2 * _STRAY * weights

    assert len(_START) == len(EVIDENCE)
    found: Floats = minimize(loss, np.array(_START), jac=True, method="L-BFGS-B").x
    return found


def try_on_other_fold(folder: Path, seed: int, tell: Tell) -> None:
    """Say how many labels are right before and after, by weights that were fitted on the other categories."""
    cases = [list(draw_cases(folder, fold, seed)) for fold in FOLDS]
    found = defaultdict[tuple[str, str], list[LabelScore]](list)
    for mine, others in zip(cases, reversed(cases), strict=True):
        weights = fit_weights(others)
        for one in mine:
            found[one.kind, one.sort].append(LabelScore.of(one, weights))
    for (kind, sort), scores in found.items():
        before, after = (float(np.mean([getattr(one, when) for one in scores])) for when in ("before", "after"))
        tell(f"{kind}, labels {sort}: right {before:.3f}, then {after:.3f}")


@dataclass(frozen=True, eq=False)
class LabelScore:
    """before, after: shares of labels that are right."""

    before: float
    after: float

    @staticmethod
    def of(family: FamilyCase, weights: Floats | None = None) -> LabelScore:
        chances, by_others = infer_chances(family.table, family.seen, weights)
        agreed = FamilyPosterior(family.table, family.seen, chances, by_others).agree(family.said)
        codes = np.array([family.seen.labels.index(label.name) if label else -1 for label in agreed])
        use = family.counted
        before, after = ((some == family.truth)[use].mean() for some in (family.seen.codes, codes))
        return LabelScore(float(before), float(after))
