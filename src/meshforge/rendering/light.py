"""Light on surfaces: key, fill and sky, darker corners, and the soft shadow on the ground."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.rendering.camera import Camera, Floats32
from meshforge.rendering.colors import to_linear
from meshforge.rendering.filters import blur, sample
from meshforge.rendering.raycast import RayHits, ViewFrame, neighbour_slices
from meshforge.rendering.scene import RayScene

_KEY = np.array([-0.42, 0.72, 0.62])  # right, up, towards the eye: over the left shoulder
_FILL = np.array([0.85, 0.10, 0.45])
_SKY_REACH = 0.35  # how far away things still darken a point, in diagonals
GROUND_REACH = 0.5
"""How far things cast a shadow on the ground, in diagonals."""
_RAYS = 16
_GROUND_RAYS = 24
_LIFT = 2e-3  # rays start this far above the surface, in diagonals

_SKY_STEP = 4  # the sky is looked at once in so many pixels along each side

_SHADOW_CELLS = 72  # of the shadow along its longer side
_SHADOW_STEP = 4  # pixels between the places where it is looked up
_SOFTNESS = 1.2  # blur in cells, enough to hide the pattern of turns


def shade(colors: Floats, normals: Floats, camera: Camera, upright: Floats) -> Floats32:
    """Return the colours (n, 3), sRGB in 0..1, of surfaces with such normals (n, 3); double-sided."""
    normals = normals * np.where(normals @ camera.axes[2] < 0, -1.0, 1.0)[:, None]
    key, fill = (np.clip(normals @ (d @ camera.axes / np.linalg.norm(d)), 0, None) for d in (_KEY, _FILL))
    sky = 0.5 + 0.5 * normals @ upright
    strength = 0.52 + 0.28 * sky + 0.44 * key + 0.14 * fill
    bright = _compress_highlights(to_linear(colors) * strength[:, None])
    return np.where(bright <= 0.0031308, bright * 12.92, 1.055 * bright ** (1 / 2.4) - 0.055).astype(np.float32)


def _compress_highlights(linear: Floats) -> Floats:
    """Values above 0.8 are bent towards one, so that light faces keep their colour."""
    over = np.clip(linear - 0.8, 0, None)
    return np.minimum(linear, 0.8) + 0.2 * (1 - np.exp(-over / 0.2))


def measure_ground_sky(scene: RayScene, points: Floats, upright: Floats, turn: Floats) -> Floats32:
    """Return the share (n,) of the sky above points (n, 3) of the ground that nothing blocks, with a wider reach."""
    return _measure_free_share(scene, points, np.broadcast_to(upright, points.shape), turn, _GROUND_RAYS, GROUND_REACH)


def _measure_free_share(
    scene: RayScene, points: Floats, normals: Floats, turn: Floats, count: int, reach: float
) -> Floats32:
    """The share (n,) of the sky above points (n, 3) that blocks none of so many rays within a reach.

    turn: (n,) in 0..1, how the pattern of rays is turned there; neighbours that differ can be averaged.
    """
    if len(points) == 0:
        return np.zeros(0, np.float32)
    first, second = _tangents(normals)
    origins = (points + normals * _LIFT).astype(np.float32)
    free = np.zeros(len(points), np.float32)
    above, aside, across = (a.astype(np.float32) for a in (normals, first, second))
    for k in range(count):
        radius = np.float32(np.sqrt((k + 0.5) / count))  # cosine weighted: a disc lifted onto the hemisphere
        angle = (2 * np.pi * (k * 0.6180339887498949 + turn)).astype(np.float32)
        x, y = radius * np.cos(angle), radius * np.sin(angle)
        directions = aside * x[:, None] + across * y[:, None] + above * np.sqrt(1 - radius * radius)
        free += ~scene.is_blocked(origins, directions, reach)
    return free / np.float32(count)


def _tangents(normals: Floats) -> tuple[Any, Any]:
    """Two unit vectors square to each normal (n, 3) and to each other."""
    first = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]]))
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return first, np.cross(normals, first)


def compute_openness(hits: RayHits, camera: Camera, rows: Ints, columns: Ints) -> Floats32:
    """Return how open (n,) in 0..1 the places are that some pixels (n,) show."""
    half = _SKY_STEP // 2
    coarse = hits.triangle[half::_SKY_STEP, half::_SKY_STEP]
    r, c = np.nonzero(coarse >= 0)
    points = hits.points(camera, r * _SKY_STEP + half, c * _SKY_STEP + half)
    normals = hits.scene.normals[coarse[r, c]]
    away = np.einsum("ij,ij->i", normals, camera.directions_to_eye(points)) < 0
    normals = np.where(away[:, None], -normals, normals)
    grid = np.zeros(coarse.shape, np.float32)
    grid[r, c] = _measure_free_share(hits.scene, points, normals, dither_turns(r, c), _RAYS, _SKY_REACH)
    return _upsample(_smooth(grid, np.append(hits.scene.facet, -1)[coarse]), coarse, hits, rows, columns)


def dither_turns(rows: Ints, columns: Ints) -> Floats:
    """Return a turn in 0..1 for each cell: sixteen different ones in every block of four by four."""
    order = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]])
    return order[rows % 4, columns % 4] / 16


def _smooth(grid: Floats32, facet: Ints) -> Floats32:
    """Each cell mixed with those around it on the same facet, such that a pattern of four cells averages out."""
    for axis in (0, 1):
        total, weight = 2 * grid, np.full(grid.shape, 2, np.float32)
        for step, share in ((1, 2), (2, 1)):
            for here, there in (neighbour_slices(axis, step), neighbour_slices(axis, step)[::-1]):
                same = share * (facet[here] == facet[there]).astype(np.float32)
                total[here] += grid[there] * same
                weight[here] += same
        grid = total / weight
    return grid


def _upsample(grid: Floats32, coarse: Ints, hits: RayHits, rows: Ints, columns: Ints) -> Floats32:
    """Values of a coarse grid at fine pixels: from the nearest cells, of the same facet where there are any."""
    facet_of = np.append(hits.scene.facet, -1)
    item_of = np.append(hits.scene.item, -1).astype(np.int32)
    facets, items = facet_of[coarse], item_of[coarse]
    triangle = hits.triangle[rows, columns]
    facet, item = facet_of[triangle], item_of[triangle]
    total, weights = np.zeros(len(rows), np.float32), np.full(len(rows), 1e-6, np.float32)
    for r, rw in _interpolation_taps(rows, grid.shape[0]):
        for c, cw in _interpolation_taps(columns, grid.shape[1]):
            cell = r * grid.shape[1] + c
            weight = ((facets.take(cell) == facet) + np.float32(0.02) * (items.take(cell) == item)) * rw * cw
            total += weight * grid.take(cell)
            weights += weight
    return np.where(weights > 1e-5, total / weights, np.float32(1.0))


def _interpolation_taps(places: Ints, count: int) -> list[tuple[Ints, Floats32]]:
    """The two coarse cells about each pixel along one side, with their weights; never quite zero."""
    at: Floats32 = (places.astype(np.float32) - np.float32(_SKY_STEP // 2)) / np.float32(_SKY_STEP)
    below: Floats32 = np.floor(at)
    share, low = at - below, below.astype(np.int64)
    return [
        (np.clip(low, 0, count - 1), np.float32(1.01) - share),
        (np.clip(low + 1, 0, count - 1), np.float32(0.01) + share),
    ]


def compute_ground_shadow(scene: RayScene, frame: ViewFrame, camera: Camera) -> Floats32:
    """Return how much of the sky is hidden from the ground behind each pixel (h, w), in 0..1; 0 where there is no
    ground."""
    from PIL import Image  # lazy: 0.01 s, only pictures need it

    width, height = camera.size
    if camera.axes[2] @ frame.upright < 0.05 or len(scene.corners) == 0:
        return np.zeros((height, width), np.float32)
    shadow, low, cell = _shadow_from_above(scene, frame)
    rows, columns = (
        np.mgrid[0 : -(-height // _SHADOW_STEP), 0 : -(-width // _SHADOW_STEP)] * _SHADOW_STEP + (_SHADOW_STEP - 1) / 2
    )
    places = (_ground_points(frame, camera, rows.ravel(), columns.ravel())[:, frame.ground_axes] - low) / cell - 0.5
    seen = sample(shadow, places).reshape(rows.shape)
    box = (0, 0, width / _SHADOW_STEP, height / _SHADOW_STEP)
    large = np.asarray(Image.fromarray(seen).resize(camera.size, Image.Resampling.BICUBIC, box=box))
    return large.clip(0, 1) * _fade(height)[:, None] * _fade(width)


def _fade(count: int) -> Floats32:
    """From 0 at either end of a row of pixels to 1 at a tenth of it, smoothly."""
    inward = np.minimum(np.arange(count), np.arange(count)[::-1]) / max(count * 0.12, 1)
    share = inward.clip(0, 1).astype(np.float32)
    return share * share * (3 - 2 * share)


def _ground_points(frame: ViewFrame, camera: Camera, rows: Floats, columns: Floats) -> Floats:
    """Where the rays through pixels meet the ground (n, 3); those that never do, far away."""
    origins, directions = camera.pixel_rays(columns, rows)
    fall = directions @ frame.upright
    depth = (frame.ground_height - origins @ frame.upright) / np.where(fall < -1e-3, fall, 1e-3)
    return origins + directions * depth[:, None]


def _shadow_from_above(scene: RayScene, frame: ViewFrame) -> tuple[Floats32, Floats, float]:
    """The shadow as seen from above (a, b), the lower corner (2,) of that picture, and the side of a cell."""
    corners = scene.corners.reshape(-1, 3)[:, frame.ground_axes]
    low, high = corners.min(axis=0) - GROUND_REACH, corners.max(axis=0) + GROUND_REACH
    cell = float((high - low).max()) / _SHADOW_CELLS
    count = np.ceil((high - low) / cell).astype(int)
    first, second = np.mgrid[0 : count[0], 0 : count[1]]
    points = np.zeros((first.size, 3)) + frame.upright * frame.ground_height
    points[:, frame.ground_axes] = low + (np.column_stack([first.ravel(), second.ravel()]) + 0.5) * cell
    free = measure_ground_sky(scene, points, frame.upright, dither_turns(first.ravel(), second.ravel()))
    return blur((1 - free).reshape(first.shape), _SOFTNESS), low, cell
