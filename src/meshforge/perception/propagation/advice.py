"""Which asset to label next: the one whose hulls stand for most hulls that no labelled one is like."""

from __future__ import annotations

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats, Ints
from meshforge.perception.propagation.describe import SHAPES
from meshforge.perception.propagation.family import UNTOLD, Family, evenly

_HULLS, _MESHES = 3000, 2000  # that are compared at most, evenly chosen of more
_NEAR = 0.35  # of the median distance of hulls, within which they stand for each other


def chosen(family: Family, count: int) -> list[int]:
    """The meshes to label next, the best first; those without an untold hull are not among them."""
    open_meshes = evenly(np.unique(family.owner[family.codes == UNTOLD]), _MESHES)
    rows = family.rows[:, SHAPES]
    some = rows[evenly(np.arange(len(rows)), _HULLS)]
    if not len(open_meshes):
        return []
    near = max(float(np.median(cdist(some, some))) * _NEAR, 1e-9)

    def alike(hulls: Ints) -> Floats:
        """How much the best of some hulls is like each that is compared."""
        found: Floats = np.exp(-((cdist(rows[hulls], some) / near) ** 2) / 2).max(axis=0, initial=0.0)
        return found

    covered = alike(evenly(family.told, _HULLS))
    starts = np.searchsorted(family.owner, open_meshes)
    ends = np.searchsorted(family.owner, open_meshes, side="right")
    stands = np.stack([alike(np.arange(start, end)) for start, end in zip(starts, ends, strict=True)])
    found: list[int] = []
    for _ in range(min(count, len(open_meshes))):
        gains = np.round(np.maximum(stands - covered, 0.0).sum(axis=1), 9)
        gains[found] = -1.0
        found.append(int(np.argmax(gains)))
        covered = np.maximum(covered, stands[found[-1]])
    return [int(open_meshes[place]) for place in found]
