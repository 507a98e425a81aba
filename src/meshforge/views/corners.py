"""How dark corners are: found at few pixels, and spread to all that show the same surface."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.views.camera import Camera, Singles
from meshforge.views.light import open_sky
from meshforge.views.outline import along
from meshforge.views.stage import Hits

_STEP = 4  # the sky is looked at once in so many pixels along each side


def sky(hits: Hits, camera: Camera, rows: Ints, columns: Ints) -> Singles:
    """How open (n,) in 0..1 the places are that some pixels (n,) show."""
    half = _STEP // 2
    coarse = hits.triangle[half::_STEP, half::_STEP]
    r, c = np.nonzero(coarse >= 0)
    points = hits.points(camera, r * _STEP + half, c * _STEP + half)
    normals = hits.scene.normals[coarse[r, c]]
    away = np.einsum("ij,ij->i", normals, camera.directions_to_eye(points)) < 0
    normals = np.where(away[:, None], -normals, normals)
    grid = np.zeros(coarse.shape, np.float32)
    grid[r, c] = open_sky(hits.scene, points, normals, turns(r, c))
    return _spread(_smoothed(grid, np.append(hits.scene.facet, -1)[coarse]), coarse, hits, rows, columns)


def turns(rows: Ints, columns: Ints) -> Floats:
    """A turn in 0..1 for each cell: sixteen different ones in every block of four by four."""
    order = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]])
    turns: Floats = order[rows % 4, columns % 4] / 16
    return turns


def _smoothed(grid: Singles, facet: Ints) -> Singles:
    """Each cell mixed with those around it on the same facet, such that a pattern of four cells averages out."""
    for axis in (0, 1):
        total, weight = 2 * grid, np.full(grid.shape, 2, np.float32)
        for step, share in ((1, 2), (2, 1)):
            for here, there in (along(axis, step), along(axis, step)[::-1]):
                same = share * (facet[here] == facet[there]).astype(np.float32)
                total[here] += grid[there] * same
                weight[here] += same
        grid = total / weight
    return grid


def _spread(grid: Singles, coarse: Ints, hits: Hits, rows: Ints, columns: Ints) -> Singles:
    """Values of a coarse grid at fine pixels: from the nearest cells, of the same facet where there are any."""
    facet_of = np.append(hits.scene.facet, -1)
    item_of = np.append(hits.scene.item, -1).astype(np.int32)
    facets, items = facet_of[coarse], item_of[coarse]
    triangle = hits.triangle[rows, columns]
    facet, item = facet_of[triangle], item_of[triangle]
    total, weights = np.zeros(len(rows), np.float32), np.full(len(rows), 1e-6, np.float32)
    for r, rw in _taps(rows, grid.shape[0]):
        for c, cw in _taps(columns, grid.shape[1]):
            cell = r * grid.shape[1] + c
            alike = (facets.take(cell) == facet) + np.float32(0.02) * (items.take(cell) == item)
            weight = alike * rw * cw
            total += weight * grid.take(cell)
            weights += weight
    return np.where(weights > 1e-5, total / weights, np.float32(1.0))


def _taps(places: Ints, count: int) -> list[tuple[Ints, Singles]]:
    """The two coarse cells about each pixel along one side, with their weights; never quite zero."""
    at: Singles = (places.astype(np.float32) - np.float32(_STEP // 2)) / np.float32(_STEP)
    below: Singles = np.floor(at)
    share, low = at - below, below.astype(np.int64)
    return [
        (np.clip(low, 0, count - 1), np.float32(1.01) - share),
        (np.clip(low + 1, 0, count - 1), np.float32(0.01) + share),
    ]
