from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from meshforge.batch import TopItems

RANKS = st.lists(st.integers(0, 3), max_size=40)


@given(RANKS, st.integers(1, 10))
def test_the_first_of_the_lowest_ranks_are_kept(ranks: list[int], most: int) -> None:
    chosen = TopItems[tuple[int, int]](most)
    for k, rank in enumerate(ranks):
        chosen.add(rank, (rank, k))
        assert len(list(chosen)) <= most
    assert list(chosen) == sorted((rank, k) for k, rank in enumerate(ranks))[:most]
