"""The cells that surfaces cross, and those that hulls fill."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from meshforge.checks.space.grid import Grid, Mask
from meshforge.checks.space.sampling import samples_of
from meshforge.geometry import Floats, Shape
from meshforge.geometry.heights import planes_of

_SPACING = 0.44  # of points on a surface, in cells: so each point has one within half a cell, and nothing slips through
_AT_ONCE = 2_000_000  # columns times planes
_LEVEL = 1e-12


def crossed(grid: Grid, corners: Floats) -> Mask:
    """The cells that triangles, corners (m, 3, 3), cross; no path through faces of other cells leads past them."""
    mask = grid.empty_mask()
    for samples in samples_of(corners, _SPACING * grid.cell):
        x, y, z = grid.cells_of(samples.points).T
        mask[x, y, z] = True
    return mask


def filled(grid: Grid, shapes: Iterable[Shape]) -> Mask:
    """The cells whose middles are inside of any of some shapes; round ones count as their tessellations."""
    mask = grid.empty_mask()
    for shape in shapes:
        _fill(grid, shape, mask)
    return mask


def _fill(grid: Grid, shape: Shape, mask: Mask) -> None:
    """Column by column: the planes of a hull leave an interval of heights of each."""
    hull = shape.tessellate()
    planes = planes_of(hull.vertices, hull.faces)
    low, high = grid.cells_of(np.array([hull.aabb.min, hull.aabb.max]))
    xs, ys = grid.cell_centers(0)[low[0] : high[0] + 1], grid.cell_centers(1)[low[1] : high[1] + 1]
    heights = grid.cell_centers(2)[low[2] : high[2] + 1]
    flat = np.array([(x, y) for x in xs for y in ys]) - planes.middle[:2]
    rows = max(1, _AT_ONCE // max(len(planes.offsets), 1))
    parts = [_interval(flat[k : k + rows], planes.normals, planes.offsets) for k in range(0, len(flat), rows)]
    bottom, top = (np.concatenate([part[k] for part in parts]) + planes.middle[2] for k in (0, 1))
    inside = (heights >= bottom[:, None]) & (heights <= top[:, None])
    box = (slice(low[0], high[0] + 1), slice(low[1], high[1] + 1), slice(low[2], high[2] + 1))
    mask[box] |= inside.reshape(len(xs), len(ys), len(heights))


def _interval(flat: Floats, normals: Floats, offsets: Floats) -> tuple[Floats, Floats]:
    """The lowest and the highest height (n,) of a hull at places (n, 2), from its middle; none where low is above."""
    room = offsets - flat @ normals[:, :2].T
    rise = normals[:, 2]
    up, down = rise > _LEVEL, rise < -_LEVEL
    top = (room[:, up] / rise[up]).min(axis=1, initial=np.inf)
    bottom = (room[:, down] / rise[down]).max(axis=1, initial=-np.inf)
    beside = (room[:, ~(up | down)] < 0).any(axis=1)
    return np.where(beside, np.inf, bottom), top
