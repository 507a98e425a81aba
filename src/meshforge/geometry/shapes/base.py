"""What every convex shape can tell about itself, whatever its kind."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.pose import Pose

if TYPE_CHECKING:
    from meshforge.geometry.shapes.polytope import Polytope


class Shape(ABC):
    """A convex body in the root frame, write-protected, with analytic measures. Compared by `same_shape`."""

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
        """A point (3,) of the shape that lies farthest along `direction` (3,), which need not be a unit vector."""

    @abstractmethod
    def tessellate(self) -> Polytope:
        """The shape as a polytope: itself, exact for a box, at most 64 inscribed vertices for a round one."""

    @abstractmethod
    def transform(self, linear: Floats, offset: Floats) -> Shape:
        """The image under x -> linear @ x + offset; of the same kind where the map allows it, else a polytope.

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
        """The shape moved rigidly; primitives stay what they are."""
        return self.transform(pose.rotation, pose.translation)


def scaled_rotation(linear: Floats) -> tuple[Floats, Floats] | None:
    """The map as a rotation (3, 3) times positive scales (3,) of the columns, or None where it shears.

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
