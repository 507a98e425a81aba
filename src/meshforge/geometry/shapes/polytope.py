"""The convex polytope: the hull that decompositions are made of."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats, Ints, cross, frozen_floats, frozen_ints
from meshforge.geometry.shapes.base import Shape


@dataclass(frozen=True, eq=False)
class Polytope(Shape):
    """A closed convex polytope; `convex_hull` makes one from any points, this class trusts what it is given.

    vertices: (n, 3) [m], each used by a face; faces: (m, 3) indices, counter-clockwise seen from outside.
    """

    kind: ClassVar[str] = "polytope"
    _vertices: Floats
    _faces: Ints
    _aabb: Aabb = field(init=False)

    def __post_init__(self) -> None:
        vertices = frozen_floats(self._vertices, (-1, 3))
        faces = frozen_ints(self._faces, (-1, 3))
        object.__setattr__(self, "_vertices", vertices)
        object.__setattr__(self, "_faces", faces)
        object.__setattr__(self, "_aabb", Aabb.of_points(vertices))

    @property
    def vertices(self) -> Floats:
        return self._vertices

    @property
    def faces(self) -> Ints:
        return self._faces

    @property
    def aabb(self) -> Aabb:
        return self._aabb

    @cached_property
    def _moments(self) -> tuple[float, Floats]:
        with np.errstate(invalid="ignore", over="ignore"):  # what is not finite shows in the volume
            return volume_and_centroid(self._vertices, self._faces)

    @property
    def volume(self) -> float:
        return self._moments[0]

    @property
    def centroid(self) -> Floats:
        return self._moments[1]

    def support(self, direction: Floats) -> Floats:
        farthest: Floats = self._vertices[int(np.argmax(self._vertices @ direction))]
        return farthest

    def tessellate(self) -> Polytope:
        return self

    def transform(self, linear: Floats, offset: Floats) -> Polytope:
        faces = self._faces if np.linalg.det(linear) > 0 else self._faces[:, ::-1]
        return Polytope(self._vertices @ linear.T + offset, faces)


def volume_and_centroid(vertices: Floats, faces: Ints) -> tuple[float, Floats]:
    """Volume [m^3] and centre (3,) of a closed surface, by signed tetrahedra about a vertex near the middle."""
    origin = vertices.mean(axis=0)
    a, b, c = (vertices[faces[:, k]] - origin for k in range(3))
    six_volumes = np.einsum("ij,ij->i", a, cross(b, c))
    total = float(six_volumes.sum())
    if total == 0.0:
        return 0.0, frozen_floats(origin, (3,))
    center = (six_volumes[:, None] * (a + b + c)).sum(axis=0) / (4.0 * total)
    return total / 6.0, frozen_floats(origin + center, (3,))
