"""Fits the weights of the probability that a hull spans parts, on the calibration assets alone."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

from benchmark.assets import CATEGORIES, MERGED
from benchmark.journal import run_units
from benchmark.report import Tell
from benchmark.signoff.calibration import calibrate
from benchmark.spanning.course import warm_cache
from benchmark.spanning.family import LABELLED, is_spanning, open_family
from meshforge.common import write_atomically
from meshforge.geometry import Floats
from meshforge.label_model import spans

_STRAY = 1e-3  # cost of the squares of the weights
_ABOUT = "made by `python -m benchmark.spanning fit` on the calibration set of the benchmark"


def fit(tell: Tell) -> None:
    """Fit the weights, say how good they are on categories left out, and write them where they ship."""
    warm_cache(CATEGORIES, tell, True)
    data = {"about": _ABOUT, "weights": _fit_ways(tell)}
    write_atomically(Path(spans.__file__).parent / spans.WEIGHTS_FILE, json.dumps(data, indent=1) + "\n")


def _fit_ways(tell: Tell) -> list[float]:
    units = [(name, setting, labelled) for name in CATEGORIES for setting in MERGED for labelled in LABELLED]
    found = run_units("spanning-evidence", collect_evidence, units, tell)
    rows = {unit: np.array(some, float) for unit, some in zip(units, found, strict=True)}
    pairs = list[tuple[float, bool]]()
    for left in CATEGORIES:
        others = fit_weights([some for unit, some in rows.items() if unit[0] != left])
        for unit, some in rows.items():
            pairs += (
                zip(_predict(others, some).tolist(), map(bool, some[:, -1]), strict=True) if unit[0] == left else ()
            )
    weights = [round(float(weight), 3) for weight in fit_weights(list(rows.values()))]
    tell(f"of a category left out {calibrate(pairs)}; weights {weights}")
    return weights


def collect_evidence(category: str, setting: str, labelled: str) -> list[list[float]]:
    """Of each hull of a calibration family that nobody labelled the evidence, and whether it spans."""
    family = open_family(category, setting, True)
    return [
        [*evidence, float(is_spanning(share))]
        for place, sample in family.unknown
        for evidence, share in zip(
            family.infer(place, labelled).collect_evidence(0).tolist(), sample.shares, strict=True
        )
    ]


def fit_weights(tables: Sequence[Floats]) -> Floats:
    """Logistic regression by log loss on rows of evidence with what is so last, each family counting alike."""
    start = np.zeros(tables[0].shape[1] - 1)
    return np.array(minimize(partial(_loss, tables), start, jac=True).x)


def _predict(weights: Floats, rows: Floats) -> Floats:
    found: Floats = 1 / (1 + np.exp(-(rows[:, :-1] @ weights)))
    return found


def _loss(tables: Sequence[Floats], weights: Floats) -> tuple[float, Floats]:
    total, slope = _STRAY * float(weights @ weights), 2 * _STRAY * weights
    for rows in tables:
        found, right = np.clip(_predict(weights, rows), 1e-9, 1 - 1e-9), rows[:, -1]
        worth = 1 / (len(rows) * len(tables))
        total -= worth * float((right * np.log(found) + (1 - right) * np.log(1 - found)).sum())
        slope = slope + worth * rows[:, :-1].T @ (found - right)
    return total, slope
