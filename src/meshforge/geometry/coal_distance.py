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

from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.round_shapes import place_primitive
from meshforge.geometry.shape import Polytope, Shape
from meshforge.geometry.surface import heights_above

_TOLERANCE = 1e-10  # coal's default, 1e-6, is its error on curved shapes; below 1e-11 its iteration begins to stray
_ITERATIONS = 512  # thin shapes need more than the default, 128

CoalObject = tuple[Any, Any]
"""coal's geometry, and its transform."""

_SIZES = (8, 16, 24, 32, 48, 64, 96, 128, 192)  # vertices of polytopes that are written to
_MOST_WITHOUT_EDGES = 32  # vertices: coal looks at each of so few
_MOST_KEPT = 64  # buffers of a size
_MOST_EDGES = 254  # at a vertex of a polytope; coal counts them in a byte


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
        apart = gap > 0.0 and not any(_surrounds(shapes[a], shapes[b]) for a, b in ((i, j), (j, i)))
        found.append(gap * unit if apart else 0.0)
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
    if _has_many_edges(shape):
        surface = _make_mesh(points, shape.faces)
        surface.endModel()
        return surface, coal.Transform3s()
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


def _has_many_edges(shape: Polytope) -> bool:
    """Whether a vertex has more edges than coal can count, so that the surface is measured, as a mesh."""
    return len(shape.vertices) > _MOST_EDGES and int(np.bincount(shape.faces.ravel()).max()) > _MOST_EDGES


def _surrounds(shape: Shape, other: Shape) -> bool:
    """Whether a shape that is measured as a mesh has another one inside, away from its surface."""
    if not (isinstance(shape, Polytope) and _has_many_edges(shape)):
        return False
    return bool(heights_above(other.vertices.mean(axis=0)[None], shape)[0] < 0)


def _make_mesh(points: Floats, faces: Ints) -> Any:
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(faces), len(points))
    mesh.addVertices(points)
    mesh.addTriangles(faces)
    return mesh


def _make_polytope(points: Floats, faces: Ints) -> Any:
    mesh = _make_mesh(points, faces)  # triangle meshes take whole arrays
    mesh.buildConvexRepresentation(False)
    return mesh.convex
