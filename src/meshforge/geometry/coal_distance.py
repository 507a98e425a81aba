"""Distances between convex shapes by coal.

Measured on pairs of all kinds, apart, touching and overlapping, against independent references: wrong by no more
than 1e-7 of the diagonal of the shapes at hand, by 1e-9 in 99 of 100 pairs, and by 1e-10 for boxes that are
square to the axes; where two curved surfaces touch, up to 1e-6. coal errs where coordinates are large or small,
so shapes are measured in coordinates where all together is about one long. Making a polytope and its edges takes
coal most time: polytopes of up to 192 vertices reuse pooled ones that have an edge between any two vertices.
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

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.round_shapes import Capsule, Cylinder, Ellipsoid, Sphere
from meshforge.geometry.shape import Box, Polytope, Shape
from meshforge.geometry.solids import cut

_TOLERANCE = 1e-10  # coal's default, 1e-6, is its error on curved shapes; below 1e-11 its iteration begins to stray
_ITERATIONS = 512  # thin shapes need more than the default, 128

CoalObject = tuple[Any, Any]
"""coal's geometry, and its transform."""

_POOLED_SIZES = (8, 16, 24, 32, 48, 64, 96, 128, 192)  # vertices; of more, climbing is worth the price of edges
_MOST_WITHOUT_EDGES = 32  # coal looks at every vertex of a polytope that has no more, and needs no edges
_POOL_SIZE = 64  # pooled polytopes of a size that are kept
_TURNS = 32  # of a plane, to find the best one
_MOST_EDGES = 254  # at a vertex; coal counts them in a byte
_IDENTITY = coal.Transform3s()

_pool: dict[int, list[_PoolPolytope]] = {size: [] for size in _POOLED_SIZES}


def measure_gaps(shapes: Sequence[Shape], pairs: Sequence[tuple[int, int]], low: Floats, high: Floats) -> list[float]:
    """Return the distance of each pair of shapes [m], 0 where they touch or overlap; low, high: corners (3,) about
    all."""
    frame = CoalFrame.of_bounds(low, high)
    used = list(dict.fromkeys(k for pair in pairs for k in pair))
    with frame.place([shapes[k] for k in used]) as found:
        placed = dict(zip(used, found, strict=True))
        return [gap * frame.unit for gap in _measure_gaps([(placed[i], placed[j]) for i, j in pairs])]


def _measure_gaps(pairs: list[tuple[CoalObject, CoalObject]]) -> list[float]:
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.enable_signed_distance = False
    request.gjk_tolerance = _TOLERANCE
    request.gjk_max_iterations = _ITERATIONS
    found: list[float] = []
    for (one, pose), (other, other_pose) in pairs:
        result.clear()
        gap = coal.distance(one, pose, other, other_pose, request, result)
        found.append(gap if gap > 0.0 else 0.0)
    return found


@dataclass(frozen=True, eq=False, slots=True)
class CoalFrame:
    """x -> (x - origin) / unit; origin: (3,) [m]; unit: a power of two [m]."""

    origin: Floats
    unit: float

    @staticmethod
    def of_bounds(low: Floats, high: Floats) -> CoalFrame:
        """Return the frame of all that is between two corners (3,); rounded, so that small edits mostly keep it."""
        bottom, top = low.tolist(), high.tolist()
        unit = 2.0 ** frexp(dist(bottom, top))[1]
        return CoalFrame(np.array([round((a + b) / unit) * (unit / 2) for a, b in zip(bottom, top, strict=True)]), unit)

    @contextmanager
    def place(self, shapes: Sequence[Shape]) -> Iterator[list[CoalObject]]:
        """Place shapes in this frame, as long as the context lasts."""
        filled: list[_PoolPolytope] = []
        try:
            yield self._place_all(shapes, filled)
        finally:
            for pooled in filled:
                if len(idle := _pool[pooled.size]) < _POOL_SIZE:
                    idle.append(pooled)

    def _place_all(self, shapes: Sequence[Shape], filled: list[_PoolPolytope]) -> list[CoalObject]:
        polytopes = [shape.vertices for shape in shapes if isinstance(shape, Polytope)]
        points = (np.concatenate(polytopes) - self.origin) / self.unit if polytopes else None
        placed: list[CoalObject] = []
        stop = 0
        for shape in shapes:
            if not isinstance(shape, Polytope):
                placed.append(self._place_primitive(shape))
                continue
            assert points is not None
            start, stop = stop, stop + len(shape.vertices)
            if stop - start > _POOLED_SIZES[-1]:
                placed.append((_polytope_of_arrays(points[start:stop], shape.faces), _IDENTITY))
                continue
            pooled = _take_from_pool(points[start:stop])
            filled.append(pooled)
            placed.append((pooled.shape, _IDENTITY))
        return placed

    def _place_primitive(self, shape: Shape) -> CoalObject:
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


