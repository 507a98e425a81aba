"""Light on surfaces: key, fill and sky, and how much of the sky each point sees."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.geometry import Floats
from meshforge.views.camera import Camera, Singles
from meshforge.views.scene import Scene

_KEY = np.array([-0.42, 0.72, 0.62])  # right, up, towards the eye: over the left shoulder
_FILL = np.array([0.85, 0.10, 0.45])
_REACH = 0.35  # how far away things still darken a point, in diagonals
GROUND_REACH = 0.5
"""How far things cast a shadow on the ground, in diagonals."""
_RAYS = 16
_GROUND_RAYS = 24
_LIFT = 2e-3  # rays start this far above the surface, in diagonals


def lit(colors: Floats, normals: Floats, camera: Camera, upright: Floats) -> Singles:
    """The colours (n, 3), sRGB in 0..1, of surfaces with such normals (n, 3); double-sided."""
    facing = np.where(normals @ camera.axes[2] < 0, -1.0, 1.0)
    normals = normals * facing[:, None]
    key, fill = (np.clip(normals @ (d @ camera.axes / np.linalg.norm(d)), 0, None) for d in (_KEY, _FILL))
    sky = 0.5 + 0.5 * normals @ upright
    strength = 0.52 + 0.28 * sky + 0.44 * key + 0.14 * fill
    linear = np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)
    bright = _soft_limit(linear * strength[:, None])
    return np.where(bright <= 0.0031308, bright * 12.92, 1.055 * bright ** (1 / 2.4) - 0.055).astype(np.float32)


def _soft_limit(linear: Floats) -> Floats:
    """Values above 0.8 are bent towards one, so that light faces keep their colour."""
    over = np.clip(linear - 0.8, 0, None)
    limited: Floats = np.minimum(linear, 0.8) + 0.2 * (1 - np.exp(-over / 0.2))
    return limited


def open_sky(scene: Scene, points: Floats, normals: Floats, turn: Floats) -> Singles:
    """The share (n,) of the near sky above each point (n, 3) that nothing blocks.

    turn: (n,) in 0..1, how the pattern of rays is turned there; neighbours that differ can be averaged.
    """
    return _share(scene, points, normals, turn, _RAYS, _REACH)


def open_ground(scene: Scene, points: Floats, upright: Floats, turn: Floats) -> Singles:
    """The same for points of the ground, with a wider reach."""
    return _share(scene, points, np.broadcast_to(upright, points.shape), turn, _GROUND_RAYS, GROUND_REACH)


def _share(scene: Scene, points: Floats, normals: Floats, turn: Floats, count: int, reach: float) -> Singles:
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
    helper = np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    first = np.cross(normals, helper)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return first, np.cross(normals, first)
