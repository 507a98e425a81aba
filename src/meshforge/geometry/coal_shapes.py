"""Shapes as coal has them, in coordinates where all that is measured together is about one long.

coal errs on other coordinates. The frame's origin and unit are rounded, so that shapes which stay through an edit
mostly keep their frame, and with it what coal was given.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import dist, frexp
from struct import pack
from typing import Any
from weakref import WeakKeyDictionary

import coal
import numpy as np

from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.shapes import Box, Capsule, Cylinder, Ellipsoid, Polytope, Shape, Sphere

Placed = tuple[Any, Any]
"""coal's geometry, and its transform."""

_SMALL = 32  # coal looks at every point of a shape that has no more; on larger ones it climbs along the edges
_SIZES = (48, 64, 96, 128)  # of shapes with an edge between any two points; beyond, climbing is worth its price
_IDENTITY = coal.Transform3s()
_NONE = (b"", None)
_known: WeakKeyDictionary[Polytope, tuple[bytes, Any]] = WeakKeyDictionary()


@dataclass(frozen=True, eq=False, slots=True)
class Frame:
    """x -> (x - origin) / unit; origin: (3,) [m]; unit: a power of two [m]; key: equal for equal frames."""

    origin: Floats
    unit: float
    key: bytes

    @staticmethod
    def around(low: Floats, high: Floats) -> Frame:
        """The frame of all that is between two corners (3,)."""
        unit = 2.0 ** frexp(dist(low.tolist(), high.tolist()))[1]
        origin: Floats = np.round((low + high) / unit) * (unit / 2)
        return Frame(origin, unit, origin.tobytes() + pack("d", unit))

    def all_placed(self, shapes: Sequence[Shape]) -> list[Placed]:
        """Shapes in this frame."""
        convex = self._convex({id(shape): shape for shape in shapes if isinstance(shape, Polytope)})
        return [(convex[id(s)], _IDENTITY) if isinstance(s, Polytope) else self._primitive(s) for s in shapes]

    def _convex(self, polytopes: Mapping[int, Polytope]) -> dict[int, Any]:
        """coal's shapes of polytopes, under the same keys; those made before in an equal frame are taken again."""
        found = {k: _known.get(polytope, _NONE) for k, polytope in polytopes.items()}
        convex = {k: made for k, (frame, made) in found.items() if frame == self.key}
        new = [(k, polytope) for k, polytope in polytopes.items() if k not in convex]
        if new:
            points = (np.concatenate([polytope.vertices for _, polytope in new]) - self.origin) / self.unit
        stop = 0
        for k, polytope in new:
            start, stop = stop, stop + len(polytope.vertices)
            convex[k] = _made(points[start:stop], polytope.faces)
            _known[polytope] = self.key, convex[k]
        return convex

    def _primitive(self, shape: Shape) -> Placed:
        match shape:
            case Box():
                made = coal.Box(*(2 * shape.half / self.unit))
            case Sphere():
                made = coal.Sphere(shape.radius / self.unit)
            case Cylinder():
                made = coal.Cylinder(shape.radius / self.unit, 2 * shape.half_length / self.unit)
            case Capsule():
                made = coal.Capsule(shape.radius / self.unit, 2 * shape.half_length / self.unit)
            case Ellipsoid():
                made = coal.Ellipsoid(*(shape.radii / self.unit))
            case _:
                raise TypeError(f"no distance for shapes of kind {shape.kind}")
        return made, coal.Transform3s(shape.pose.rotation, (shape.pose.translation - self.origin) / self.unit)


def _made(points: Floats, faces: Ints) -> Any:
    count = len(points)
    if count > _SIZES[-1]:
        return _by_arrays(points, faces)
    made = _blank(count if count <= _SMALL else next(size for size in _SIZES if size >= count)).clone()
    places = made.points()
    places[:count] = points
    places[count:] = points[0]
    return made


@lru_cache(maxsize=_SMALL + len(_SIZES))
def _blank(count: int) -> Any:
    """A shape to be copied and given its points, ten times as fast as making one of its own edges.

    coal looks at every point: there are few, or each has an edge to each.
    """
    pairs = np.column_stack(np.triu_indices(count, 1)) if count > _SMALL else np.array([[0, 1]])
    return _by_arrays(np.zeros((count, 3)), np.column_stack([pairs, pairs[:, 1]]))


def _by_arrays(points: Floats, faces: Ints) -> Any:
    """coal's convex shape by way of its triangle meshes, which take whole arrays."""
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(faces), len(points))
    mesh.addVertices(points)
    mesh.addTriangles(faces)
    mesh.buildConvexRepresentation(False)
    return mesh.convex
