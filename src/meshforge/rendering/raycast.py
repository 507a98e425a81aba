"""What each pixel shows: layers of things in a frame of unit size, one ray a pixel."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Aabb, Floats, Ints
from meshforge.rendering.camera import Camera, Up
from meshforge.rendering.scene import RayScene, RenderMesh, build_scene, prepare_for_rays, window_rays

_BORDER = 8  # pixels about what can be seen, so that its outline has room


@dataclass(frozen=True, eq=False, slots=True)
class DrawLayer:
    """Things drawn together. colors: (k, 3), sRGB in 0..1, one for each render_mesh.

    solid things hide what is behind them. Shells do not: `before` and `behind` are how much of them shows before and
    behind solid things; of a shell in front of `drawn_over` solid things only the lines show. hatched, dotted: which
    of them have stripes or dots. tint: colours (n, 3) of points (n, 3) [m] that some of them (n,) show, instead of
    `colors`.
    """

    render_meshes: Sequence[RenderMesh]
    colors: Floats
    before: float = 1.0
    behind: float = 0.0
    hatched: frozenset[int] = frozenset()
    dotted: frozenset[int] = frozenset()
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
    """Return the first thing of an assembled scene behind each pixel; window: columns and rows, or all."""
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


def neighbour_slices(axis: int) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
    """Return the pixels that have one further along an axis, and those."""
    first, second, whole = slice(None, -1), slice(1, None), slice(None)
    return ((first, whole), (second, whole)) if axis == 0 else ((whole, first), (whole, second))
