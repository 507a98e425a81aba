"""A grid of cubic cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Aabb, Floats, Ints

Mask = npt.NDArray[np.bool_]
"""Which cells (x, y, z) of a grid have a property."""

CELLS = 112
"""Cells along the diagonal of what a grid is around, by default."""
MOST = 8_000_000
"""Cells of a grid at most; about 200 MB with all that is computed on them."""
_PAD = 2


@dataclass(frozen=True, eq=False, slots=True)
class Grid:
    """Cells of side `cell` [m] from `origin` (3,) [m], the corner of the first one; shape: how many along each axis."""

    origin: Floats
    cell: float
    shape: tuple[int, int, int]

    def cells_of(self, points: Floats) -> Ints:
        """The cell (n, 3) of each point (n, 3), the nearest one for points outside."""
        steps = np.floor((points - self.origin) / self.cell)
        return np.clip(steps, 0, np.array(self.shape) - 1).astype(np.int64)

    def cell_centers(self, axis: int) -> Floats:
        """The coordinates (k,) of the middles of the cells along an axis [m]."""
        middles: Floats = self.origin[axis] + (np.arange(self.shape[axis]) + 0.5) * self.cell
        return middles

    def litres(self, mask: Mask) -> float:
        """The volume of some cells [l]."""
        return float(np.count_nonzero(mask)) * self.cell**3 * 1000

    def empty_mask(self) -> Mask:
        return np.zeros(self.shape, dtype=bool)


def grid_around(bounds: Aabb, cell: float | None = None) -> Grid:
    """A grid around a box, with two free cells on each side; cell: its side [m], by default the diagonal by 112.

    A cell that would give more than 8 million of them is made larger.
    """
    size = cell or bounds.diagonal / CELLS
    size = max(size, float(np.cbrt(np.prod(bounds.size + 1e-9) / MOST)), bounds.diagonal * 1e-4)
    while True:
        counts = np.ceil(bounds.size / size).astype(int) + 2 * _PAD
        if np.prod(counts.astype(float)) <= MOST:
            break
        size *= 1.1
    origin = bounds.center - counts * size / 2
    return Grid(origin, size, (int(counts[0]), int(counts[1]), int(counts[2])))
