"""Where things could lie on, lie in and go through parts of an asset: found from the parts alone, before an edit, so
that whatever else is there is in the way."""

from collections.abc import Sequence

import numpy as np

from meshforge.checks.grid import (
    Grid,
    Mask,
    flood_from_outside,
    grid_around,
    heights_at,
    voxelize_hulls,
    voxelize_surface,
)
from meshforge.checks.physics.scene import Place
from meshforge.checks.surface_samples import join_corners
from meshforge.common import GeometryError
from meshforge.geometry import Aabb, Bools, Floats, Polytope, convex_hull
from meshforge.symbolic import Hull, Surface

_NEAR = 2.0  # cells, that what is shown may be away from the hulls of a part
_LEAST = 2  # cells along each side of a room or an opening


def measure_tops(hulls: Sequence[Hull], places: Floats) -> Floats:
    """Return how high hulls reach (n,) [m] at places (n, 2), -inf where none of them is."""
    tops = np.full(len(places), -np.inf)
    for hull in hulls:
        low, high = heights_at(hull.shape, places)
        tops = np.where(low <= high, np.maximum(tops, high), tops)
    return tops


def is_over(hulls: Sequence[Hull], places: Floats) -> Bools:
    """Return which places (n, 2) are over hulls, or over a gap between them: (n,)."""
    whole = _hull_around(hulls)
    low, high = heights_at(whole, places) if whole else (np.ones(len(places)), np.zeros(len(places)))
    over: Bools = low <= high
    return over


def find_room(hulls: Sequence[Hull], surfaces: Sequence[Surface]) -> Place | None:
    """Return the largest box of free space in a part, None without one; size: half sides [m].

    The part is what is shown beside its hulls, or else the hulls. Free is what can be reached from outside, within the
    convex hull of the part and above some of it.
    """
    whole = _hull_around(hulls)
    if whole is None:
        return None
    grid = grid_around(whole.aabb)
    around = voxelize_hulls(grid, [whole])
    taken = _voxelize_shown(grid, surfaces, hulls, around)
    if not taken.any():
        taken = voxelize_hulls(grid, [hull.shape for hull in hulls])
    above = np.maximum.accumulate(taken, axis=2)
    return _largest_box(grid, flood_from_outside(taken) & around & above)


def find_way(hulls: Sequence[Hull], axis: int) -> Place | None:
    """Return the largest straight way along an axis through the opening that hulls leave, None without one.

    It begins at `at`, where the hulls do; size: its length, and half sides of the opening [m].
    """
    whole = _hull_around(hulls)
    if whole is None:
        return None
    grid = grid_around(whole.aabb)
    seen = voxelize_hulls(grid, [hull.shape for hull in hulls]).any(axis=axis, keepdims=True)
    free: Mask = np.asarray(voxelize_hulls(grid, [whole]).any(axis=axis, keepdims=True) & ~seen)
    others = [k for k in range(3) if k != axis]
    flat = Grid(grid.origin, grid.cell, tuple(1 if k == axis else n for k, n in enumerate(grid.shape)))  # type: ignore[arg-type]
    box = _largest_box(flat, free, others)
    if box is None:
        return None
    at, axes = box.at.copy(), np.eye(3)[:, [axis, *others]]
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    at[axis] = whole.aabb.min[axis]
    return Place(at, np.array([whole.aabb.size[axis], *box.size[others]]), axes)


