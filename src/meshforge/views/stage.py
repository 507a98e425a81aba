"""What is drawn and in which frame, and which of it each pixel sees."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Aabb, Floats, Ints
from meshforge.views.camera import Camera, Up
from meshforge.views.roundness import Skin
from meshforge.views.scene import Scene, assembled, rays, seen_from

_BORDER = 8  # pixels about what can be seen, so that its outline has room


@dataclass(frozen=True, eq=False, slots=True)
class Layer:
    """Things drawn together. colors: (k, 3), sRGB in 0..1, one for each skin.

    solid things hide what is behind them. Shells do not: `before` and `behind` are how much of them shows before and
    behind solid things; of a shell in front of `drawn_over` solid things only the lines show. hatched: which skins
    are striped. tint: colours (n, 3) of points (n, 3) [m] that some skins (n,) show, instead of `colors`.
    """

    skins: Sequence[Skin]
    colors: Floats
    solid: bool = True
    before: float = 1.0
    behind: float = 0.0
    hatched: frozenset[int] = frozenset()
    drawn_over: frozenset[int] = frozenset()
    tint: Callable[[Floats, Ints], Floats] | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Stage:
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


def upright(up: Up) -> Floats:
    """The direction (3,) that points up."""
    return np.array([0.0, 0.0, 1.0] if up == "Z" else [0.0, 1.0, 0.0])


@dataclass(frozen=True, eq=False, slots=True)
class Hits:
    """What the pixels of a picture show: triangle and item (h, w), -1 for nothing; nothing outside the window."""

    scene: Scene
    triangle: Ints
    item: Ints
    window: tuple[slice, slice]

    def points(self, camera: Camera, rows: Ints, columns: Ints) -> Floats:
        """Where the rays through some pixels (n,), each of which shows something, meet it (n, 3)."""
        origins, directions = camera.pixel_rays(columns, rows)
        depth = self.scene.depth(self.triangle[rows, columns], origins, directions)
        return origins + directions * depth[:, None]

    def depth(self, camera: Camera, rows: Ints, columns: Ints) -> Floats:
        """How far along their rays (n,) those places are."""
        return self.scene.depth(self.triangle[rows, columns], *camera.pixel_rays(columns, rows))


def cast(layer: Layer, stage: Stage, camera: Camera) -> Hits:
    """The first thing of a layer behind each pixel."""
    return met(assembled(layer.skins, stage.bounds.center, stage.unit), camera)


def met(whole: Scene, camera: Camera, window: tuple[slice, slice] | None = None) -> Hits:
    """The first thing of an assembled scene behind each pixel; window: the columns and rows to look in, by default
    those that it can be seen in."""
    scene = seen_from(whole, camera.axes[2]) if whole.embree is None else whole
    width, height = camera.size
    triangle = np.full((height, width), -1, np.int64)
    if len(scene.corners) == 0:
        return Hits(scene, triangle, triangle.copy(), (slice(0, 0), slice(0, 0)))
    start = float((scene.corners.reshape(-1, 3) @ camera.axes[2]).max()) + 0.1
    x, y = window or window_of(scene, camera)
    origins, directions = rays(camera, np.arange(x.start, x.stop), np.arange(y.start, y.stop), start)
    seen = scene.embree.run(origins, directions, query="INTERSECT")
    triangle[y, x] = seen.reshape(y.stop - y.start, x.stop - x.start)
    item = np.full(triangle.shape, -1, np.int64)
    item[y, x] = np.append(scene.item, -1)[triangle[y, x]]
    return Hits(scene, triangle, item, (y, x))


def window_of(scene: Scene, camera: Camera) -> tuple[slice, slice]:
    """The columns and rows that the scene can be seen in."""
    places = np.ascontiguousarray(camera.to_pixels(scene.corners.reshape(-1, 3)).T)  # extremes of rows are found quickly
    low = np.clip(np.floor(places.min(axis=1)).astype(int) - _BORDER, 0, camera.size)
    high = np.clip(np.ceil(places.max(axis=1)).astype(int) + 1 + _BORDER, low, camera.size)
    return slice(int(low[0]), int(high[0])), slice(int(low[1]), int(high[1]))
