"""Cameras: named views, framed on a set of points, and the rays through their pixels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints

View = Literal[
    "iso", "iso-back", "front", "back", "left", "right", "top", "bottom",
    "front-left-above", "front-right-above", "back-left-above", "back-right-above",
    "front-left-below", "front-right-below", "back-left-below", "back-right-below",
]  # fmt: skip
VIEWS: tuple[View, ...] = get_args(View)
Up = Literal["Y", "Z"]
Floats32 = npt.NDArray[np.float32]
PixelCoordinates = Floats | Ints
"""Columns or rows of pixels; halves lie between two of them."""

_EYE_DIRECTIONS: dict[View, tuple[float, float, float]] = {
    "iso": (0.8, -1.0, 0.66),
    "iso-back": (-0.8, 1.0, 0.66),
    "front": (0.0, -1.0, 0.0),
    "back": (0.0, 1.0, 0.0),
    "left": (-1.0, 0.0, 0.0),
    "right": (1.0, 0.0, 0.0),
    "top": (0.0, 0.0, 1.0),
    "bottom": (0.0, 0.0, -1.0),
    "front-left-above": (-0.75, -1.0, 0.7),
    "front-right-above": (0.75, -1.0, 0.7),
    "back-left-above": (-0.75, 1.0, 0.7),
    "back-right-above": (0.75, 1.0, 0.7),
    "front-left-below": (-0.75, -1.0, -0.7),
    "front-right-below": (0.75, -1.0, -0.7),
    "back-left-below": (-0.75, 1.0, -0.7),
    "back-right-below": (0.75, 1.0, -0.7),
}
"""The side of a Z-up object on which the eye is; front is seen from -Y, as in Blender and CAD tools.

The two called iso see in perspective, all others orthographically.
"""
_DISTANCE = 3.4  # of the eye in a perspective view, in diagonals: strong enough to read depth, too weak to distort
_MARGIN = 0.06  # free border on every side, as a share of the picture

_Z_FROM_Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Takes a Y-up direction to the Z-up direction of the same meaning; its front, +Z, becomes -Y."""


@dataclass(frozen=True, eq=False, slots=True)
class Camera:
    """A camera: rows of axes (3, 3) are right, up and towards the eye; eye: (3,), None sees orthographically.

    middle: (2,) and scale: the picture's centre, and its length a pixel, on the image plane.
    That plane goes through the origin, or, in perspective, lies one unit before the eye.
    """

    axes: Floats
    eye: Floats | None
    middle: Floats
    scale: float
    size: tuple[int, int]

    def project(self, points: Floats) -> Floats:
        """Return points (n, 3) on the image plane: right and up (n, 2)."""
        if self.eye is None:
            return points @ self.axes[:2].T
        local = (points - self.eye) @ self.axes.T
        return local[:, :2] / -local[:, 2:]

    def to_pixels(self, points: Floats) -> Floats:
        """Return points (n, 3) in the picture: column and row (n, 2), the first pixel's centre at (0, 0)."""
        offset = (self.project(points) - self.middle) / self.scale
        return (np.array(self.size) - 1) / 2 + offset * [1, -1]

    def supersample(self, factor: int) -> Camera:
        """Return the same camera with `factor` times as many pixels along each side."""
        width, height = self.size
        return Camera(self.axes, self.eye, self.middle, self.scale / factor, (width * factor, height * factor))

    def pixel_rays(self, columns: PixelCoordinates, rows: PixelCoordinates) -> tuple[Floats, Floats]:
        """Return origins (n, 3) and directions (n, 3), or (1, 3) where all agree, of the rays through n pixels."""
        right, up = self.plane_coordinates(columns, rows)
        aside = right[:, None] * self.axes[0] + up[:, None] * self.axes[1]
        if self.eye is None:
            return aside, -self.axes[2:]
        return np.broadcast_to(self.eye, aside.shape), aside - self.axes[2]

    def plane_coordinates(self, columns: PixelCoordinates, rows: PixelCoordinates) -> tuple[Floats, Floats]:
        """Return right and up of pixel columns and rows on the image plane."""
        width, height = self.size
        right = self.middle[0] + (columns - (width - 1) / 2) * self.scale
        return right, self.middle[1] - (rows - (height - 1) / 2) * self.scale


def aim_camera(view: View, up: Up, size: tuple[int, int], points: Floats) -> Camera:
    """Return the camera of a named view that fills a picture of size (width, height) with points (n, 3).

    The points are in a frame where their middle is near the origin and their diagonal near one.
    """
    axes = axes_of(view, up)
    eye = axes[2] * _DISTANCE if view.startswith("iso") else None
    plane = Camera(axes, eye, np.zeros(2), 1.0, size).project(points)
    low, high = plane.min(axis=0), plane.max(axis=0)
    room = np.array(size) * (1 - 2 * _MARGIN)
    scale = float(np.max((high - low) / room)) or 1.0 / min(size)
    return Camera(axes, eye, (low + high) / 2, scale, size)


def axes_of(view: View, up: Up) -> Floats:
    """Return the rows (3, 3) right, up and towards the eye of a named view."""
    return _axes_towards(np.array(_EYE_DIRECTIONS[view]), up, view)


def _axes_towards(towards: Floats, up: Up, view: View = "iso") -> Floats:
    """The rows (3, 3) right, up and towards the eye; towards: its direction (3,) seen from a Z-up object."""
    towards = towards / np.linalg.norm(towards)
    upright = np.array([0.0, 1.0, 0.0]) if view in ("top", "bottom") else np.array([0.0, 0.0, 1.0])
    if view == "bottom":
        upright = -upright
    right = np.cross(upright, towards)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(towards, right), towards])
    return axes if up == "Z" else axes @ _Z_FROM_Y_UP