def end_inside(way: Place, others: Sequence[Hull], outward: Floats, past: float) -> Place:
    """Return a way up to where its inner half meets what closes its inner end, such as the body behind a spout.

    others: hulls that may do so, in the frame of the way; outward: (3,), towards its outer end; past: how far a probe
    reaches beyond its ends [m].
    """
    axis = int(np.abs(way.axes[:, 0]).argmax())
    inward, length = -float(np.copysign(1.0, outward[axis])), float(way.size[0])
    half = np.abs(way.axes) @ np.array([0.0, *way.size[1:]])
    inner = way.at[axis] + (length if inward > 0 else 0.0)
    low, high = way.at - half, way.at + half
    low[axis], high[axis] = sorted((inner + inward * past, inner - inward * length / 2))
    boxes = [box for one in others if (box := clip_hull(one, Aabb(low, high)))]
    found = [sorted(inward * (side[axis] - inner) for side in (box.min, box.max)) for box in boxes]
    cut = past - min((begin for begin, _ in found), default=past)
    if not 0.0 < cut < length or all(end < 0.0 for _, end in found):
        return way
    at = way.at + (cut * np.eye(3)[axis] if inward < 0 else 0.0)
    return Place(at, np.array([length - cut, *way.size[1:]]), way.axes)


def clip_hull(hull: Hull, window: Aabb) -> Aabb | None:
    """Return the box around what of a hull lies in a box, None where nothing does."""
    from manifold3d import Manifold  # lazy: few commands need it

    if (hull.aabb.min > window.max).any() or (hull.aabb.max < window.min).any():
        return None
    room = Manifold.cube(window.size.tolist(), center=True).translate(window.center.tolist())
    inside = Manifold.hull_points(hull.vertices) ^ room
    box = inside.bounding_box()
    return None if inside.is_empty() else Aabb(box[:3], box[3:])


def _hull_around(hulls: Sequence[Hull]) -> Polytope | None:
    points = np.concatenate([hull.vertices for hull in hulls])
    try:
        return convex_hull(points)
    except GeometryError:  # flat
        return None


def _voxelize_shown(grid: Grid, surfaces: Sequence[Surface], hulls: Sequence[Hull], around: Mask) -> Mask:
    """The cells of what is shown that are near to a part, of its bodies where the file tells these."""
    from scipy.ndimage import binary_dilation  # lazy: 0.3 s

    bodies = {hull.body for hull in hulls}
    shown = [one for one in surfaces if one.body is None or one.body in bodies]
    if not shown:
        return grid.empty_mask()
    corners = join_corners(shown)
    low, high = grid.origin, grid.origin + grid.cell * np.array(grid.shape)
    inside = (corners.max(axis=1) >= low).all(axis=1) & (corners.min(axis=1) <= high).all(axis=1)
    if not inside.any():
        return grid.empty_mask()
    return voxelize_surface(grid, corners[inside]) & binary_dilation(around, iterations=int(_NEAR))


def _largest_box(grid: Grid, free: Mask, axes: Sequence[int] = (0, 1, 2)) -> Place | None:
    """The box that grows from the largest cube of free cells, along some axes."""
    from scipy.ndimage import distance_transform_cdt  # lazy: 0.3 s

    padded = np.pad(free, [(1, 1) if k in axes else (0, 0) for k in range(3)])
    flat = padded.squeeze(axis=tuple(k for k in range(3) if k not in axes))
    reach = distance_transform_cdt(flat, metric="chessboard").reshape(padded.shape)
    best = np.unravel_index(int(reach.argmax()), reach.shape)
    half = int(reach[best]) - 1
    if 2 * half + 1 < _LEAST:
        return None
    low = np.array([best[k] - half if k in axes else 0 for k in range(3)])
    high = np.array([best[k] + half + 1 if k in axes else 1 for k in range(3)])
    grows = True
    while grows:
        grows = False
        for axis in axes:
            for side in (low, high):
                more = (low.copy(), high.copy())
                at = int(side[axis]) - 1 if side is low else int(side[axis])
                more[0][axis], more[1][axis] = at, at + 1
                if padded[tuple(slice(a, b) for a, b in zip(*more, strict=True))].all():
                    side[axis] += -1 if side is low else 1
                    grows = True
    shift = np.array([1 if k in axes else 0 for k in range(3)])
    box = Aabb(grid.origin + (low - shift) * grid.cell, grid.origin + (high - shift) * grid.cell)
    return Place(box.center, box.size / 2, np.eye(3))
