"""Whether a piece of surface counts as a hull: closed, not flat, and as full as its convex hull; and what keeps a shape
from being one."""

from dataclasses import dataclass, replace
from math import floor
from typing import Literal

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints, cross, distinct
from meshforge.geometry.connectivity import compact, component_roots, components_by_vertices, edges_of, row_ids
from meshforge.geometry.convex import convex_hull, hull_by_manifold, measure_extents, spans_volume
from meshforge.geometry.inner_shapes import shrink
from meshforge.geometry.interior import Interior
from meshforge.geometry.shape import Polytope, Shape
from meshforge.geometry.surface import is_closed, is_convex, is_convex_hull, is_outward, planes_of

LEAST_FILL = 0.95
"""A piece is a hull when its volume is at least this share of its convex hull's."""
_MOST_FILL = 1.05  # a surface that encloses more than its hull runs through itself
_LEVEL = 1e-3  # a hole is planar when it is level within this share of the piece's size
_DEPTH = 0.01  # a face lies on the hull when it is no deeper in it than this share of the hull's thickness
_DENT = 0.125  # a surface with a face deeper than this has a hole or a dent (decisions/0054)
_MOST_VERTICES = 2000  # of a hull in which narrow holes are told from wide ones
_PEG = 0.05  # of the diagonal: the width of a peg that enters no hole which a hull may close
_LARGE = 1_000_000  # pairs of faces; beyond, a surface is no careless triangulation of a hull
_MANY = 200  # triangles, from which on a piece is held against a rough hull before one is verified
_FEW = 4  # planes of a hull near a point that are tried first
_FIRST = 100  # points of a surface that are tried first
_THIN = 1e-3  # of its size: a rough hull that is thinner is not trusted
_FLAT = 1e-6  # a piece is flat when its hull is thinner than this share of its size


@dataclass(frozen=True, eq=False, slots=True)
class SolidityVerdict:
    """shape: the convex hull, None with a reason; volume [m^3]: of the piece, negative where it is inside out.

    closed: whether there was no hole to fill; fill: of a hull that closes narrow holes the share that is filled.
    """

    shape: Polytope | None
    reason: str | None
    volume: float = 0.0
    closed: bool = False
    fill: float | None = None


def judge_solidity(points: Floats, corners: Ints) -> SolidityVerdict:
    """Return what a piece of points (n, 3) and distinct triangles (m, 3) is; the winding may be inverted or mixed."""
    used, corners = compact(corners)
    points = points[used]
    made = hull_by_manifold(points - points.mean(axis=0)) if len(corners) > _MANY else None
    rough = Polytope(points[made[0]], made[1]) if made else None  # to a millionth, not verified
    if rough and not _is_flat(rough, _THIN) and (found := _judge_by_hull(points, corners, rough)).shape is None:
        return found
    try:
        hull = convex_hull(points)
    except GeometryError:
        return SolidityVerdict(None, "flat")
    return SolidityVerdict(None, "flat") if _is_flat(hull, _FLAT) else _judge_by_hull(points, corners, hull)


def refuse_dents(verdict: SolidityVerdict, points: Floats, corners: Ints) -> SolidityVerdict:
    """Return the verdict on a piece of points (n, 3) and distinct triangles (m, 3): no hull where it has a hole or a
    dent that a peg enters; a hull with the share that it fills where it has narrower ones."""
    hull = verdict.shape
    used, corners = compact(corners)
    handles = int(components_by_vertices(corners).max()) + 1 - (2 * len(used) - len(corners)) / 4
    depth = _DEPTH if handles > 0 and is_closed(corners) else _DENT
    if hull is None or not _is_deep(points[used], corners, hull, depth):
        return verdict
    share = abs(verdict.volume) / hull.volume
    outward = corners if verdict.volume > 0 else corners[:, ::-1]
    if not _lets_peg_in(points[used], outward, hull, depth):
        return replace(verdict, fill=share)
    full = f"fills {min(floor(100 * share), 99)}% of its convex hull"
    return replace(verdict, shape=None, reason=f"not convex: {full}, but has a hole or dent")


