"""The fit of probabilities and threshold: what it makes of sessions of known truth."""

import numpy as np

from benchmark.signoff.fit import choose_threshold, fit_weights, lose
from meshforge.geometry import Floats

THRESHOLDS = 100  # of 0.5 to 0.995


def losses_from(least: int, count: int, loss: float) -> list[Floats]:
    """Families that lose so much below a threshold, given by its place, and nothing from it on."""
    return [np.where(np.arange(THRESHOLDS) < least, loss, 0.0) for _ in range(count)]


def test_the_threshold_is_the_least_at_which_the_bound_holds() -> None:
    assert choose_threshold(losses_from(60, 48, 0.1)) == 0.8
    assert choose_threshold(losses_from(60, 48, 0.001)) == 0.5


def test_a_session_loses_what_is_signed_off_wrong_and_unseen_at_its_end() -> None:
    #                  probability, called wrong, right
    first = np.array([[0.99, 0.0, 0.0]] * 10)
    last = np.array([[0.9, 0.0, 0.0], [0.9, 1.0, 0.0], [0.9, 0.0, 1.0]])
    assert lose([]).max() == 0.0
    found = lose([first, last])
    assert found[0] == 0.1, "one of ten, that nobody called wrong"
    assert found[81] == 0.0, "above 0.9 it is not signed off"


def test_the_weights_tell_right_from_wrong() -> None:
    draw = np.random.default_rng(7)
    rows = []
    for _ in range(400):
        readings, labels = draw.uniform(-3, 7, 2)
        right = draw.random() < 1 / (1 + np.exp(-readings)) / (1 + np.exp(-labels))
        rows.append([readings, labels, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, float(right)])
    weights = fit_weights([[rows[:200], rows[200:]]])
    assert 0.5 < weights[1] < 2.0
    assert 0.5 < weights[3] < 2.0
