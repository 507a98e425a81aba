"""The metric of propagation: learned on other families, it tells parts apart better than equal weights do."""

from __future__ import annotations

import numpy as np

from benchmark.assets import family
from benchmark.labels.metric import Rows, fit_metric, rows_of
from meshforge.geometry import Floats


def nearest_right(family: Rows, weights: Floats) -> float:
    """The share of hulls whose nearest hull of another asset has their label."""
    rows = family.rows * weights
    apart = np.abs(rows[:, None] - rows[None]).sum(axis=2)
    apart[family.asset[:, None] == family.asset[None]] = np.inf
    return float((family.labels[apart.argmin(axis=1)] == family.labels)[family.pure].mean())


def test_weights_learned_on_one_family_help_on_another_and_come_out_the_same_again() -> None:
    knives, cups = (rows_of(family(name, "medium", calibration=True)) for name in ("knife", "cup"))
    learned = fit_metric([cups])
    assert np.array_equal(learned, fit_metric([cups]))
    even = np.full(len(learned), learned.mean())
    assert nearest_right(knives, learned) > nearest_right(knives, even) - 0.02
    assert nearest_right(cups, learned) >= nearest_right(cups, even)