def _lets_peg_in(points: Floats, corners: Ints, hull: Polytope, share: float) -> bool:
    """Whether a peg may come deeper into a hull than a share of the hull's thickness: what is deep and not filled is as
    wide as the peg then along the middle side of a box around it, but for a tenth where the box is askew."""
    from scipy.spatial.distance import pdist  # lazy: 0.5 s, half of all imports

    if len(hull.vertices) > _MOST_VERTICES:
        return True
    level = shrink(hull, _DEPTH * _thickness(hull), "the hull").tessellate()  # what is shallow joins no holes
    voids = Interior(points, corners).list_voids(level)
    width = _PEG * 0.9 * float(pdist(hull.vertices).max())
    return voids is None or any(
        measure_extents(around)[1] >= width and _is_deep(around, faces, hull, share) for around, faces in voids
    )


def _judge_by_hull(points: Floats, corners: Ints, hull: Polytope) -> SolidityVerdict:
    result = _judge_fill(points, corners, hull)
    if result.shape is None and not is_closed(corners):
        aligned = _judge_fill(points, _align_windings(corners), hull)
        result = aligned if aligned.shape else result
    has_area = _area(points, corners) >= LEAST_FILL * _area(hull.vertices, hull.faces)
    may_cover = result.shape is None and has_area and len(hull.faces) * len(corners) <= _LARGE
    if may_cover and not _is_deep(points, corners, hull, _DEPTH):  # however its triangles overlap and are wound
        return SolidityVerdict(hull, None, hull.volume, True)
    return result


def _is_flat(hull: Polytope, share: float) -> bool:
    """Whether a hull is thinner than a share of its size."""
    return _thickness(hull) <= share * float(hull.aabb.size.max())


def _thickness(hull: Polytope) -> float:
    """The mean thickness [m]: volume by half the area."""
    return hull.volume / max(_area(hull.vertices, hull.faces) / 2, np.finfo(float).tiny)


def _area(points: Floats, corners: Ints) -> float:
    a, b, c = (points[corners[:, k]] for k in range(3))
    return float(np.linalg.norm(cross(b - a, c - a), axis=1).sum()) / 2


