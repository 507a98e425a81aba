"""What each pixel shows: layers of things in a frame of unit size, one ray a pixel, or fewer where surfaces are
even."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.geometry import Aabb, Floats, Ints
from meshforge.rendering.camera import Camera, Up
from meshforge.rendering.filters import keep_reached
from meshforge.rendering.scene import RayScene, RenderMesh, build_scene, prepare_for_rays, window_rays

_BORDER = 8  # pixels about what can be seen, so that its outline has room

_EVEN_COSINE = np.cos(np.radians(9.0))  # surfaces that turn less than this from one ray to the next but one are even
_STEP, _LOW = 0.012, 0.005  # how far behind another a surface is at a step, somewhere and everywhere, in diagonals


@dataclass(frozen=True, eq=False, slots=True)
class DrawLayer:
    """Things drawn together. colors: (k, 3), sRGB in 0..1, one for each render_mesh.

    solid things hide what is behind them. Shells do not: `before` and `behind` are how much of them shows before and
    behind solid things; of a shell in front of `drawn_over` solid things only the lines show. hatched: which of them
    are striped. tint: colours (n, 3) of points (n, 3) [m] that some of them (n,) show, instead of `colors`.
    """

    render_meshes: Sequence[RenderMesh]
    colors: Floats
    solid: bool = True
    before: float = 1.0
    behind: float = 0.0
    hatched: frozenset[int] = frozenset()
    drawn_over: frozenset[int] = frozenset()
    tint: Callable[[Floats, Ints], Floats] | None = None


@dataclass(frozen=True, eq=False, slots=True)
class ViewFrame:
    """The frame that things are drawn in: middle and diagonal of `bounds` become origin and unit; upright: (3,)."""

    bounds: Aabb
    upright: Floats

    @property
    def unit(self) -> float:
        return self.bounds.diagonal or 1.0

    def to_unit(self, points: Floats) -> Floats:
        return (points - self.bounds.center) / self.unit

    def from_unit(self, points: Floats) -> Floats:
        return points * self.unit + self.bounds.center

    @property
    def ground_axes(self) -> list[int]:
        """The two axes along the ground."""
        return [k for k in range(3) if not self.upright[k]]

    @property
    def ground_height(self) -> float:
        """The height of the lowest point."""
        return float((self.to_unit(self.bounds.corners) @ self.upright).min())


def up_vector(up: Up) -> Floats:
    """Return the direction (3,) that points up."""
    return np.array([0.0, 0.0, 1.0] if up == "Z" else [0.0, 1.0, 0.0])


@dataclass(frozen=True, eq=False, slots=True)
class RayHits:
    """What the pixels of a picture show: triangle and item (h, w), -1 for nothing; nothing outside the window."""

    scene: RayScene
    triangle: Ints
    item: Ints
    window: tuple[slice, slice]

    def points(self, camera: Camera, rows: Ints, columns: Ints) -> Floats:
        """Return where the rays through some pixels (n,), each of which shows something, meet it (n, 3)."""
        origins, directions = camera.pixel_rays(columns, rows)
        return origins + directions * self.scene.depth(self.triangle[rows, columns], origins, directions)[:, None]

    def depth(self, camera: Camera, rows: Ints, columns: Ints) -> Floats:
        """Return how far along their rays (n,) those places are."""
        return self.scene.depth(self.triangle[rows, columns], *camera.pixel_rays(columns, rows))


def cast_layer(layer: DrawLayer, frame: ViewFrame, camera: Camera) -> RayHits:
    """Return the first thing of a layer behind each pixel."""
    return cast_rays(build_scene(layer.render_meshes, frame.bounds.center, frame.unit), camera)


def cast_rays(whole: RayScene, camera: Camera, window: tuple[slice, slice] | None = None) -> RayHits:
    """Return the first thing of an assembled scene behind each pixel; window: the columns and rows to look in, by
    default those that it can be seen in."""
    scene = prepare_for_rays(whole, camera.axes[2]) if whole.embree is None else whole
    width, height = camera.size
    triangle = np.full((height, width), -1, np.int64)
    if len(scene.corners) == 0:
        return RayHits(scene, triangle, triangle.copy(), (slice(0, 0), slice(0, 0)))
    start = float((scene.corners.reshape(-1, 3) @ camera.axes[2]).max()) + 0.1
    x, y = window or window_of(scene, camera)
    origins, directions = window_rays(camera, np.arange(x.start, x.stop), np.arange(y.start, y.stop), start)
    seen = scene.embree.run(origins, directions, query="INTERSECT")
    triangle[y, x] = seen.reshape(y.stop - y.start, x.stop - x.start)
    item = np.full(triangle.shape, -1, np.int64)
    item[y, x] = np.append(scene.item, -1)[triangle[y, x]]
    return RayHits(scene, triangle, item, (y, x))


def window_of(scene: RayScene, camera: Camera) -> tuple[slice, slice]:
    """Return the columns and rows that the scene can be seen in."""
    places = np.ascontiguousarray(
        camera.to_pixels(scene.corners.reshape(-1, 3)).T
    )  # extremes of rows are found quickly
    low = np.clip(np.floor(places.min(axis=1)).astype(int) - _BORDER, 0, camera.size)
    high = np.clip(np.ceil(places.max(axis=1)).astype(int) + 1 + _BORDER, low, camera.size)
    return slice(int(low[0]), int(high[0])), slice(int(low[1]), int(high[1]))


def cast_rays_adaptively(scene: RayScene, camera: Camera) -> RayHits:
    """Return the first thing of a scene behind each pixel, found by one ray for four pixels where it is even.

    What is thinner than two pixels may be missed.
    """
    return _cast_adaptively(scene, camera, stepping=False)[0]


def cast_rays_with_steps(scene: RayScene, camera: Camera) -> tuple[RayHits, Any]:
    """Return the hits as `cast_rays_adaptively` finds them, and at which pixels (h, w) a thing steps back behind
    itself."""
    return _cast_adaptively(scene, camera, stepping=True)


def _cast_adaptively(scene: RayScene, camera: Camera, stepping: bool) -> tuple[RayHits, Any]:
    triangle = np.full(camera.size[::-1], -1, np.int64)
    item, steps = triangle.copy(), np.zeros(triangle.shape, bool)
    if len(scene.corners) == 0:
        return RayHits(scene, triangle, item, (slice(0, 0), slice(0, 0))), steps
    start = float((scene.corners.reshape(-1, 3) @ camera.axes[2]).max()) + 0.1
    x, y = window_of(scene, camera)
    columns, rows = np.arange(x.start, x.stop, 2), np.arange(y.start, y.stop, 2)
    seen = scene.embree.run(*window_rays(camera, columns, rows, start), query="INTERSECT").reshape(
        len(rows), len(columns)
    )
    uneven = _find_uneven(scene, seen)
    if stepping:
        back = _find_steps(seen, np.append(scene.item, -1)[seen], _find_depths(scene, camera, seen, x, y))
        steps[y, x] = _upsample(_dilate(back), x, y)
        uneven |= back
    fine = _upsample(seen, x, y)
    between = _upsample(_dilate(uneven), x, y)
    between[::2, ::2] = False
    r, c = np.nonzero(between)
    aside, directions = camera.pixel_rays(c + x.start, r + y.start)
    origins = (aside + camera.axes[2] * start).astype(np.float32)
    fine[r, c] = scene.embree.run(origins, directions.astype(np.float32), query="INTERSECT")
    triangle[y, x], item[y, x] = fine, np.append(scene.item, -1)[fine]
    hits = RayHits(scene, triangle, item, (y, x))
    return hits, _find_edges(hits, camera, steps)


def _upsample(coarse: Any, x: slice, y: slice) -> Any:
    return coarse.repeat(2, axis=0).repeat(2, axis=1)[: y.stop - y.start, : x.stop - x.start]


def _dilate(mask: Any) -> Any:
    """The set cells, and those before them, whose pixels lie between."""
    out = mask.copy()
    out[:, :-1] |= mask[:, 1:]
    out[:-1] |= out[1:]
    return out


def _find_uneven(scene: RayScene, seen: Ints) -> Any:
    """Which rays (h, w) show another thing, or another slope, than the one before them."""
    item, normals = np.append(scene.item, -1), np.concatenate([scene.normals, np.zeros((1, 3))]).astype(np.float32)
    uneven = np.zeros(seen.shape, bool)
    for axis in (0, 1):
        here, there = neighbour_slices(axis)
        at = np.nonzero(seen[here] != seen[there])
        a, b = seen[here][at], seen[there][at]
        turned = np.einsum("ij,ij->i", normals[a], normals[b]) < _EVEN_COSINE
        uneven[there][at] |= turned | (item[a] != item[b])
    return uneven


def _find_depths(scene: RayScene, camera: Camera, seen: Ints, x: slice, y: slice) -> Floats:
    rows, columns = np.nonzero(seen >= 0)
    depth = np.zeros(seen.shape)
    depth[rows, columns] = scene.depth(
        seen[rows, columns], *camera.pixel_rays(2 * columns + x.start, 2 * rows + y.start)
    )
    return depth


def _find_steps(seen: Ints, item: Ints, depth: Floats) -> Any:
    """Which rays (h, w) go much farther or less far than the one before them, and not as part of a slope."""
    low, high = np.zeros(seen.shape, bool), np.zeros(seen.shape, bool)
    for axis in (0, 1):
        here, there = neighbour_slices(axis)
        rise = np.abs(depth[there] - depth[here])
        slope = np.zeros_like(rise)
        slope[there] = rise[here]
        np.maximum(slope[here], rise[there], out=slope[here])
        same = (item[here] == item[there]) & (seen[here] >= 0)
        low[there] |= same & (rise > 2.5 * slope + _LOW)
        high[there] |= same & (rise > 2.5 * slope + _STEP)
    return keep_reached(low, high)


def _find_edges(hits: RayHits, camera: Camera, about: Any) -> Any:
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


def neighbour_slices(axis: int, step: int = 1) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
    """Return the pixels that have one `step` further along an axis, and those."""
    first, second, whole = slice(None, -step), slice(step, None), slice(None)
    return ((first, whole), (second, whole)) if axis == 0 else ((whole, first), (whole, second))
