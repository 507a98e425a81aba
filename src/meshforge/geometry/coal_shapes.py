"""Shapes as coal has them, in coordinates where all that is measured together is about one long.

coal errs on other coordinates. What takes coal's time is making a polytope and its edges; so polytopes of up to 192
vertices are poured into vessels: polytopes of coal's with an edge between any two vertices, made once, used again and
again. coal looks at every vertex of them, or climbs in one step to the best, and finds the same points.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import dist, frexp
from typing import Any, NamedTuple

import coal
import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.cut import cut
from meshforge.geometry.shapes import Box, Capsule, Cylinder, Ellipsoid, Polytope, Shape, Sphere

Placed = tuple[Any, Any]
"""coal's geometry, and its transform."""

_SIZES = (8, 16, 24, 32, 48, 64, 96, 128, 192)  # of vessels; on more vertices climbing is worth the price of edges
_LOOKED_AT = 32  # coal looks at every vertex of a polytope that has no more, and needs no edges
_IDLE = 64  # vessels of a size that are kept
_TURNS = 32  # of a plane, to find the best one
_EDGES = 254  # at a vertex; coal counts them in a byte
_STILL = coal.Transform3s()


@dataclass(frozen=True, eq=False, slots=True)
class Frame:
    """x -> (x - origin) / unit; origin: (3,) [m]; unit: a power of two [m]."""

    origin: Floats
    unit: float

    @staticmethod
    def of_bounds(low: Floats, high: Floats) -> Frame:
        """The frame of all that is between two corners (3,); rounded, so that small edits mostly keep it."""
        bottom, top = low.tolist(), high.tolist()
        unit = 2.0 ** frexp(dist(bottom, top))[1]
        return Frame(np.array([round((a + b) / unit) * (unit / 2) for a, b in zip(bottom, top, strict=True)]), unit)

    @contextmanager
    def place(self, shapes: Sequence[Shape]) -> Iterator[list[Placed]]:
        """Shapes in this frame, as long as the context lasts."""
        filled: list[_Vessel] = []
        try:
            yield self._place_all(shapes, filled)
        finally:
            for vessel in filled:
                if len(idle := _idle[vessel.size]) < _IDLE:
                    idle.append(vessel)

    def _place_all(self, shapes: Sequence[Shape], filled: list[_Vessel]) -> list[Placed]:
        polytopes = [shape.vertices for shape in shapes if isinstance(shape, Polytope)]
        points = (np.concatenate(polytopes) - self.origin) / self.unit if polytopes else None
        placed: list[Placed] = []
        stop = 0
        for shape in shapes:
            if not isinstance(shape, Polytope):
                placed.append(self._place_primitive(shape))
                continue
            assert points is not None
            start, stop = stop, stop + len(shape.vertices)
            if stop - start > _SIZES[-1]:
                placed.append((_by_arrays(points[start:stop], shape.faces), _STILL))
                continue
            vessel = _filled(points[start:stop])
            filled.append(vessel)
            placed.append((vessel.shape, _STILL))
        return placed

    def _place_primitive(self, shape: Shape) -> Placed:
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


def parts(shape: Shape) -> list[Shape]:
    """Shapes that coal can have, which are the shape together: mostly itself, else what it is cut into.

    Raises GeometryError where no cut makes the shape simpler.
    """
    if not isinstance(shape, Polytope) or len(shape.vertices) <= _EDGES:
        return [shape]
    edges = np.bincount(shape.faces.ravel())
    if edges.max() <= _EDGES:
        return [shape]
    normal, hub = _halving(shape, edges)
    halves = [half for half in cut(shape, hub, normal) if half is not None]
    if any(np.bincount(half.faces.ravel()).max() >= edges.max() for half in halves):
        raise GeometryError(
            f"a vertex of a hull has {edges.max()} edges, more than can be measured",
            remedy="Give the hull fewer vertices.",
        )
    return [part for half in halves for part in parts(half)]


def _halving(shape: Polytope, edges: Ints) -> tuple[Floats, Floats]:
    """The normal (3,) of a plane and a point (3,) on it, by which a vertex with too many edges loses half of them.

    Two such vertices both lie on it. edges: of each vertex.
    """
    first, second = np.argsort(-edges, kind="stable")[:2]
    around = np.unique(shape.faces[(shape.faces == first).any(axis=1)])
    ways = shape.vertices[around[around != first]] - shape.vertices[first]
    along = shape.vertices[second] - shape.vertices[first] if edges[second] > _EDGES else ways.mean(axis=0)
    across = np.linalg.svd(along[None])[2][1:]  # two directions square to it
    turns = np.arange(_TURNS) * (np.pi / _TURNS)
    normals = np.column_stack([np.cos(turns), np.sin(turns)]) @ across
    return normals[np.abs(np.sign(ways @ normals.T).sum(axis=0)).argmin()], shape.vertices[first]


class _Vessel(NamedTuple):
    """A polytope of coal's and the array (size, 3) of its points, which can be written."""

    size: int
    shape: Any
    points: Floats


_idle: dict[int, list[_Vessel]] = {size: [] for size in _SIZES}


def _filled(points: Floats) -> _Vessel:
    """A vessel that holds points (n, 3), n at most the largest size; what it has too many is the first of them."""
    count = len(points)
    size = _SIZES[bisect_left(_SIZES, count)]
    try:
        vessel = _idle[size].pop()
    except IndexError:
        vessel = _vessel(size)
    vessel.points[:count] = points
    if count < size:
        vessel.points[count:] = points[0]
    return vessel


def _vessel(size: int) -> _Vessel:
    pairs = np.column_stack(np.triu_indices(size, 1)) if size > _LOOKED_AT else np.array([[0, 1]])
    shape = _by_arrays(np.zeros((size, 3)), np.column_stack([pairs, pairs[:, 1]]))
    return _Vessel(size, shape, shape.points())


def _by_arrays(points: Floats, faces: Ints) -> Any:
    """coal's polytope by way of its triangle meshes, which take whole arrays."""
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(faces), len(points))
    mesh.addVertices(points)
    mesh.addTriangles(faces)
    mesh.buildConvexRepresentation(False)
    return mesh.convex
