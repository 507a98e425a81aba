"""From readings, labels and all that is odd about an asset to one probability that its edit is right: that of its
program, that of its readings and that of its labels, each by a logistic function (Platt 1999); and the threshold from
which on an asset is signed off without a look, by conformal risk control over families (Angelopoulos et al. 2024). All
of it is fitted on sessions of calibration families (`python -m benchmark.signoff fit`)."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np

from meshforge.geometry import Floats

WEIGHTS_FILE = "confidence.json"
WEIGHTS = (
    "readings, always",
    "candidates",
    "labels, always",
    "labels",
    "labels not demonstrated",
    "unlike the rest",
    "alarms",
)
"""What speaks for an edit: the first two for its readings, the others for its labels and all that is odd."""
LEAST, MOST = 0.0005, 0.9995
"""Bounds of what readings and labels say."""
BY_HAND = {"unlike the rest": -1.0, "alarms": -1.5}
"""Weights that are chosen, not fitted: calibration families hardly have such assets."""
NO_EDIT = 0.01
"""The probability of an edit that cannot be made."""
STANDS_OUT = 0.49
"""The most that the probability is of an edit that stands out: below any bar, so that a person looks at it first."""


@dataclass(frozen=True, eq=False, slots=True)
class Calibration:
    """weights: (len(WEIGHTS),); program, result: what speaks for a program as such, and for one that does what a person
    accepted or meant on an asset [nats]; threshold: the probability from which on an asset is signed off without a
    look; families: on which it rests; risk: the share of the assets of a family that are signed off and wrong, at most,
    as far as can be expected."""

    weights: Floats
    program: float
    result: float
    threshold: float
    families: int
    risk: float


@cache
def read_calibration() -> Calibration:
    """Return what ships."""
    read = json.loads(files("meshforge.signoff").joinpath(WEIGHTS_FILE).read_text("utf-8"))
    weights = np.array([read["weights"][name] for name in WEIGHTS], dtype=float)
    weights.flags.writeable = False
    return Calibration(weights, *(read[one] for one in ("program", "result", "threshold", "families", "risk")))


def combine(features: Floats, weights: Floats) -> Floats:
    """Return the probability (n,) that edits are right under a program that is not wrong nearly everywhere: that each
    reading means there what it does, times that no other label would change it.

    features: (n, 5), of edits; weights: (len(WEIGHTS),).
    """
    candidates = weights[0] + weights[1] * features[..., 0]
    labels = weights[2] + features[..., 1:] @ weights[3:]
    found: Floats = 1 / (1 + np.exp(-candidates)) / (1 + np.exp(-labels))
    return found


@dataclass(frozen=True, slots=True)
class AssetEvidence:
    """What speaks for one edit.

    candidates: the probability that each rule means there what it does; labels: that no other labels would change the
    edit; unseen_labels: whether it has labels that no demonstration shows; outlier_score: how much farther than usual
    its strangest hull is from all hulls of other assets of which something is said; alarms: how many there are;
    program: the probability that the program is not wrong nearly everywhere.
    """

    candidates: float
    labels: float
    unseen_labels: float = 0.0
    outlier_score: float = 0.0
    alarms: float = 0.0
    program: float = 1.0

    @property
    def features(self) -> Floats:
        """The log odds of readings and labels, then what is odd (5,)."""
        return np.array(
            [_log_odds(self.candidates), _log_odds(self.labels), self.unseen_labels, self.outlier_score, self.alarms]
        )

    @property
    def probability(self) -> float:
        """That the edit is right."""
        found = self.program * float(combine(self.features, read_calibration().weights))
        return min(found, STANDS_OUT) if self.alarms else found

    def credit(self, *, candidates: float = 1.0, labels: float = 1.0, program: float = 1.0) -> float:
        """Return what it is worth to tell some of it, in edits that are right: the probability that this one is wrong,
        times the share of the doubt [nats] that is gone. What decides an edit is a conjunction: the last doubt of many
        alone makes it right, and yet each has to go.

        candidates, labels, program: by which these probabilities grow, as factors.
        """
        reason = -_log_of(self.candidates) - _log_of(self.labels) - _log_of(self.program)
        gone = math.log(candidates * labels * program)
        return (1 - self.probability) * min(1.0, gone / reason) if reason > 0 else 0.0


def _log_of(share: float) -> float:
    return math.log(max(LEAST, share))


def _log_odds(share: float) -> float:
    bounded = min(MOST, max(LEAST, share))
    return float(np.log(bounded / (1 - bounded)))
