"""The noisy labeller: right for 92 of 100 hulls, wrong where a model would be; it is no measure of any model."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from benchmark.learning.repairs import Noise, spoilt
from meshforge.symbolic import SymbolicMesh

ACCURACY = 0.92
FEW, MOST = 12, 2
"""A mesh of so few hulls has so many wrong labels at most (paper: the 95th percentile of a mesh)."""
_TOGETHER = 0.5  # chance that the next wrong hull touches the one before


def noisy(mesh: SymbolicMesh, seed: Iterable[int]) -> SymbolicMesh:
    """The mesh with the labels of the noisy labeller: wrong ones come together, and name touching or like parts."""
    rng = np.random.default_rng(list(seed))
    count = int(rng.binomial(len(mesh.hulls), 1 - ACCURACY))
    if len(mesh.hulls) <= FEW:
        count = min(count, MOST)
    return spoilt(mesh, count, Noise(count), rng, _order_by_contact(mesh, rng))


def wrong(true: SymbolicMesh, labelled: SymbolicMesh) -> int:
    """How many labels differ."""
    return sum(a.label != b.label for a, b in zip(true.hulls, labelled.hulls, strict=True))


def _order_by_contact(mesh: SymbolicMesh, rng: np.random.Generator) -> list[int]:
    """All hulls in an order in which the next one often touches the one before."""
    left, order = rng.permutation(len(mesh.hulls)).tolist(), list[int]()
    while left:
        near = [k for k in left if order and k in mesh.neighbours(order[-1])]
        chosen = near[0] if near and rng.random() < _TOGETHER else left[0]
        left.remove(chosen)
        order.append(chosen)
    return order
