"""The filters of pictures, beside those of scipy, of which they are to be copies to the last bit."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter, label, map_coordinates

from meshforge.rendering.filters import blur, keep_reached, sample

RANDOM = np.random.default_rng(5)


@pytest.mark.parametrize("shape", [(72, 48), (5, 90), (7, 7)])
@pytest.mark.parametrize("sigma", [0.8, 1.2, 3.0])
def test_a_blurred_picture_is_that_of_scipy(shape: tuple[int, int], sigma: float) -> None:
    picture = RANDOM.random(shape).astype(np.float32)
    assert np.array_equal(blur(picture, sigma), gaussian_filter(picture, sigma))


def test_places_between_pixels_show_what_they_do_in_scipy_and_nothing_beyond_the_sides() -> None:
    picture = RANDOM.random((30, 41)).astype(np.float32)
    places = RANDOM.uniform(-3.0, 44.0, (4000, 2))
    places[:400] = np.round(places[:400])
    places[:3] = np.array([[0, 0], [29, 40], [29.0001, 0]])
    assert np.array_equal(sample(picture, places), map_coordinates(picture, places.T, order=1))
    assert sample(picture, places)[2] == 0.0


@pytest.mark.parametrize("share", [0.0, 0.1, 0.35, 0.6, 1.0])
def test_pixels_are_kept_where_their_component_has_one_that_is_high(share: float) -> None:
    low = RANDOM.random((60, 80)) < share
    high = RANDOM.random(low.shape) < 0.02
    parts, count = label(low, np.ones((3, 3)))
    kept = np.isin(parts, np.unique(parts[high & low])) & low
    assert count >= int(low.any()) and np.array_equal(keep_reached(low, high), kept)