def split_shape(shape: Shape) -> list[Shape]:
    """Return shapes that coal can have, which are the shape together: mostly itself, else what it is cut into.

    Raises GeometryError where no cut makes the shape simpler.
    """
    if not isinstance(shape, Polytope) or len(shape.vertices) <= _MOST_EDGES:
        return [shape]
    edges = np.bincount(shape.faces.ravel())
    if edges.max() <= _MOST_EDGES:
        return [shape]
    normal, hub = _find_halving_plane(shape, edges)
    halves = [half for half in cut(shape, hub, normal) if half is not None]
    if any(np.bincount(half.faces.ravel()).max() >= edges.max() for half in halves):
        problem = f"a vertex of a hull has {edges.max()} edges, more than can be measured"
        raise GeometryError(problem, remedy="Give the hull fewer vertices.")
    return [part for half in halves for part in split_shape(half)]


def _find_halving_plane(shape: Polytope, edges: Ints) -> tuple[Floats, Floats]:
    """The normal (3,) of a plane and a point (3,) on it, by which a vertex with too many edges loses half of them.

    Two such vertices both lie on it. edges: of each vertex.
    """
    first, second = np.argsort(-edges, kind="stable")[:2]
    around = np.unique(shape.faces[(shape.faces == first).any(axis=1)])
    ways = shape.vertices[around[around != first]] - shape.vertices[first]
    along = shape.vertices[second] - shape.vertices[first] if edges[second] > _MOST_EDGES else ways.mean(axis=0)
    across = np.linalg.svd(along[None])[2][1:]  # two directions square to it
    turns = np.arange(_TURNS) * (np.pi / _TURNS)
    normals = np.column_stack([np.cos(turns), np.sin(turns)]) @ across
    return normals[np.abs(np.sign(ways @ normals.T).sum(axis=0)).argmin()], shape.vertices[first]


class _PoolPolytope(NamedTuple):
    """A polytope of coal's and the array (size, 3) of its points, which can be written."""

    size: int
    shape: Any
    points: Floats


def _take_from_pool(points: Floats) -> _PoolPolytope:
    """A pooled polytope of points (n, 3), n at most the largest size; what it has too many is the first of them."""
    count = len(points)
    size = _POOLED_SIZES[bisect_left(_POOLED_SIZES, count)]
    try:
        pooled = _pool[size].pop()
    except IndexError:
        pooled = _make_pool_polytope(size)
    pooled.points[:count] = points
    if count < size:
        pooled.points[count:] = points[0]
    return pooled


def _make_pool_polytope(size: int) -> _PoolPolytope:
    pairs = np.column_stack(np.triu_indices(size, 1)) if size > _MOST_WITHOUT_EDGES else np.array([[0, 1]])
    shape = _polytope_of_arrays(np.zeros((size, 3)), np.column_stack([pairs, pairs[:, 1]]))
    return _PoolPolytope(size, shape, shape.points())


def _polytope_of_arrays(points: Floats, faces: Ints) -> Any:
    """coal's polytope by way of its triangle meshes, which take whole arrays."""
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(faces), len(points))
    mesh.addVertices(points)
    mesh.addTriangles(faces)
    mesh.buildConvexRepresentation(False)
    return mesh.convex
