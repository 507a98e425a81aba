"""What the mesh of an object is: a native primitive that it says it is, or a polytope."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import (
    Aabb,
    Floats,
    Ints,
    Polytope,
    Pose,
    Shape,
    aabb_box,
    aabb_capsule,
    aabb_cylinder,
    aabb_sphere,
    convex_hull,
    is_closed,
)

_FILLING: Mapping[str, Callable[[Aabb], Shape]] = {
    "box": aabb_box,
    "cylinder": aabb_cylinder,
    "capsule": aabb_capsule,
    "sphere": aabb_sphere,
}
_FULL, _ROUND = 0.999, 0.75  # of a box, and of a round primitive, that its mesh fills: an icosphere of Blender does 0.8
_HOLLOW = 1e-3  # of its hull's volume, that an object may lack to count as convex: Blender's own hulls lack 3e-4
_SHEAR = 1e-4


class Illegal(Exception):  # noqa: N818  # a verdict on what came back
    """Why objects are no legal hulls."""


@dataclass(frozen=True, eq=False, slots=True)
class Body:
    """An object's mesh in its own coordinates, and the map x -> linear @ x + offset to those of the scene.

    points: (n, 3); faces: (m, 3); linear: (3, 3); offset: (3,).
    """

    name: str
    points: Floats
    faces: Ints
    linear: Floats
    offset: Floats

    def shape(self, primitive: str | None) -> Shape:
        """The shape, not known to be legal unless it is a primitive. Raises Illegal."""
        finite = all(np.isfinite(numbers).all() for numbers in (self.points, self.linear, self.offset))
        if not len(self.faces) or not finite:
            raise Illegal(f"{self.name}: no faces, or coordinates that are not finite numbers")
        native = self._native(primitive) if primitive is not None else None
        return native or self._polytope()

    def _polytope(self) -> Shape:
        """The polytope; where rounding alone keeps it from being convex, or all its faces look inwards, its hull."""
        shape = Polytope(*self._weld())
        try:
            hull = convex_hull(shape.vertices)
        except GeometryError:
            return shape
        is_hull = is_closed(shape.faces) and abs(hull.volume - abs(shape.volume)) <= _HOLLOW * hull.volume
        return hull if is_hull else shape

    def _weld(self) -> tuple[Floats, Ints]:
        """Corners at one place made one, those of no face left out."""
        points = self.points @ self.linear.T + self.offset
        used, place = np.unique(points[self.faces.ravel()], axis=0, return_inverse=True)
        joined = place.reshape(-1, 3)
        solid = joined[(joined != np.roll(joined, 1, axis=1)).all(axis=1)]
        return used, solid[:, ::-1] if np.linalg.det(self.linear) < 0 else solid

    def _native(self, primitive: str) -> Shape | None:
        """The primitive along the object's own axes; None where it is none, since sides across differ."""
        fill = _FILLING.get(primitive)
        if fill is None:
            raise Illegal(f"{self.name}: there is no primitive {primitive!r}, only {', '.join(_FILLING)}")
        scales = np.linalg.norm(self.linear, axis=0)
        if not (scales > 0).all():
            raise Illegal(f"{self.name}: no thickness")
        turn, _, other = np.linalg.svd(self.linear / scales)
        rotation = turn @ other
        if np.abs(rotation - self.linear / scales).max() > _SHEAR:
            raise Illegal(f"{self.name}: a sheared {primitive}")
        if np.linalg.det(rotation) < 0:
            rotation, scales = -rotation, -scales
        local = self.points * scales
        shape = fill(Aabb.of_points(local)).move(Pose(rotation, self.offset))
        if not shape.is_primitive:
            return None
        filled = abs(Polytope(local, self.faces).volume) / max(shape.volume, np.finfo(float).tiny)
        if not (_FULL if primitive == "box" else _ROUND) <= filled <= 1.001:
            raise Illegal(f"{self.name}: its mesh is not the {primitive} that it says it is")
        return shape
