"""Look-alikes of a family with more meshes than are compared: found bit by bit as they are found at once."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.distance import cdist

from meshforge.label_model import lookalikes
from meshforge.label_model.lookalikes import Lookalikes, LookalikeSearch

MESHES, COLUMNS = 12, 3
SPEAKING = st.lists(st.integers(0, MESHES - 1), max_size=MESHES, unique=True)


def family(seed: int) -> LookalikeSearch:
    """Meshes of one to four hulls; many distances are equal."""
    rng = np.random.default_rng(seed)
    owner = np.repeat(np.arange(MESHES), rng.integers(1, 5, MESHES))
    return LookalikeSearch(rng.integers(0, 3, (len(owner), COLUMNS)).astype(float), np.ones(COLUMNS), owner)


def same(one: Lookalikes, other: Lookalikes) -> bool:
    names = ("others", "apart", "own", "own_apart")
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in names)


@pytest.fixture(autouse=True)
def few_meshes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lookalikes, "MOST_MESHES", 6)
    monkeypatch.setattr(lookalikes, "KEPT_MESHES", 3)


@given(seed=st.integers(0, 99), speaking=st.permutations(range(MESHES)), steps=st.integers(1, MESHES))
def test_one_mesh_after_another_finds_what_all_at_once_find(seed: int, speaking: list[int], steps: int) -> None:
    search = family(seed)
    for count in range(steps + 1):
        found = search.find(speaking[:count])
    assert same(found, family(seed).find(sorted(speaking[:steps])))


@given(seed=st.integers(0, 99), one=SPEAKING, other=SPEAKING)
def test_what_was_asked_before_changes_nothing(seed: int, one: list[int], other: list[int]) -> None:
    search = family(seed)
    search.find(one)
    assert same(search.find(other), family(seed).find(other))


@given(seed=st.integers(0, 99), speaking=SPEAKING)
def test_the_nearest_hull_of_a_mesh_that_speaks_is_found(seed: int, speaking: list[int]) -> None:
    """While no more meshes speak than are looked at beside the others."""
    search = family(seed)
    known = np.isin(search.owner, speaking[:3])
    _, apart = search.find(speaking[:3]).nearest(known, 1, 1)
    gaps = np.where(
        (search.owner[:, None] == search.owner) | ~known, np.inf, cdist(search.rows, search.rows, "cityblock")
    )
    for hull, gap in enumerate(gaps.min(axis=1)):
        nearer = np.unique(search.owner[(cdist(search.rows[[hull]], search.rows, "cityblock")[0] <= gap)])
        if len(nearer) <= 3:  # its meshes are among those that are kept
            assert apart[hull, 0] == gap
