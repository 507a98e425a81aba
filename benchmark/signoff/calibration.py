"""How far probabilities can be believed: calibration error, order, Brier score; and a list of the doubtful."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import rankdata

from meshforge.geometry import Floats

BINS, LEAST = 10, 20
"""Bins of probabilities, and how many assets a bin has at least: smaller ones are merged with the next."""
RECALL = 0.95
"""The share of the wrong assets that a list of the doubtful ones names."""
Bools = NDArray[np.bool_]
Pairs = Sequence[tuple[float, bool]]
"""Probabilities, and whether what they are about is so."""


@dataclass(frozen=True, slots=True)
class Calibration:
    """count: pairs; right: the share that is so; error: the expected calibration error; order: the area under the ROC
    curve, 0.5 where all are right or none; brier, constant: Brier scores, that of the share alone beside it; precision,
    named: of the shortest list of the least probable that has most of the wrong ones, the share that is wrong, and its
    length; 1 and 0 where nothing is wrong."""

    count: int
    right: float
    error: float
    order: float
    brier: float
    constant: float
    precision: float
    named: int


def calibrate(pairs: Pairs) -> Calibration:
    """What the probabilities are worth."""
    shares = np.array([share for share, _ in pairs], float)
    right = np.array([is_right for _, is_right in pairs], bool)
    if not len(shares):
        return Calibration(0, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0)
    mean = float(right.mean())
    precision, named = _list_doubtful(shares, right)
    brier, constant = float(((shares - right) ** 2).mean()), mean * (1 - mean)
    return Calibration(
        len(pairs), mean, _measure_error(shares, right), _area(shares, right), brier, constant, precision, named
    )


def _measure_error(shares: Floats, right: Bools) -> float:
    """The mean over all of the distance between what a bin says and how much of it is right."""
    places = np.minimum((shares * BINS).astype(int), BINS - 1)
    apart, waiting = 0.0, np.zeros(len(shares), bool)
    bins = list[Bools]()
    for place in range(BINS):
        waiting |= places == place
        if waiting.sum() >= LEAST:
            bins.append(waiting)
            waiting = np.zeros(len(shares), bool)
    if waiting.any():
        bins[-1:] = [bins[-1] | waiting] if bins else [waiting]
    for which in bins:
        apart += which.sum() * abs(shares[which].mean() - right[which].mean())
    return float(apart / len(shares))


def _area(shares: Floats, right: Bools) -> float:
    ups, downs = int(right.sum()), int((~right).sum())
    if not ups or not downs:
        return 0.5
    return float((rankdata(shares)[right].sum() - ups * (ups + 1) / 2) / (ups * downs))


def _list_doubtful(shares: Floats, right: Bools) -> tuple[float, int]:
    """Of equal ones all are named."""
    wrong = int((~right).sum())
    if not wrong:
        return 1.0, 0
    for share in np.unique(shares):
        named = shares <= share
        found = int((~right[named]).sum())
        if found >= RECALL * wrong:
            return found / int(named.sum()), int(named.sum())
    raise AssertionError("the list of all names all")
