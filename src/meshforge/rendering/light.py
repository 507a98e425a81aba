"""Light on surfaces: key, fill and sky, darker corners, and the soft shadow on the ground."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.rendering.camera import Camera, Floats32
from meshforge.rendering.colors import to_linear
from meshforge.rendering.raycast import RayHits, ViewFrame, neighbour_slices
from meshforge.rendering.scene import RayScene

_KEY = np.array([-0.42, 0.72, 0.62])  # right, up, towards the eye: over the left shoulder
_FILL = np.array([0.85, 0.10, 0.45])
_SKY_REACH = 0.35  # how far away things still darken a point, in diagonals
_RAYS = 16
_LIFT = 2e-3  # rays start this far above the surface, in diagonals

_SKY_STEP = 4  # the sky is looked at once in so many pixels along each side
_DITHER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]]) / 16
"""How the pattern of rays is turned, in 0..1: sixteen ways in every block of four by four cells."""
_FLAT = 0.05  # rays that fall by less of their length do not meet the ground


def shade(colors: Floats, normals: Floats, camera: Camera, upright: Floats) -> Floats32:
    """Return the colours (n, 3), sRGB in 0..1, of surfaces with such normals (n, 3); double-sided."""
    normals = normals * np.where(normals @ camera.axes[2] < 0, -1.0, 1.0)[:, None]
    key, fill = (np.clip(normals @ (d @ camera.axes / np.linalg.norm(d)), 0, None) for d in (_KEY, _FILL))
    sky = 0.5 + 0.5 * normals @ upright
    strength = 0.52 + 0.28 * sky + 0.44 * key + 0.14 * fill
    bright = to_linear(colors) * strength[:, None]
    over = np.clip(bright - 0.8, 0, None)  # values above are bent towards one, so that light faces keep their colour
    bright = np.minimum(bright, 0.8) + 0.2 * (1 - np.exp(-over / 0.2))
    return np.where(bright <= 0.0031308, bright * 12.92, 1.055 * bright ** (1 / 2.4) - 0.055).astype(np.float32)


def _measure_free_share(scene: RayScene, points: Floats, normals: Floats, turn: Floats) -> Floats32:
    """The share (n,) of the sky above points (n, 3) that nothing blocks near by.

    turn: (n,) in 0..1, how the pattern of rays is turned there; neighbours that differ can be averaged.
    """
    if len(points) == 0:
        return np.zeros(0, np.float32)
    first = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]]))
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(normals, first)
    origins = (points + normals * _LIFT).astype(np.float32)
    free = np.zeros(len(points), np.float32)
    above, aside, across = (a.astype(np.float32) for a in (normals, first, second))
    for k in range(_RAYS):
        radius = np.float32(np.sqrt((k + 0.5) / _RAYS))  # cosine weighted: a disc lifted onto the hemisphere
        angle = (2 * np.pi * (k * 0.6180339887498949 + turn)).astype(np.float32)
        x, y = radius * np.cos(angle), radius * np.sin(angle)
        directions = aside * x[:, None] + across * y[:, None] + above * np.sqrt(1 - radius * radius)
        free += ~scene.is_blocked(origins, directions, _SKY_REACH)
    return free / np.float32(_RAYS)


def compute_openness(hits: RayHits, frame: ViewFrame, camera: Camera) -> Floats32:
    """Return how open (h, w) in 0..1 the places are that pixels show; of pixels that show nothing, the ground there."""
    found = np.ones(hits.item.shape, np.float32)
    if not len(hits.scene.corners):
        return found
    half = _SKY_STEP // 2
    coarse = hits.triangle[half::_SKY_STEP, half::_SKY_STEP]
    r, c = (places.ravel() for places in np.indices(coarse.shape))
    rows, columns, seen = r * _SKY_STEP + half, c * _SKY_STEP + half, coarse.ravel() >= 0
    points = _ground_points(frame, camera, rows, columns)
    points[seen] = hits.points(camera, rows[seen], columns[seen])
    normals = np.where(seen[:, None], hits.scene.normals[coarse.ravel()], frame.upright)
    away = np.einsum("ij,ij->i", normals, camera.directions_to_eye(points)) < 0
    normals[away & seen] *= -1
    low, high = (end(hits.scene.corners.reshape(-1, 3), axis=0) for end in (np.min, np.max))
    near = np.flatnonzero(((points > low - _SKY_REACH) & (points < high + _SKY_REACH)).all(axis=1))
    grid = np.ones(coarse.size, np.float32)
    grid[near] = _measure_free_share(hits.scene, points[near], normals[near], _DITHER[r % 4, c % 4][near])
    grid = _smooth(grid.reshape(coarse.shape), np.append(hits.scene.facet, -1)[coarse])
    high, wide = (np.minimum(np.arange(found.shape[k]) // _SKY_STEP, grid.shape[k] - 1) for k in (0, 1))
    fine = np.nonzero((grid < 1)[np.ix_(high, wide)])
    found[fine] = _upsample(grid, coarse, hits, *fine)
    return found


def _ground_points(frame: ViewFrame, camera: Camera, rows: Ints, columns: Ints) -> Floats:
    """Where the rays through pixels meet the ground (n, 3); those that do not, or nearly along it, far away."""
    origins, directions = camera.pixel_rays(columns, rows)
    fall = -(directions @ frame.upright)
    depth = (origins @ frame.upright - frame.ground_height) / np.where(fall > _FLAT, fall, 1e-9)
    return origins + directions * depth[:, None]


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
