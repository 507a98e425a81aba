"""What a reader is, and how it tells a collision shape: how far this reaches in 26 directions of the world."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np

DIRECTIONS = np.array([[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z], float)
DIRECTIONS /= np.linalg.norm(DIRECTIONS, axis=1)[:, None]
"""(26, 3), of length 1: along the axes, the diagonals of their planes, and those of the octants."""

Grain = Literal["shape", "file"]
"""Whether a reader tells the shapes of a file one by one, or makes one of the whole file."""


@dataclass(frozen=True)
class Reader:
    """A program that loads files with collision shapes.

    package: by which pip installs it; module: by which it is imported; grains: the suffixes of what it loads.
    shapes: those that it finds in a file, at rest; `about` says why they may differ. share: how far they may reach
    otherwise than in the file, as a share of their width; inward: how much less [m]; rounds: how much less those that
    are round, as a share of their width, because they are polytopes in it.
    besides: suffixes of files in which it finds what is only seen, too. absent: of some other suffixes, why it does not
    load them; limits: of a suffix and an asset, what it lacks that the asset has.
    """

    title: str
    package: str
    module: str
    grains: Mapping[str, Grain]
    shapes: Callable[[Path], Iterator[Seen]]
    inward: float = 0.0
    rounds: float = 0.0
    share: float = 0.0
    besides: Collection[str] = ()
    about: str = ""
    absent: Mapping[str, str] = field(default_factory=dict)
    limits: Mapping[tuple[str, str], str] = field(default_factory=dict)

    def grain(self, suffix: str) -> Grain | None:
        """How it tells files of a suffix, None where it does not load them; without suffix: a folder, a file a hull."""
        if not suffix:
            return "shape" if ".obj" in self.grains else None
        return self.grains.get(suffix)


@dataclass(frozen=True)
class Seen:
    """A collision shape in the world; reach: how far it extends in each of the directions [m], from the origin."""

    kind: str
    reach: tuple[float, ...]


@dataclass(frozen=True)
class Place:
    """world_T_shape: its rotation (3, 3), which may hold a scale, and its translation (3,)."""

    rotation: np.ndarray
    translation: np.ndarray

    @staticmethod
    def of_matrix(matrix: Any) -> Place:
        """Of a matrix (4, 4) for columns."""
        whole = np.asarray(matrix, float)
        return Place(whole[:3, :3], whole[:3, 3])

    @staticmethod
    def of_quaternion(translation: Any, xyzw: Any) -> Place:
        """Of a rotation told by a quaternion whose real part comes last."""
        x, y, z, w = np.asarray(xyzw, float) / np.linalg.norm(xyzw)
        rotation = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        )
        return Place(rotation, np.asarray(translation, float))

    def __matmul__(self, inner: Place) -> Place:
        return Place(self.rotation @ inner.rotation, self.rotation @ inner.translation + self.translation)

    def seen(self, kind: str, own: np.ndarray) -> Seen:
        """A shape about its origin; own: how far it reaches in the directions as its own frame has them (26,)."""
        return Seen(kind, tuple((own + DIRECTIONS @ self.translation).tolist()))

    @property
    def directions(self) -> np.ndarray:
        """The directions in the frame of the shape (26, 3), longer or shorter where that is scaled."""
        turned: np.ndarray = DIRECTIONS @ self.rotation
        return turned


def hull(points: Any, place: Place, kind: str = "mesh") -> Seen:
    """The convex hull of points (n, 3)."""
    return place.seen(kind, (np.asarray(points, float) @ place.directions.T).max(axis=0))


def ellipsoid(radii: Any, place: Place, kind: str = "ellipsoid") -> Seen:
    """A ball has three radii, too."""
    return place.seen(kind, np.linalg.norm(place.directions * np.broadcast_to(radii, 3), axis=1))


def box(half: Any, place: Place) -> Seen:
    """half: half the size along each axis (3,)."""
    return place.seen("box", np.abs(place.directions) @ np.asarray(half, float))


def capsule(radius: float, half: float, place: Place, axis: int = 2) -> Seen:
    """half: half the length of its straight part."""
    along = np.abs(place.directions[:, axis])
    return place.seen("capsule", half * along + radius * np.linalg.norm(place.directions, axis=1))


def cylinder(radius: float, half: float, place: Place, axis: int = 2) -> Seen:
    """half: half its length."""
    along, across = np.abs(place.directions[:, axis]), np.delete(place.directions, axis, axis=1)
    return place.seen("cylinder", half * along + radius * np.linalg.norm(across, axis=1))
