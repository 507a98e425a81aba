"""Cells as a surface to look at."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Surface
from meshforge.checks.space.grid import Grid, Mask
from meshforge.geometry import Floats, Ints


def blocks(grid: Grid, mask: Mask) -> Surface:
    """The faces of some cells towards others, as triangles that look outwards."""
    quads = [_faces(mask, axis, side) for axis in range(3) for side in (0, 1)]
    corners = np.concatenate(quads) if quads else np.zeros((0, 4, 3), np.int64)
    vertices, inverse = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    ring: Ints = inverse.reshape(-1, 4)
    faces = np.concatenate([ring[:, [0, 1, 2]], ring[:, [0, 2, 3]]])
    places: Floats = grid.origin + vertices * grid.cell
    return Surface(places, faces)


def _faces(mask: Mask, axis: int, side: int) -> Ints:
    """The corners (n, 4, 3) of the faces on one side of cells, counter-clockwise seen from outside."""
    padded = np.pad(mask, 1)
    beside = np.roll(padded, -1 if side else 1, axis)[1:-1, 1:-1, 1:-1]
    cells = np.argwhere(mask & ~beside)
    first, second = np.eye(3, dtype=np.int64)[[(axis + 1) % 3, (axis + 2) % 3]]
    start = cells + side * np.eye(3, dtype=np.int64)[axis]
    ring = [start, start + first, start + first + second, start + second]
    return np.stack(ring if side else ring[::-1], axis=1)