def _is_deep(points: Floats, corners: Ints, hull: Polytope, share: float) -> bool:
    """Whether a surface lies deeper in its hull somewhere than a share of the hull's thickness.

    Depth is concave on a triangle: in its middle or that of a side it is no less than a third of what it is anywhere.
    """
    planes = planes_of(hull.vertices, hull.faces)
    least = planes.offsets - share * _thickness(hull)
    middles = [points[corners[:, list(ends)]].mean(axis=1) for ends in ((0, 1, 2), (0, 1), (1, 2), (2, 0))]
    left = np.concatenate([points, *middles]) - planes.middle
    if len(left) * len(least) > _LARGE:
        from scipy.spatial import cKDTree  # lazy: slow to import, only large surfaces need it

        around = hull.vertices[hull.faces[planes.face_indices]].mean(axis=1) - planes.middle
        nearest = list(range(1, min(len(around), _FEW) + 1))
        near = cKDTree(around).query(left, nearest)[1]  # by one of these planes nearly all are shallow
        left = left[(np.einsum("ij,ikj->ik", left, planes.normals[near]) < least[near]).all(axis=1)]
    some = [left[:: len(left) // _FIRST + 1], *np.array_split(left, len(left) * len(least) // _LARGE + 1)]
    return any((points @ planes.normals.T < least).all(axis=1).any() for points in some)


def _judge_fill(points: Floats, corners: Ints, hull: Polytope) -> SolidityVerdict:
    size = float(np.ptp(points, axis=0).max())
    origin = hull.centroid
    a, b, c = (points[corners[:, k]] - origin for k in range(3))
    six_volumes = float(np.einsum("ij,ij->i", a, cross(b, c)).sum())
    rim, weight = _find_rim(corners)
    if len(rim):
        caps = _volume_of_caps(points, rim, weight, origin, _LEVEL * size)
        if caps is None:
            return SolidityVerdict(None, "open: it has a hole that is not planar")
        six_volumes += caps
    volume = six_volumes / 6
    share = abs(volume) / hull.volume
    if share < LEAST_FILL:
        return SolidityVerdict(
            None, f"not convex: fills {floor(100 * share)}% of its convex hull", volume, len(rim) == 0
        )
    if share > _MOST_FILL:
        return SolidityVerdict(None, "it overlaps itself", volume, len(rim) == 0)
    return SolidityVerdict(hull, None, volume, len(rim) == 0)


def _find_rim(corners: Ints) -> tuple[Ints, Ints]:
    """The edges (k, 2) that triangles leave open, as the triangles run along them, and how many times each."""
    if is_closed(corners):
        return corners[:0, :2], corners[:0, 0]
    edges, forward = edges_of(corners)
    ids, first = row_ids(*edges.T)
    net = np.zeros(len(first), dtype=np.int64)
    np.add.at(net, ids, np.where(forward, 1, -1))
    left = np.flatnonzero(net)
    rim = edges[first[left]]
    back = net[left] < 0
    rim[back] = rim[back][:, ::-1]
    return rim, np.abs(net[left])


def _volume_of_caps(points: Floats, rim: Ints, weight: Ints, origin: Floats, level: float) -> float | None:
    """Six times the volume that planar caps over the holes add; None where a hole is not planar."""
    used, local = np.unique(rim, return_inverse=True)
    local = local.reshape(-1, 2)
    hole = component_roots(local[:, 0], local[:, 1], len(used))
    total = 0.0
    for k in distinct(hole):
        edges = local[hole[local[:, 0]] == k]
        around = points[used[distinct(edges)]]
        middle = around.mean(axis=0)
        _, axes = np.linalg.eigh((around - middle).T @ (around - middle))
        if float(np.abs((around - middle) @ axes[:, 0]).max()) > level:
            return None
        a, b = (points[used[edges[:, end]]] - origin for end in (1, 0))
        turns = weight[hole[local[:, 0]] == k]
        total += float((turns * np.einsum("ij,ij->i", a, np.cross(b, middle - origin))).sum())
    return total


def _align_windings(corners: Ints) -> Ints:
    """The triangles wound as their neighbours are, as far as edges of two triangles tell."""
    edges, forward = edges_of(corners)
    face = np.tile(np.arange(len(corners)), 3)
    ids, _ = row_ids(*edges.T)
    shared = np.flatnonzero(np.bincount(ids)[ids] == 2)
    pairs = shared[np.argsort(ids[shared], kind="stable")].reshape(-1, 2)
    one, other = face[pairs[:, 0]], face[pairs[:, 1]]
    agree = (forward[pairs[:, 0]] != forward[pairs[:, 1]]).astype(np.int64)
    n = len(corners)  # node k is triangle k as it is wound, node n + k is it turned over
    rows = np.concatenate([one, one + n])
    side = component_roots(rows, np.concatenate([other + n * (1 - agree), other + n * agree]), 2 * n)
    turned = side[:n] > side[n:]  # equal sides: a surface with one side only, nothing to turn
    out = corners.copy()
    out[turned] = out[turned][:, ::-1]
    return out


HullFault = Literal["finite", "solid", "flat", "closed", "volume", "convex", "outward"]
_CONVEXITY = 1e-6  # of files: single precision leaves 1e-7


@np.errstate(all="ignore")
def find_fault(shape: Shape, convexity: float = _CONVEXITY) -> HullFault | None:
    """Return what a shape lacks to be a hull, the first of several, from which the others follow; None for a hull.

    finite: coordinates and volume are finite numbers; solid: it has four vertices; flat: it spans no volume; closed:
    its surface is not; volume: it is not positive; convex: it is not; outward: some face looks inwards.
    convexity: how far a vertex may lie outside of a face's plane, relative to the size.
    """
    vertices = shape.vertices
    if not (np.isfinite(vertices).all() and np.isfinite(shape.volume)):
        return "finite"
    if len(vertices) < 4:
        return "solid"
    if not spans_volume(vertices):
        return "flat"
    is_polytope = isinstance(shape, Polytope)
    if is_polytope and shape.volume > 0 and is_convex_hull(vertices, shape.faces, convexity):
        return None  # nearly always, and its planes are made once
    if is_polytope and not is_closed(shape.faces):
        return "closed"
    if shape.volume <= 0:
        return "volume"
    if is_polytope and not is_convex(vertices, shape.faces, convexity):
        return "convex"
    return "outward" if is_polytope and not is_outward(vertices, shape.faces) else None


_WORDS: dict[HullFault, str] = {
    "finite": "has coordinates that are not finite numbers",
    "solid": "has too few vertices for a volume",
    "flat": "has no thickness",
    "closed": "is not closed",
    "volume": "has no positive volume (inside out, or empty)",
    "convex": "is not convex",
    "outward": "has faces that look inwards",
}


def describe_fault(fault: HullFault) -> str:
    """Return the fault as the end of a sentence: `is not convex`."""
    return _WORDS[fault]
