"""The base of all convex shapes, the two with flat faces (polytope, box), and the digest and comparison of shapes."""

from __future__ import annotations

import hashlib
import itertools
from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar
from weakref import WeakKeyDictionary

import numpy as np

from meshforge.geometry.arrays import Aabb, Floats, Ints, cross, freeze_floats, freeze_ints, sort_rows
from meshforge.geometry.pose import Pose

_BOX_CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
_BOX_FACES = [
    [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
    [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
]  # fmt: skip

_digests: WeakKeyDictionary[Polytope, str] = WeakKeyDictionary()
"""Polytopes never change, and labels are looked up by their digests again and again."""


class Shape(ABC):
    """A convex body in the root frame, write-protected, with analytic measures. Compared by `is_same_shape`."""

    __slots__ = ()
    kind: ClassVar[str]

    @property
    @abstractmethod
    def aabb(self) -> Aabb:
        """The exact axis-aligned bounding box."""

    @property
    @abstractmethod
    def volume(self) -> float:
        """The exact volume [m^3]."""

    @property
    @abstractmethod
    def centroid(self) -> Floats:
        """The centre of volume (3,) [m]."""

    @abstractmethod
    def support(self, direction: Floats) -> Floats:
        """Return a point (3,) of the shape that lies farthest along `direction` (3,), of any length."""

    @abstractmethod
    def tessellate(self) -> Polytope:
        """Return the shape as a polytope: itself, exact for a box, at most 64 inscribed vertices for a round one."""

    @abstractmethod
    def transform(self, linear: Floats, offset: Floats) -> Shape:
        """Return the image under x -> linear @ x + offset; of the same kind where the map allows it, else a polytope.

        linear: (3, 3), regular, reflections included; offset: (3,) [m].
        """

    @property
    def vertices(self) -> Floats:
        """Vertices (n, 3) [m]; of a primitive, those of its tessellation."""
        return self.tessellate().vertices

    @property
    def faces(self) -> Ints:
        """Triangles (m, 3), outward; of a primitive, those of its tessellation."""
        return self.tessellate().faces

    @property
    def is_primitive(self) -> bool:
        return self.kind != "polytope"

    def move(self, pose: Pose) -> Shape:
        """Return the shape moved rigidly; primitives stay what they are."""
        return self.transform(pose.rotation, pose.translation)


def split_scaled_rotation(linear: Floats) -> tuple[Floats, Floats] | None:
    """Return the map as a rotation (3, 3) times positive scales (3,) of the columns, or None where it shears.

    The shapes that ask are symmetric under a flip of an axis, so a reflection becomes a turn.
    """
    scales = np.linalg.norm(linear, axis=0)
    if not np.all(scales > 0):
        return None
    rotation = linear / scales
    if np.abs(rotation.T @ rotation - np.eye(3)).max() > 1e-9:
        return None
    if np.linalg.det(rotation) < 0:
        rotation = rotation * np.array([1.0, 1.0, -1.0])
    return rotation, scales


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
        vertices = freeze_floats(self._vertices, (-1, 3))
        faces = freeze_ints(self._faces, (-1, 3))
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
    """Return volume [m^3] and centre (3,) of a closed surface, by signed tetrahedra about a vertex near the middle."""
    origin = vertices.mean(axis=0)
    a, b, c = (vertices[faces[:, k]] - origin for k in range(3))
    six_volumes = np.einsum("ij,ij->i", a, cross(b, c))
    total = float(six_volumes.sum())
    if total == 0.0:
        return 0.0, freeze_floats(origin, (3,))
    center = (six_volumes[:, None] * (a + b + c)).sum(axis=0) / (4.0 * total)
    return total / 6.0, freeze_floats(origin + center, (3,))


@dataclass(frozen=True, eq=False, slots=True)
class PrimitiveShape(Shape):
    """A primitive about the origin of its pose, root_T_primitive."""

    pose: Pose

    @property
    def centroid(self) -> Floats:
        return self.pose.translation

    @abstractmethod
    def scale(self, pose: Pose, scales: Floats) -> Shape | None:
        """Return the primitive at another pose, scaled (3,) along its axes; None where it is none of its kind then."""

    def transform(self, linear: Floats, offset: Floats) -> Shape:
        split = split_scaled_rotation(linear @ self.pose.rotation)
        made = self.scale(Pose(split[0], linear @ self.pose.translation + offset), split[1]) if split else None
        return made or self.tessellate().transform(linear, offset)


@dataclass(frozen=True, eq=False, slots=True)
class Box(PrimitiveShape):
    """A box about its own centre; half: (3,) half sides along the axes of `pose` [m]."""

    kind: ClassVar[str] = "box"
    half: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "half", freeze_floats(self.half, (3,)))

    @staticmethod
    def of_bounds(bounds: Aabb) -> Box:
        """Return the axis-aligned box that is `bounds`."""
        return Box(Pose.of_translation(bounds.center), bounds.size / 2)

    @property
    def aabb(self) -> Aabb:
        reach = np.abs(self.pose.rotation) @ self.half
        return Aabb(self.pose.translation - reach, self.pose.translation + reach)

    @property
    def volume(self) -> float:
        return float(8.0 * np.prod(self.half))

    def support(self, direction: Floats) -> Floats:
        side = np.where(self.pose.rotation.T @ direction >= 0, 1.0, -1.0)
        return self.pose.rotation @ (side * self.half) + self.pose.translation

    def tessellate(self) -> Polytope:
        return Polytope(self.pose.apply(_BOX_CORNERS * self.half), np.array(_BOX_FACES))

    def scale(self, pose: Pose, scales: Floats) -> Shape:
        return Box(pose, self.half * scales)


def digest(shape: Shape) -> str:
    """Return sixteen hexadecimal digits of the shape's kind and its vertices in single precision, in sorted order."""
    if not isinstance(shape, Polytope):
        return _compute_digest(shape)
    if shape not in _digests:
        _digests[shape] = _compute_digest(shape)
    return _digests[shape]


def _compute_digest(shape: Shape) -> str:
    rounded = sort_rows(shape.vertices.astype(np.float32) + np.float32(0))
    return hashlib.blake2b(shape.kind.encode() + rounded.tobytes(), digest_size=8).hexdigest()


def is_same_shape(a: Shape, b: Shape, tolerance: float = 0.0) -> bool:
    """Return whether two shapes are of one kind with equal tessellations, each coordinate within `tolerance` [m]."""
    if a.kind != b.kind or a.vertices.shape != b.vertices.shape:
        return False
    return bool(np.abs(a.vertices - b.vertices).max() <= tolerance) and np.array_equal(a.faces, b.faces)
