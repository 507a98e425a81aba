"""Which asset to label next: the one whose hulls stand for most doubtful hulls that no labelled one is like."""

from __future__ import annotations

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats, Ints
from meshforge.perception.propagation.describe import SHAPES
from meshforge.perception.propagation.family import UNTOLD, Family, evenly
from meshforge.perception.propagation.ties import first_greatest

_HULLS, _MESHES = 3000, 2000  # that are compared at most, evenly chosen of more
_NEAR = 0.35  # of the median distance of hulls, within which they stand for each other
_AT_LEAST = 0.1  # what a hull counts whose label is certain; one about which nothing is known counts so much and one


def chosen(family: Family, chances: Floats, count: int) -> list[int]:
    """The meshes to label next, the best first; those without an untold hull are not among them.

    chances: of the labels of each hull (hulls, labels).
    """
    open_meshes = evenly(np.unique(family.owner[family.codes == UNTOLD]), _MESHES)
    rows = family.rows[:, SHAPES]
    compared = evenly(np.arange(len(rows)), _HULLS)
    some, doubt = rows[compared], 1 + _AT_LEAST - chances[compared].max(axis=1, initial=0.0)
    if not len(open_meshes):
        return []
    near = max(float(np.median(cdist(some, some))) * _NEAR, 1e-9)

    def alike(hulls: Ints) -> Floats:
        """How much the best of some hulls is like each that is compared."""
        found: Floats = np.exp(-((cdist(rows[hulls], some) / near) ** 2) / 2).max(axis=0, initial=0.0)
        return found

    covered = alike(evenly(family.labelled, _HULLS))
    starts = np.searchsorted(family.owner, open_meshes)
    ends = np.searchsorted(family.owner, open_meshes, side="right")
    stands = np.stack([alike(np.arange(start, end)) for start, end in zip(starts, ends, strict=True)])
    found: list[int] = []
    for _ in range(min(count, len(open_meshes))):
        gains = (np.maximum(stands - covered, 0.0) * doubt).sum(axis=1)
        gains[found] = -1.0
        found.append(int(first_greatest(gains)))
        covered = np.maximum(covered, stands[found[-1]])
    return [int(open_meshes[place]) for place in found]
