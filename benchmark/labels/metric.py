"""Learns which differences between hulls tell parts apart, on the calibration set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize

from benchmark.assets import Sample
from meshforge.geometry import Floats
from meshforge.label_model.describe import ROW_WIDTH, MeshDescriber
from meshforge.label_model.table import ColumnScale

PURE = 0.8
"""Hulls of a lower purity teach nothing, and are not counted."""
_START = 0.12  # weight of every column before anything is learned
_STRAYING = 0.2  # cost of the mean square of the logarithms by which weights leave it
_EPISODES = 2  # draws of labelled meshes, a family
_LABELLED = (1, 2, 2, 3, 3)  # meshes that are labelled in a draw
_ASKED = 150  # hulls that are asked for, a draw
_STEPS = 60
Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Rows:
    """Hulls of a family. rows: standardised; labels; pure: whether a hull is of one part; mesh, asset: whose."""

    rows: Floats
    labels: npt.NDArray[np.str_]
    pure: Bools
    mesh: npt.NDArray[np.int64]
    asset: npt.NDArray[np.str_]


def rows_of(samples: Sequence[Sample]) -> Rows:
    """The hulls of some samples."""
    sizes = [len(sample.mesh.hulls) for sample in samples]
    rows = np.concatenate([MeshDescriber(sample.mesh).describe().rows for sample in samples])
    return Rows(
        ColumnScale.of(rows)(rows),
        np.array([hull.label for sample in samples for hull in sample.mesh.hulls]),
        np.array([purity >= PURE for sample in samples for purity in sample.purities]),
        np.repeat(np.arange(len(samples)), sizes),
        np.repeat([sample.asset.name for sample in samples], sizes),
    )


def fit_metric(families: Sequence[Rows], seed: int = 0) -> Floats:
    """The weights (WIDTH,) under which hulls of the same label are near, across assets (neighbourhood components).

    In each draw some meshes are labelled; the chance that the hulls of other assets find their label among theirs is
    made as great as can be.
    """
    draw = np.random.default_rng(seed)
    episodes = [_episode(family, draw) for family in families for _ in range(_EPISODES)]
    start = np.full(ROW_WIDTH, np.log(_START))

    def cost(logs: Floats) -> tuple[float, Floats]:
        weights = np.exp(logs)
        told = [_surprise(apart, same, weights) for apart, same in episodes]
        strayed = logs - start
        total = np.mean([surprise for surprise, _ in told]) + _STRAYING * np.mean(strayed**2)
        slope = np.mean([slope for _, slope in told], axis=0) * weights + 2 * _STRAYING * strayed / ROW_WIDTH
        return float(total), slope

    found = minimize(cost, start, jac=True, method="L-BFGS-B", options={"maxiter": _STEPS})
    weights: Floats = np.exp(found.x)
    return weights


def _episode(family: Rows, draw: np.random.Generator) -> tuple[npt.NDArray[np.float32], Bools]:
    """Differences (asked, labelled, columns) of hulls that are asked for from labelled ones; which are of one label."""
    chosen = draw.permutation(family.mesh[-1] + 1)[: draw.choice(_LABELLED)]
    teachers = np.isin(family.mesh, chosen)
    others = ~np.isin(family.asset, family.asset[teachers]) & family.pure
    asked = np.flatnonzero(others & np.isin(family.labels, family.labels[teachers]))
    asked = np.sort(draw.permutation(asked)[:_ASKED])
    apart = np.abs(family.rows[asked][:, None] - family.rows[teachers][None]).astype(np.float32)
    return apart, family.labels[asked][:, None] == family.labels[teachers][None]


def _surprise(apart: npt.NDArray[np.float32], same: Bools, weights: Floats) -> tuple[float, Floats]:
    """Minus the mean logarithm of the chance of the right label, and its slope by the weights."""
    distance = apart @ weights.astype(np.float32)
    likeness = np.exp(-(distance - distance.min(axis=1, keepdims=True))).astype(float)
    right = np.where(same, likeness + 1e-12, 0.0)
    chance = right.sum(axis=1) / likeness.sum(axis=1)
    pull = right / right.sum(axis=1, keepdims=True) - likeness / likeness.sum(axis=1, keepdims=True)
    slope = np.tensordot(pull, apart, 2) / len(apart)
    return float(-np.log(chance + 1e-12).mean()), slope
