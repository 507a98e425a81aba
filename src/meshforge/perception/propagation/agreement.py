"""Labels of hulls that touch: what touches what in the assets that are labelled makes some labels likelier."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats
from meshforge.perception.propagation.family import Family

_SAID = 0.3  # what all neighbours together say, beside the hull itself
_SEEN_ANYWAY = 0.5  # pairs of labels count as having touched so often before any are seen
_ROUNDS = 5
_LEAST = 1e-3  # chance that nothing falls below before neighbours are asked


def agreeing(family: Family, chances: Floats) -> Floats:
    """Chances (hulls, labels) after each hull has heard its neighbours, a few times over (mean field).

    A pair of labels speaks for itself as much as it touches more often than by accident where labels are told.
    """
    bond = _bonds(family)
    a, b = family.touching.T
    degree = np.maximum(np.bincount(family.touching.ravel(), minlength=len(chances)), 1)[:, None]
    own = np.log(chances + _LEAST)
    for _ in range(_ROUNDS):
        said = chances @ bond.T
        heard = np.zeros_like(chances)
        np.add.at(heard, a, said[b])
        np.add.at(heard, b, said[a])
        evidence = own + _SAID * heard / degree
        chances = np.exp(evidence - evidence.max(axis=1, keepdims=True))
        chances /= chances.sum(axis=1, keepdims=True)
    return chances


def _bonds(family: Family) -> Floats:
    """For each pair of labels, how much more often they touch than by accident, as a logarithm (labels, labels)."""
    count = len(family.labels)
    seen = np.full((count, count), _SEEN_ANYWAY)
    codes = family.codes[family.touching]
    for one, other in codes[(codes >= 0).all(axis=1)]:
        seen[one, other] += 1
        seen[other, one] += 1
    joint = seen / seen.sum()
    alone = joint.sum(axis=1)
    bonds: Floats = np.log(joint / (alone[:, None] * alone[None]))
    return bonds
