"""Distances between convex shapes by coal.

Measured on pairs of all kinds, apart, touching and overlapping, against independent references: wrong by no more
than 1e-7 of the diagonal of the shapes at hand, by 1e-9 in 99 of 100 pairs, and by 1e-10 for boxes that are
square to the axes; where two curved surfaces touch, up to 1e-6. coal errs where coordinates are large or small,
so shapes are measured in coordinates where all together is about one long. Making a polytope with its edges takes
coal ten times as long as a distance: small ones are made once, with an edge between any two vertices, and written to.
"""

from collections.abc import Sequence
from math import dist, frexp
from typing import Any, NamedTuple

import coal
import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.round_shapes import place_primitive
from meshforge.geometry.shape import Polytope, Shape
from meshforge.geometry.solids import cut

_TOLERANCE = 1e-10  # coal's default, 1e-6, is its error on curved shapes; below 1e-11 its iteration begins to stray
_ITERATIONS = 512  # thin shapes need more than the default, 128

CoalObject = tuple[Any, Any]
"""coal's geometry, and its transform."""

_SIZES = (8, 16, 24, 32, 48, 64, 96, 128, 192)  # vertices of polytopes that are written to
_MOST_WITHOUT_EDGES = 32  # vertices: coal looks at each of so few
_MOST_KEPT = 64  # buffers of a size
_TURNS = 32  # of a plane, to find the best one
_MOST_EDGES = 254  # at a vertex; coal counts them in a byte


class _PolytopeBuffer(NamedTuple):
    """coal's polytope whose points (size, 3) can be written; those it has too many are the first again."""

    size: int
    polytope: Any
    points: Floats


_buffers: dict[int, list[_PolytopeBuffer]] = {size: [] for size in _SIZES}


def measure_gaps(shapes: Sequence[Shape], pairs: Sequence[tuple[int, int]], low: Floats, high: Floats) -> list[float]:
    """Return the distance of each pair of shapes [m], 0 where they touch or overlap; low, high: of all (3,)."""
    origin, unit = _choose_frame(low.tolist(), high.tolist())
    used, taken = dict.fromkeys(k for pair in pairs for k in pair), list[_PolytopeBuffer]()
    placed = {k: _place(shapes[k], origin, unit, taken) for k in used}
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.enable_signed_distance = False
    request.gjk_tolerance = _TOLERANCE
    request.gjk_max_iterations = _ITERATIONS
    found: list[float] = []
    for i, j in pairs:
        result.clear()
        gap = coal.distance(*placed[i], *placed[j], request, result)
        found.append(gap * unit if gap > 0.0 else 0.0)
    for one in taken:
        if len(_buffers[one.size]) < _MOST_KEPT:
            _buffers[one.size].append(one)
    return found


def _choose_frame(low: list[float], high: list[float]) -> tuple[Floats, float]:
    """Origin (3,) and unit, a power of two [m], of a frame of two corners, so rounded that small edits keep it."""
    unit = 2.0 ** frexp(dist(low, high))[1]
    return np.array([round((a + b) / unit) * (unit / 2) for a, b in zip(low, high, strict=True)]), unit


def _place(shape: Shape, origin: Floats, unit: float, taken: list[_PolytopeBuffer]) -> CoalObject:
    """The shape in coordinates x -> (x - origin) / unit; the buffer that holds it goes to `taken`."""
    if not isinstance(shape, Polytope):
        made, rotation, translation = place_primitive(coal, shape, origin, unit)
        return made, coal.Transform3s(rotation, translation)
    points = (shape.vertices - origin) / unit
    size = next((size for size in _SIZES if size >= len(points)), None)
    if size is None:
        return _make_polytope(points, shape.faces), coal.Transform3s()
    try:
        one = _buffers[size].pop()
    except IndexError:
        pairs = np.column_stack(np.triu_indices(size, 1)) if size > _MOST_WITHOUT_EDGES else np.array([[0, 1]])
        polytope = _make_polytope(np.zeros((size, 3)), np.column_stack([pairs, pairs[:, 1]]))
        one = _PolytopeBuffer(size, polytope, polytope.points())
    one.points[: len(points)], one.points[len(points) :] = points, points[0]
    taken.append(one)
    return one.polytope, coal.Transform3s()


def _make_polytope(points: Floats, faces: Ints) -> Any:
    mesh = coal.BVHModelOBBRSS()  # triangle meshes take whole arrays
    mesh.beginModel(len(faces), len(points))
    mesh.addVertices(points)
    mesh.addTriangles(faces)
    mesh.buildConvexRepresentation(False)
    return mesh.convex


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
