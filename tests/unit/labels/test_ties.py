"""What is equal but for its last digits is chosen, ranked and described alike."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import Floats, Pose
from meshforge.label_model.surroundings import axes_along, points_inside
from meshforge.label_model.ties import first_greatest, greatest_first, share_ranks

CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
VALUES = st.lists(st.integers(0, 5), min_size=1, max_size=12)
SEEDS = st.integers(0, 2**32 - 1)


def rounded(values: Floats, seed: int) -> Floats:
    """The same values as another processor may have them."""
    return values + np.random.default_rng(seed).uniform(-1e-14, 1e-14, values.shape)


@given(values=VALUES, seed=SEEDS)
def test_the_last_digits_do_not_choose(values: list[int], seed: int) -> None:
    exact = np.array(values, dtype=float)
    noisy = rounded(exact, seed)
    assert first_greatest(noisy) == np.argmax(exact)
    assert greatest_first(noisy) == np.argsort(-exact, kind="stable").tolist()
    assert share_ranks(np.maximum(noisy, 0.0) + 1.0).tolist() == share_ranks(exact + 1.0).tolist()


@given(values=VALUES)
def test_ranks_are_shared_whatever_the_order(values: list[int]) -> None:
    exact = np.array(values, dtype=float)
    found = share_ranks(exact)
    assert found.sum() == len(values) * (len(values) - 1) / 2
    assert share_ranks(exact[::-1]).tolist() == found[::-1].tolist()


@given(angle=st.floats(-3.0, 3.0), near=st.floats(0.0, 1e-7))
def test_equally_long_axes_lie_alike_however_they_are_turned_in_their_plane(angle: float, near: float) -> None:
    lengths = np.array([[2.0, 1.0 + near, 1.0]])
    tilt = Pose.from_rpy((0.0, 0.0, 0.0), (0.3, 0.5, 0.7)).rotation
    turn = Pose.from_rpy((0.0, 0.0, 0.0), (angle, 0.0, 0.0)).rotation
    up = np.array([[0.0, 0.0, 1.0]])
    one, other = axes_along(up, lengths, tilt[None]), axes_along(up, lengths, (tilt @ turn)[None])
    assert other == pytest.approx(one, abs=1e-6)


def test_axes_of_different_lengths_keep_what_they_have() -> None:
    tilt = Pose.from_rpy((0.0, 0.0, 0.0), (0.3, 0.5, 0.7)).rotation
    found = axes_along(np.array([[0.0, 0.0, 1.0]]), np.array([[3.0, 2.0, 1.0]]), tilt[None])
    assert found == pytest.approx(np.abs(tilt[2:]), abs=1e-12)


@given(seed=SEEDS)
def test_of_equally_far_vertices_the_same_are_taken_whatever_their_last_digits(seed: int) -> None:
    axis = np.array([5.0, 0.3])
    assert points_inside(rounded(CUBE, seed), axis, 8) == pytest.approx(points_inside(CUBE, axis, 8), abs=1e-12)


@given(order=st.permutations(range(8)))
def test_the_order_of_vertices_does_not_choose_among_them(order: list[int]) -> None:
    axis = np.array([5.0, 0.3])
    assert points_inside(CUBE[order], axis, 8) == pytest.approx(points_inside(CUBE, axis, 8), abs=1e-12)
