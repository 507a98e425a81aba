import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import convex_hull, is_convex, overlap_volume
from meshforge.geometry.solids import intersect
from tests.examples import examples
from tests.unit.language.scenes import box


@pytest.mark.parametrize("low", [(2, 0, 0), (2, 2, 2), (5, 5, 5)])
def test_shapes_that_touch_or_lie_apart_have_nothing_in_common(low: tuple[float, float, float]) -> None:
    assert intersect(box((0, 0, 0), (2, 2, 2)), box(low, (9, 9, 9))) is None


@examples(60)
@given(st.integers(0, 10_000))
def test_what_two_hulls_have_in_common_is_convex_and_as_large_as_their_overlap(seed: int) -> None:
    random = np.random.default_rng(seed)
    a, b = (convex_hull(random.normal(size=(12, 3)) + shift) for shift in (0.0, random.uniform(0, 1.5)))
    met, volume = intersect(a, b), overlap_volume(a, b)
    if met is None:
        assert volume <= 1e-9 * a.volume
    else:
        assert is_convex(met.vertices, met.faces, 1e-6)
        assert met.volume == pytest.approx(volume, rel=1e-6, abs=1e-9)
