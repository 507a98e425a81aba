"""Where a surface shows that a part ends: flat patches that go on inside, loops of concave edges; and cuts by them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import connectivity
from meshforge.geometry.arrays import Bools, Floats, Ints, cross
from meshforge.geometry.interior import Interior
from meshforge.geometry.shape import Polytope
from meshforge.geometry.solids import cut, section
from meshforge.geometry.surface import heights_above, neighbour_faces, sample_surface

_LEVEL = np.cos(np.radians(1.0))  # neighbouring faces that turn by less lie in one patch
_CONCAVE = np.sin(np.radians(20.0))  # edges that turn inward by more are creases
_FLAT = 0.08  # of its length, within which a loop of concave edges lies in one plane
_PATCHES, _LOOPS = 200, 60  # that are looked at, the largest
_SAMPLES = 48  # points that stand for a patch or a loop
_COVER = {"patch": 0.4, "loop": 0.5}  # of a section that a patch, or of its outline that a loop has, to end a part
_DEEP = 2e-3  # of the surface's diagonal: a cut that takes less off is none
_ABOVE = 1e-5  # of the surface's diagonal: cuts are so far outside of a patch
_LEAST = 0.01  # of a piece's volume: as above
_LITTLE = 0.05  # of what the surface encloses of a piece, below which what a half has of it must be compact
_LOOSE = 3.0  # times what the surface encloses, that the hulls of compact pieces have at most
_CRUMB = 1e-4  # of a piece, that is enclosed: with less it is not cut
_FILLED = 0.93  # of the hulls of what is enclosed of a piece: one that is fuller need not be cut to be tighter
_GAIN = 0.05  # of what is enclosed of a piece, that a cut must take off these hulls
_TRIES = 12  # creases that are tried, those of most cover
_DEPTH = 8  # cuts through one piece, one after the other


@dataclass(frozen=True, eq=False, slots=True)
class Creases:
    """Planes where parts may end.

    points: (p, s, 3) [m] that stand for each patch or loop; sizes: (p,) its area [m^2] or length [m]; normals: (p, 3);
    loops: (p,) whether it is a loop; planes: (p,) the number of the plane, which patches may share; diagonal: of the
    surface [m].
    """

    points: Floats
    sizes: Floats
    normals: Floats
    loops: Bools
    planes: Ints
    diagonal: float


def find_creases(vertices: Floats, faces: Ints) -> Creases:
    """Return the creases of welded vertices (n, 3) [m] and faces (m, 3)."""
    faces = drop_degenerate(vertices, faces)
    corners = vertices[faces]
    normal, areas = _find_normals(corners)
    pairs = neighbour_faces(faces)
    diagonal = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    rows = [*_find_patches(vertices, faces, normal, areas, pairs), *_find_loops(vertices, faces, corners, pairs)]
    points = np.array([row[0] for row in rows]).reshape(-1, _SAMPLES, 3)
    normals = np.array([row[2] for row in rows]).reshape(-1, 3)
    loops = np.array([row[3] for row in rows], dtype=np.bool_)
    middles = points.mean(axis=1)
    away = np.abs(np.einsum("ijk,jk->ij", middles[:, None] - middles[None], normals))
    near = (
        np.maximum(away, away.T) <= _DEEP / 2 * diagonal
    )  # patches whose middles are in each other's planes share one
    one, other = np.nonzero(near & (np.abs(normals @ normals.T) >= _LEVEL) & ~(loops | loops[:, None]))
    planes = connectivity.component_roots(one, other, len(middles))
    return Creases(points, np.array([row[1] for row in rows]), normals, loops, planes, diagonal)


def drop_degenerate(vertices: Floats, faces: Ints) -> Ints:
    """Return those of some faces (m, 3) that have an area."""
    corners = vertices[faces]
    areas = np.linalg.norm(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    proper: Ints = faces[areas > 1e-12 * max(float(areas.max(initial=0.0)), np.finfo(float).tiny)]
    return proper


def find_concave(corners: Floats, pairs: Ints) -> Bools:
    """Return whether the surface turns inward between each of some pairs (k, 2) of triangles, of corners (m, 3, 3)."""
    normal, _ = _find_normals(corners)
    one, other = normal[pairs[:, 0]], normal[pairs[:, 1]]
    away = corners[pairs[:, 1]].mean(axis=1) - corners[pairs[:, 0]].mean(axis=1)
    found: Bools = (np.einsum("ij,ij->i", one, away) > 0) & (np.linalg.norm(cross(one, other), axis=1) > _CONCAVE)
    return found


def _find_normals(corners: Floats) -> tuple[Floats, Floats]:
    """The normals (m, 3) and areas (m,) [m^2] of triangles with corners (m, 3, 3)."""
    normal = cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normal, axis=1) / 2
    return normal / (2 * areas[:, None]), areas


_Row = tuple[Floats, float, Floats, bool]


def _find_patches(vertices: Floats, faces: Ints, normal: Floats, areas: Floats, pairs: Ints) -> list[_Row]:
    level = pairs[np.einsum("ij,ij->i", normal[pairs[:, 0]], normal[pairs[:, 1]]) >= _LEVEL]
    root = connectivity.component_roots(level[:, 0], level[:, 1], len(areas))
    total = np.bincount(root, weights=areas, minlength=len(areas))
    largest = np.argsort(-total, kind="stable")[:_PATCHES]
    found: list[_Row] = []
    for place in largest[total[largest] > 0].tolist():
        own = root == place
        across = (normal[own] * areas[own, None]).sum(axis=0)
        length = float(np.linalg.norm(across))
        if length > 0.99 * total[place]:
            points, _ = sample_surface(vertices, faces[own], _SAMPLES)
            found.append((points, float(total[place]), across / length, False))
    return found


def _find_loops(vertices: Floats, faces: Ints, corners: Floats, pairs: Ints) -> list[_Row]:
    if not len(pairs):
        return []
    concave = pairs[find_concave(corners, pairs)]
    shared = (np.intersect1d(faces[a], faces[b])[:2] for a, b in concave.tolist())
    edges = np.array([both for both in shared if len(both) == 2], dtype=np.int64).reshape(-1, 2)
    if not len(edges):
        return []
    root = connectivity.component_roots(edges[:, 0], edges[:, 1], len(vertices))[edges[:, 0]]
    lengths = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
    total = np.bincount(root, weights=lengths)
    found: list[_Row] = []
    for place in np.argsort(-total, kind="stable")[:_LOOPS].tolist():
        own = root == place
        if own.sum() < 4:
            continue
        sums, share = np.cumsum(lengths[own]), np.random.default_rng(0).random((_SAMPLES, 1))
        places = np.searchsorted(sums, (np.arange(_SAMPLES) + 0.5) / _SAMPLES * sums[-1])
        a, b = vertices[edges[own]][np.minimum(places, len(sums) - 1)].transpose(1, 0, 2)
        points = a + share * (b - a)
        _, extents, axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
        if extents[2] <= _FLAT * extents[0]:
            found.append((points, float(total[place]), axes[2], True))
    return found


def cut_at_creases(piece: Polytope, creases: Creases, interior: Interior, depth: int = _DEPTH) -> list[Polytope]:
    """Return the convex parts of a piece between the creases that go through it, none mostly outside of the surface;
    depth: how many cuts follow each other at most."""
    best = _choose(piece, creases, interior) if depth and len(creases.sizes) else None
    if best is None:
        return [piece]
    return [half for part in best for half in cut_at_creases(part, creases, interior, depth - 1)]


def _choose(piece: Polytope, creases: Creases, interior: Interior) -> tuple[Polytope, Polytope] | None:
    """The two halves of a piece at the crease that has most of its section there, None where none has enough."""
    volume = interior.measure(piece)
    if volume <= _CRUMB * piece.volume:
        return None
    deep = _DEEP * creases.diagonal
    points, low, high = creases.points.reshape(-1, 3), piece.aabb.min - deep / 4, piece.aabb.max + deep / 4
    found = np.asarray(((points >= low) & (points <= high)).all(axis=1))
    found[found] = heights_above(points[found], piece) <= deep / 4
    inside = found.reshape(creases.points.shape[:2])
    within = inside.mean(axis=1) * creases.sizes
    total = np.bincount(creases.planes, weights=within)
    covers = list[tuple[float, int]]()
    for place in np.flatnonzero(within > 0).tolist():
        at, across = creases.points[place][inside[place]].mean(axis=0), creases.normals[place]
        heights = (piece.vertices - at) @ across
        if min(float(heights.max()), float(-heights.min())) < deep:
            continue
        area, perimeter = section(piece, at, across)
        kind, whole = ("loop", perimeter) if creases.loops[place] else ("patch", area)
        cover = float(total[creases.planes[place]]) / max(whole, np.finfo(float).tiny)
        covers.append((-min(cover / _COVER[kind], 2.0), place))
    halves = ((-less >= 1, _cut_along(piece, creases, inside, place)) for less, place in sorted(covers)[:_TRIES])
    left = list[tuple[Polytope, Polytope]]()
    for ends, both in halves:
        if both is None or min(half.volume for half in both) < _LEAST * piece.volume:
            continue
        if ends and _leaves_compact(*both, interior):
            return both
        left.append(both)
    return _choose_tightest(piece, volume, left, interior)


def _cut_along(piece: Polytope, creases: Creases, inside: Bools, place: int) -> tuple[Polytope, Polytope] | None:
    """The two halves of a piece at one crease; None where one is none. What lies below a patch is in one of them."""
    across = creases.normals[place]
    at = creases.points[place][inside[place]].mean(axis=0) + _ABOVE * creases.diagonal * across
    try:
        below, above = cut(piece, at, across)
    except GeometryError:
        return None
    return (below, above) if below and above else None


def _choose_tightest(
    piece: Polytope, volume: float, halves: Sequence[tuple[Polytope, Polytope]], interior: Interior
) -> tuple[Polytope, Polytope] | None:
    """The halves of which the hulls are smallest, where the interior, of which a piece has a volume [m^3], fills little
    of the hulls around that."""
    whole = _measure_hulls([piece], interior) if halves else 0.0
    if volume >= _FILLED * whole:
        return None
    sums = [_measure_hulls(both, interior) for both in halves]
    best = int(np.argmin(sums))
    return halves[best] if whole - sums[best] >= _GAIN * volume else None


def _measure_hulls(shapes: Sequence[Polytope], interior: Interior) -> float:
    return sum(hull.volume for hull in interior.list_hulls(shapes))


def _leaves_compact(below: Polytope, above: Polytope, interior: Interior) -> bool:
    """Whether a half with little of the interior has it in compact pieces: a small part, no ring or rim of a larger."""
    volumes = [interior.measure(half) for half in (below, above)]
    little = int(volumes[1] < volumes[0])
    if volumes[little] >= _LITTLE * sum(volumes):
        return True
    return _measure_hulls([(below, above)[little]], interior) <= _LOOSE * volumes[little]
