"""Sums over hulls that touch, beside those of a sparse matrix, of which they are to be copies to the last bit."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csr_matrix

from meshforge.label_model.consensus import _rank_links, _sum_linked

RANDOM = np.random.default_rng(4)


@pytest.mark.parametrize(("hulls", "pairs"), [(4, 0), (12, 30), (300, 4000)])
def test_sums_over_neighbours_are_those_of_a_sparse_matrix(hulls: int, pairs: int) -> None:
    drawn = np.sort(RANDOM.integers(0, hulls, (pairs, 2)), axis=1)
    touching = np.unique(drawn[drawn[:, 0] < drawn[:, 1]], axis=0).reshape(-1, 2)
    both = np.concatenate([touching, touching[:, ::-1]])
    links = csr_matrix((np.ones(len(both)), tuple(both.T)), shape=(hulls, hulls))
    rows = RANDOM.random((hulls, 5))
    assert np.array_equal(_sum_linked(_rank_links(touching), rows), links @ rows)
