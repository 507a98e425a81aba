"""How reliable each source of labels is in a family: a rate that depends on its confidence, found by expectation
maximization together with the labels (Dawid and Skene 1979); and where a source calls a kind of part wrongly in one
mesh."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.label_model.table import Bools, Observations
from meshforge.symbolic import LABEL_SOURCES

EXPECTED = {"file": 0.97, "name": 0.95}
"""The share of right labels that is assumed of a source before any is looked at."""
EXPECTED_OF_OTHERS = 0.9
_COUNTS_FOR = 20.0  # hulls that this assumption counts for
_RIDGE = 10.0  # what holds the slope in the confidence near 0
_STEPS = 8
_LEAST, _MOST = 0.03, 0.997  # bounds of a reliability
_COUNTS_FOR_KIND = 2.0  # hulls that the mean of a source counts for in one kind of part of one mesh


def estimate_reliability(seen: Observations, free: Bools, right: Floats) -> Floats:
    """Return the probability (n,) that what is said of each hull is right, by source and confidence.

    free: which hulls a machine speaks of; right: (n,) how probable that is by all that is known.
    """
    found = np.full(len(right), EXPECTED_OF_OTHERS)
    for source in np.unique(seen.sources[free]).tolist():
        mine = free & (seen.sources == source)
        expected = EXPECTED.get(LABEL_SOURCES[source], EXPECTED_OF_OTHERS)
        found[mine] = _fit_rate(seen.confidence[mine], right[mine], expected)
    clipped: Floats = np.clip(found, _LEAST, _MOST)
    return clipped


def _fit_rate(confidence: Floats, right: Floats, expected: float) -> Floats:
    """A logistic regression of being right on the logit of the confidence, ridged, with the expectation as a prior."""
    base = (right.sum() + expected * _COUNTS_FOR) / (len(right) + _COUNTS_FOR)
    bounded = np.clip(confidence, 0.02, 0.98)
    x = np.log(bounded / (1 - bounded))
    spread = float(x.std())
    level, slope = float(np.log(base / (1 - base))), 0.0
    if spread < 1e-6:
        return np.full(len(right), base)
    x = (x - x.mean()) / spread
    for _ in range(_STEPS):
        rate = 1 / (1 + np.exp(-(level + slope * x)))
        weight = np.maximum(rate * (1 - rate), 1e-4)
        at_mean = 1 / (1 + np.exp(-level))
        gradient = np.array(
            [(right - rate).sum() + _COUNTS_FOR * (expected - at_mean), ((right - rate) * x).sum() - _RIDGE * slope]
        )
        cross = float((weight * x).sum())
        curvature = np.array([[weight.sum() + _COUNTS_FOR * 0.09, cross], [cross, (weight * x * x).sum() + _RIDGE]])
        step = np.linalg.solve(curvature, gradient)
        level, slope = level + float(step[0]), slope + float(step[1])
    found: Floats = 1 / (1 + np.exp(-(level + slope * x)))
    return found


def find_wrong_kinds(seen: Observations, owner: Ints, free: Bools, right: Floats) -> Floats:
    """Return how much less reliable what is said is where one label of one mesh is wrong altogether [nats], (n,), at
    most 0.

    right: (n,) the probability that what is said is right by look-alikes alone.
    """
    found = np.zeros(len(right))
    if not free.any():
        return found
    key = owner[free] * len(seen.labels) + seen.codes[free]
    _, kind = np.unique(key, return_inverse=True)
    count, total = np.bincount(kind), np.bincount(kind, right[free])
    mean = float(right[free].mean())
    share = (total + _COUNTS_FOR_KIND * mean) / (count + _COUNTS_FOR_KIND)
    odds = np.log(share / (1 - share + 1e-6)) - np.log(mean / (1 - mean + 1e-6))
    found[free] = np.minimum(odds, 0.0)[kind]
    return found
