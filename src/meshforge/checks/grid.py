"""Space in cubic cells: what surfaces cross and hulls fill, what can be reached from outside, and pockets."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from meshforge.checks.surface_samples import sample_triangles
from meshforge.geometry import Aabb, Floats, Ints, Shape, planes_of
from meshforge.symbolic import Surface

Mask = npt.NDArray[np.bool_]
"""Which cells (x, y, z) of a grid have a property."""

CELLS = 112
"""Cells along the diagonal of what a grid is around, by default."""
MOST_CELLS = 8_000_000
"""Cells of a grid at most; about 200 MB with all that is computed on them."""
_PAD = 2

_SPACING = 0.44  # of points on a surface, in cells: so each point has one within half a cell, and nothing slips through
_AT_ONCE = 2_000_000  # columns times planes
_LEVEL = 1e-12
_LEAST_POCKET = 27  # cells


@dataclass(frozen=True, eq=False, slots=True)
class Grid:
    """Cells of side `cell` [m] from `origin` (3,) [m], the corner of the first one; shape: how many along each axis."""

    origin: Floats
    cell: float
    shape: tuple[int, int, int]

    def cells_of(self, points: Floats) -> Ints:
        """Return the cell (n, 3) of each point (n, 3), the nearest one for points outside."""
        return np.clip(np.floor((points - self.origin) / self.cell), 0, np.array(self.shape) - 1).astype(np.int64)

    def cell_centers(self, axis: int) -> Floats:
        """Return the coordinates (k,) of the middles of the cells along an axis [m]."""
        middles: Floats = self.origin[axis] + (np.arange(self.shape[axis]) + 0.5) * self.cell
        return middles

    def litres(self, mask: Mask) -> float:
        """Return the volume of some cells [l]."""
        return float(np.count_nonzero(mask)) * self.cell**3 * 1000

    def empty_mask(self) -> Mask:
        return np.zeros(self.shape, dtype=bool)


def grid_around(bounds: Aabb, cell: float | None = None) -> Grid:
    """Return a grid around a box, with two free cells on each side; cell: its side [m], by default the diagonal by 112.

    A cell that would give more than 8 million of them is made larger.
    """
    size = cell or bounds.diagonal / CELLS
    size = max(size, float(np.cbrt(np.prod(bounds.size + 1e-9) / MOST_CELLS)), bounds.diagonal * 1e-4)
    while True:
        counts = np.ceil(bounds.size / size).astype(int) + 2 * _PAD
        if np.prod(counts.astype(float)) <= MOST_CELLS:
            break
        size *= 1.1
    return Grid(bounds.center - counts * size / 2, size, (int(counts[0]), int(counts[1]), int(counts[2])))


def voxelize_surface(grid: Grid, corners: Floats) -> Mask:
    """Return the cells that triangles, corners (m, 3, 3), cross; no path through faces of others leads past."""
    mask = grid.empty_mask()
    for samples in sample_triangles(corners, _SPACING * grid.cell):
        x, y, z = grid.cells_of(samples.points).T
        mask[x, y, z] = True
    return mask


def voxelize_hulls(grid: Grid, shapes: Iterable[Shape]) -> Mask:
    """Return the cells whose middles are inside of any of some shapes; round ones count as their tessellations."""
    mask = grid.empty_mask()
    for shape in shapes:
        _fill_hull(grid, shape, mask)
    return mask


def _fill_hull(grid: Grid, shape: Shape, mask: Mask) -> None:
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


def heights_at(shape: Shape, places: Floats) -> tuple[Floats, Floats]:
    """Return the lowest and the highest height (n,) of a shape at places (n, 2) [m]; where it is not, low is above."""
    hull = shape.tessellate()
    planes = planes_of(hull.vertices, hull.faces)
    bottom, top = _interval(places - planes.middle[:2], planes.normals, planes.offsets)
    return bottom + planes.middle[2], top + planes.middle[2]


def _interval(flat: Floats, normals: Floats, offsets: Floats) -> tuple[Floats, Floats]:
    """The lowest and the highest height (n,) of a hull at places (n, 2), from its middle; none where low is above."""
    room = offsets - flat @ normals[:, :2].T
    rise = normals[:, 2]
    up, down = rise > _LEVEL, rise < -_LEVEL
    top = (room[:, up] / rise[up]).min(axis=1, initial=np.inf)
    bottom = (room[:, down] / rise[down]).max(axis=1, initial=-np.inf)
    return np.where((room[:, ~(up | down)] < 0).any(axis=1), np.inf, bottom), top


def flood_from_outside(taken: Mask) -> Mask:
    """Return the free cells that a path through faces of free cells joins to the border of the grid, which is free."""
    from scipy.ndimage import label  # lazy: 0.3 s, only clearance needs it

    parts, _ = label(~taken)
    return np.asarray(parts == parts[0, 0, 0])


def find_pockets(mask: Mask) -> tuple[Ints, int]:
    """Return connected groups of cells, numbered from 1 in order of size, the largest first, and how many there are.

    Layers of one or two cells, in which rounding to cells shows, belong to none; nor do groups of fewer than 27.
    """
    from scipy.ndimage import binary_dilation, binary_opening, generate_binary_structure, label  # lazy: 0.3 s

    cross = generate_binary_structure(3, 1)
    parts, count = label(binary_dilation(binary_opening(mask, cross), cross) & mask, cross)
    sizes = np.bincount(parts.ravel(), minlength=count + 1)
    sizes[0] = 0
    order = np.argsort(-sizes, kind="stable")[: int((sizes >= _LEAST_POCKET).sum())]
    number = np.zeros(count + 1, np.int64)
    number[order] = np.arange(1, len(order) + 1)
    return number[parts], len(order)


def cells_to_surface(grid: Grid, mask: Mask) -> Surface:
    """Return the faces of some cells towards others, as triangles that look outwards."""
    quads = [_boundary_faces(mask, axis, side) for axis in range(3) for side in (0, 1)]
    corners = np.concatenate(quads) if quads else np.zeros((0, 4, 3), np.int64)
    vertices, inverse = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    ring: Ints = inverse.reshape(-1, 4)
    faces = np.concatenate([ring[:, [0, 1, 2]], ring[:, [0, 2, 3]]])
    return Surface(grid.origin + vertices * grid.cell, faces)


def _boundary_faces(mask: Mask, axis: int, side: int) -> Ints:
    """The corners (n, 4, 3) of the faces on one side of cells, counter-clockwise seen from outside."""
    beside = np.roll(np.pad(mask, 1), -1 if side else 1, axis)[1:-1, 1:-1, 1:-1]
    cells = np.argwhere(mask & ~beside)
    first, second = np.eye(3, dtype=np.int64)[[(axis + 1) % 3, (axis + 2) % 3]]
    start = cells + side * np.eye(3, dtype=np.int64)[axis]
    ring = [start, start + first, start + first + second, start + second]
    return np.stack(ring if side else ring[::-1], axis=1)
