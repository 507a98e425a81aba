"""The soft shadow that things cast on the ground below them."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.geometry import Floats
from meshforge.views.camera import Camera, Singles
from meshforge.views.corners import turns
from meshforge.views.light import GROUND_REACH, open_ground
from meshforge.views.scene import Scene
from meshforge.views.stage import Stage

_CELLS = 72  # of the shadow along its longer side
_STEP = 4  # pixels between the places where it is looked up
_SOFTNESS = 1.2  # blur in cells, enough to hide the pattern of turns


def ground_shadow(scene: Scene, stage: Stage, camera: Camera) -> Singles:
    """How much of the sky is hidden from the ground behind each pixel (h, w), in 0..1; 0 where there is no ground."""
    from PIL import Image
    from scipy.ndimage import map_coordinates

    width, height = camera.size
    if camera.axes[2] @ stage.upright < 0.05 or len(scene.corners) == 0:
        return np.zeros((height, width), np.float32)
    shadow, low, cell = _on_ground(scene, stage)
    rows, columns = np.mgrid[0 : -(-height // _STEP), 0 : -(-width // _STEP)] * _STEP + (_STEP - 1) / 2
    places = (_ground_points(stage, camera, rows.ravel(), columns.ravel())[:, stage.ground_axes] - low) / cell - 0.5
    seen = map_coordinates(shadow, places.T, order=1).reshape(rows.shape)
    box = (0, 0, width / _STEP, height / _STEP)
    large = np.asarray(Image.fromarray(seen).resize(camera.size, Image.Resampling.BICUBIC, box=box))
    return large.clip(0, 1) * _fade(height)[:, None] * _fade(width)


def _fade(count: int) -> Singles:
    """From 0 at either end of a row of pixels to 1 at a tenth of it, smoothly."""
    inward = np.minimum(np.arange(count), np.arange(count)[::-1]) / max(count * 0.12, 1)
    share = inward.clip(0, 1).astype(np.float32)
    return share * share * (3 - 2 * share)


def _ground_points(stage: Stage, camera: Camera, rows: Floats, columns: Floats) -> Floats:
    """Where the rays through pixels meet the ground (n, 3); those that never do, far away."""
    origins, directions = camera.pixel_rays(columns, rows)
    fall = directions @ stage.upright
    depth = (stage.ground_height - origins @ stage.upright) / np.where(fall < -1e-3, fall, 1e-3)
    points: Floats = origins + directions * depth[:, None]
    return points


def _on_ground(scene: Scene, stage: Stage) -> tuple[Singles, Floats, float]:
    """The shadow as seen from above (a, b), the lower corner (2,) of that picture, and the side of a cell."""
    from scipy.ndimage import gaussian_filter

    corners = scene.corners.reshape(-1, 3)[:, stage.ground_axes]
    low, high = corners.min(axis=0) - GROUND_REACH, corners.max(axis=0) + GROUND_REACH
    cell = float((high - low).max()) / _CELLS
    count = np.ceil((high - low) / cell).astype(int)
    first, second = np.mgrid[0 : count[0], 0 : count[1]]
    points = np.zeros((first.size, 3)) + stage.upright * stage.ground_height
    points[:, stage.ground_axes] = low + (np.column_stack([first.ravel(), second.ravel()]) + 0.5) * cell
    free = open_ground(scene, points, stage.upright, turns(first.ravel(), second.ravel()))
    softened: Any = gaussian_filter((1 - free).reshape(first.shape), _SOFTNESS)
    return softened, low, cell
