"""Which cells can be reached from outside, and pockets of cells."""

from __future__ import annotations

import numpy as np

from meshforge.checks.space.grid import Mask
from meshforge.geometry import Ints


def reached(taken: Mask) -> Mask:
    """The free cells that a path through faces of free cells joins to the border of the grid, which is free."""
    from scipy.ndimage import label

    parts, _ = label(~taken)
    return np.asarray(parts == parts[0, 0, 0])


def pockets(mask: Mask, least: int = 27) -> tuple[Ints, int]:
    """Connected groups of cells, numbered from 1 in order of size, the largest first, and how many there are.

    Layers of one or two cells, in which rounding to cells shows, belong to none; nor do groups of fewer than `least`.
    """
    from scipy.ndimage import binary_dilation, binary_opening, generate_binary_structure, label

    cross = generate_binary_structure(3, 1)
    deep = binary_dilation(binary_opening(mask, cross), cross) & mask
    parts, count = label(deep, cross)
    sizes = np.bincount(parts.ravel(), minlength=count + 1)
    sizes[0] = 0
    order = np.argsort(-sizes, kind="stable")[: int((sizes >= least).sum())]
    number = np.zeros(count + 1, np.int64)
    number[order] = np.arange(1, len(order) + 1)
    return number[parts], len(order)
