"""Casting with fewer rays, for pictures in which no pixel is counted."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.views.camera import Camera
from meshforge.views.outline import along
from meshforge.views.scene import Scene, rays
from meshforge.views.stage import Hits, window_of

_EVEN = np.cos(np.radians(9.0))  # surfaces that turn less than this from one ray to the next but one are even
_STEP, _LOW = 0.012, 0.005  # how far behind another a surface is at a step, somewhere and everywhere, in diagonals


def met_roughly(scene: Scene, camera: Camera) -> Hits:
    """The first thing of a scene behind each pixel, found by one ray for four pixels where it is even.

    What is thinner than two pixels may be missed.
    """
    return _met(scene, camera, stepping=False)[0]


def met_with_steps(scene: Scene, camera: Camera) -> tuple[Hits, Any]:
    """The same, and at which pixels (h, w) one part of a thing steps back behind another part of it."""
    return _met(scene, camera, stepping=True)


def _met(scene: Scene, camera: Camera, stepping: bool) -> tuple[Hits, Any]:
    triangle = np.full(camera.size[::-1], -1, np.int64)
    item, steps = triangle.copy(), np.zeros(triangle.shape, bool)
    if len(scene.corners) == 0:
        return Hits(scene, triangle, item, (slice(0, 0), slice(0, 0))), steps
    start = float((scene.corners.reshape(-1, 3) @ camera.axes[2]).max()) + 0.1
    x, y = window_of(scene, camera)
    columns, rows = np.arange(x.start, x.stop, 2), np.arange(y.start, y.stop, 2)
    seen = scene.embree.run(*rays(camera, columns, rows, start), query="INTERSECT").reshape(len(rows), len(columns))
    uneven = _uneven(scene, seen)
    if stepping:
        back = _steps(seen, np.append(scene.item, -1)[seen], _depths(scene, camera, seen, x, y))
        steps[y, x] = _finer(_spread(back), x, y)
        uneven |= back
    fine = _finer(seen, x, y)
    between = _finer(_spread(uneven), x, y)
    between[::2, ::2] = False
    r, c = np.nonzero(between)
    aside, directions = camera.pixel_rays(c + x.start, r + y.start)
    origins = (aside + camera.axes[2] * start).astype(np.float32)
    fine[r, c] = scene.embree.run(origins, directions.astype(np.float32), query="INTERSECT")
    triangle[y, x], item[y, x] = fine, np.append(scene.item, -1)[fine]
    hits = Hits(scene, triangle, item, (y, x))
    return hits, _edges(hits, camera, steps)


def _finer(coarse: Any, x: slice, y: slice) -> Any:
    """A picture of every second pixel with each doubled along both sides."""
    return coarse.repeat(2, axis=0).repeat(2, axis=1)[: y.stop - y.start, : x.stop - x.start]


def _spread(mask: Any) -> Any:
    """The set cells, and those before them, whose pixels lie between."""
    out = mask.copy()
    out[:, :-1] |= mask[:, 1:]
    out[:-1] |= out[1:]
    return out


def _uneven(scene: Scene, seen: Ints) -> Any:
    """Which rays (h, w) show another thing, or another slope, than the one before them."""
    item, normals = np.append(scene.item, -1), np.concatenate([scene.normals, np.zeros((1, 3))]).astype(np.float32)
    uneven = np.zeros(seen.shape, bool)
    for axis in (0, 1):
        here, there = along(axis)
        at = np.nonzero(seen[here] != seen[there])
        a, b = seen[here][at], seen[there][at]
        turned = np.einsum("ij,ij->i", normals[a], normals[b]) < _EVEN
        uneven[there][at] |= turned | (item[a] != item[b])
    return uneven


def _depths(scene: Scene, camera: Camera, seen: Ints, x: slice, y: slice) -> Floats:
    """How far along its ray each hit (h, w) lies."""
    rows, columns = np.nonzero(seen >= 0)
    depth = np.zeros(seen.shape)
    depth[rows, columns] = scene.depth(seen[rows, columns], *camera.pixel_rays(2 * columns + x.start, 2 * rows + y.start))
    return depth


def _steps(seen: Ints, item: Ints, depth: Floats) -> Any:
    """Which rays (h, w) go much farther or less far than the one before them, and not as part of a slope."""
    from scipy.ndimage import label

    low, high = np.zeros(seen.shape, bool), np.zeros(seen.shape, bool)
    for axis in (0, 1):
        here, there = along(axis)
        rise = np.abs(depth[there] - depth[here])
        slope = np.zeros_like(rise)
        slope[there] = rise[here]
        np.maximum(slope[here], rise[there], out=slope[here])
        same = (item[here] == item[there]) & (seen[here] >= 0)
        low[there] |= same & (rise > 2.5 * slope + _LOW)
        high[there] |= same & (rise > 2.5 * slope + _STEP)
    parts, count = label(low, np.ones((3, 3)))
    kept = np.zeros(count + 1, bool)
    kept[parts[high]] = True
    return kept[parts] & low


def _edges(hits: Hits, camera: Camera, about: Any) -> Any:
    """The pixels (h, w) among those about steps that are next to one much farther or less far, of the same thing."""
    rows, columns = np.nonzero(about & (hits.item >= 0))
    edges, depth = np.zeros(about.shape, bool), np.full(about.shape, np.nan)
    depth[rows, columns] = own = hits.depth(camera, rows, columns)
    for down, right in ((1, 0), (0, 1)):
        beside = np.minimum(rows + down, about.shape[0] - 1), np.minimum(columns + right, about.shape[1] - 1)
        stepped = (np.abs(depth[beside] - own) > _LOW) & (hits.item[beside] == hits.item[rows, columns])
        edges[rows[stepped], columns[stepped]] = True
        edges[beside[0][stepped], beside[1][stepped]] = True
    return edges
