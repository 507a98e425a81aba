"""The convex hull of any points, made by manifold3d or Qhull and verified afterwards."""

from collections.abc import Callable
from math import sqrt
from typing import Any

import manifold3d
import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints, cross
from meshforge.geometry.shape import Polytope
from meshforge.geometry.surface import is_convex_hull, lowest_altitudes, rises_above

FLATNESS = 1e-4
"""Degenerate input is thickened to this share of the reference diagonal."""
_RANK = 1e-6  # extents below this share of the largest count as none: single precision leaves 1e-7 of noise
_CONVEXITY = 1e-8  # verified in coordinates where the hull is one long, wide and high
_CLEAR = 1e-9  # a determinant by the trace, cubed, that is far above rounding
_MOST_INCIDENCES = 100_000  # vertices times faces of which a table is made
_ROWS, _COLUMNS = np.triu_indices(3)  # of the entries of a symmetric matrix
_SLIVERS = (1e-7, 1e-6, 1e-5, 1e-4)  # altitudes of triangles given up in turn; the first is manifold's own precision
_FARTHEST, _SMALLEST = 1e50, 1e-100  # [m] beyond, volumes are no floating point numbers any more

HullIndices = tuple[Ints, Ints]
"""Indices of the points that are vertices of their hull, and triangles (m, 3) of these vertices."""
_ROUNDS = 40


def convex_hull(points: Floats, *, name: str = "points", thicken: float | None = None) -> Polytope:
    """Return the convex hull of points (n, 3); its vertices are some of them, bit for bit.

    Every point is inside to 1e-6 of the hull's length, width and height, mostly to 1e-7; to 1e-3 at worst, where
    rounded, nearly coplanar or collinear points leave no other hull that is convex.
    thicken: the thickness [m] given to points that span no volume; None refuses them.
    Raises GeometryError naming `name`: no points, a coordinate that is not finite, no extent, or no convex result.
    """
    points = np.asarray(points, dtype=np.float64).reshape(-1, 3)
    if len(points) == 0:
        raise GeometryError("a convex hull needs points, there are none", where=name)
    if not (np.abs(points) < _FARTHEST).all():
        raise GeometryError("a coordinate is not a finite number", where=name, remedy="Fix the file's vertices.")
    if not _is_surely_thick(points, thicken or 0.0):
        points = _thicken(points, name, thicken or 0.0)
    made = _make_verified_hull(points, name)
    while len(made.vertices) < len(points):  # until nothing more goes: the hull of a hull is that hull
        points, made = made.vertices, _make_verified_hull(made.vertices, name)
    return made


def _thicken(points: Floats, name: str, thickness: float) -> Floats:
    """Points (n, 3), those that span no volume doubled along the axes that they lack."""
    center, axes, extents = principal_extents(points)
    flat = extents <= max(_least_extent(points, extents), thickness * 0.5)
    if flat.any() and not thickness:
        problem = f"its points span no volume (extents {', '.join(f'{e:.3g}' for e in extents)} m)"
        raise GeometryError(problem, where=name, remedy="Give the piece a thickness, or delete it.")
    for axis in axes[flat]:
        level, rise = points - np.outer((points - center) @ axis, axis), axis * (thickness / 2)
        points = np.concatenate([level - rise, level + rise])
    return points


def _is_surely_thick(points: Floats, thickness: float) -> bool:
    """Whether points (n, 3) are so far from flat, and from half a thickness [m], that no extent need be measured.

    Along any axis points reach as far as the root of their mean square, or farther.
    """
    sides = np.ptp(points, axis=0)
    around = (points - points.mean(axis=0)) / max(float(sides.max()), _SMALLEST)
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = (around.T @ around).tolist()
    eigenvalue = _bound_eigenvalue(xx, xy, xz, yy, yz, zz)
    if not eigenvalue > 0.0:
        return False
    least = sqrt(eigenvalue / len(points)) * float(sides.max())
    extents = np.array([least, 2 * float(sides.max())])
    return 0.5 * least > max(_least_extent(points, extents), 0.5 * thickness)


def _bound_eigenvalue(xx: Any, xy: Any, xz: Any, yy: Any, yz: Any, zz: Any) -> Any:
    """What the eigenvalues of symmetric matrices are no smaller than, by numbers or arrays of their entries.

    -inf where the determinant is within rounding of zero: of three eigenvalues that are not negative, the two larger
    ones multiply to no more than the square of half the trace.
    """
    trace = xx + yy + zz
    determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    bound = 4 * determinant / np.maximum(trace * trace, np.finfo(float).tiny)
    return np.where(determinant > _CLEAR * trace**3, bound, -np.inf)


def spans_volume(points: Floats) -> bool:
    """Return whether points (n, 3) span a volume: `convex_hull` takes them without thickening."""
    if _is_surely_thick(points, 0.0):
        return True
    extents = principal_extents(points)[2]
    return bool((extents > _least_extent(points, extents)).all())


def principal_extents(points: Floats) -> tuple[Floats, Floats, Floats]:
    """Return middle (3,), principal axes as rows of a rotation (3, 3), and the extent along each (3,), widest first."""
    center = points.mean(axis=0)
    _, _, axes = np.linalg.svd(np.linalg.qr(points - center, mode="r"), full_matrices=True)
    axes = axes * np.sign(np.linalg.det(axes))
    return center, axes, np.ptp((points - center) @ axes.T, axis=0)


def measure_extents(points: Floats) -> Floats:
    """Return the sides (3,) of a small box around points (n, 3), longest first [m].

    Of the boxes that are square to a principal axis, the smallest: where extents along other principal axes are alike,
    these axes are chance, and the box is turned about the first as it fits best.
    """
    middle, axes, _ = principal_extents(points)
    local = (points - middle) @ axes.T
    found = [_measure_box(local, k) for k in range(3)]
    return np.sort(min(found, key=lambda sides: float(np.prod(sides))))[::-1]


def _measure_box(local: Floats, axis: int) -> Floats:
    """The sides (3,) of the smallest box that is square to one axis: it lies along an edge of the outline."""
    from scipy.spatial import ConvexHull, QhullError  # lazy: 0.3 s, only checks need it

    flat = np.delete(local, axis, axis=1)
    size = np.maximum(np.ptp(flat, axis=0), np.finfo(float).tiny)
    try:
        ring = flat[ConvexHull(flat / size).vertices]
    except QhullError:  # no outline: the points span no volume
        return np.asarray(np.ptp(local, axis=0))
    edges = np.roll(ring, -1, axis=0) - ring
    along = edges / np.maximum(np.linalg.norm(edges, axis=1, keepdims=True), np.finfo(float).tiny)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    sides = np.stack([np.ptp(ring @ along.T, axis=0), np.ptp(ring @ across.T, axis=0)], axis=1)
    return np.array([float(np.ptp(local[:, axis])), *sides[sides.prod(axis=1).argmin()]])


def _least_extent(points: Floats, extents: Floats) -> float:
    """Extents of the points that are no larger count as none [m]."""
    return max(_RANK * float(extents.max()), 8 * np.finfo(float).eps * float(np.abs(points).max()), _SMALLEST)


def _make_verified_hull(points: Floats, name: str) -> Polytope:
    """The hull of points (n, 3), made and verified on their affine image that is one long, wide and high.

    Hulls are affinely invariant; in the image a thin plate or a needle is as well conditioned as a cube.
    """
    unit = _normalize(points)
    for attempt in (hull_by_manifold, hull_by_qhull):
        for altitude in _SLIVERS:
            made = prune_vertices(unit, attempt, altitude)
            if made is None or not is_convex_hull(unit[made[0]], made[1], _CONVEXITY):
                continue
            left = np.delete(unit, made[0], axis=0)
            if not (len(left) and rises_above(left, unit[made[0]], made[1], max(10 * altitude, 1e-6))):
                return Polytope(points[made[0]], made[1])
    raise GeometryError("no convex hull of its points could be made", where=name)


def _normalize(points: Floats) -> Floats:
    """Points (n, 3) that span a volume, in an affine image in which none of their directions is much shorter.

    By Gram-Schmidt, twice, without linear algebra: that rounds otherwise on another processor, and which way a level
    face is cut into triangles, and in which order vertices come, hangs by the last digit here.
    """
    columns = list[Floats]()
    for column in np.ascontiguousarray((points - points.mean(axis=0)).T):
        for other in (*columns, *columns):
            column = column - other * (column * other).sum()
        columns.append(column / np.sqrt((column * column).sum()))
    unit = np.stack(columns, axis=1)
    evened: Floats = unit / np.ptp(unit, axis=0)
    return evened


def prune_vertices(
    unit: Floats, attempt: Callable[[Floats], HullIndices | None], altitude: float
) -> HullIndices | None:
    """Return the hull without vertices within `altitude` of an edge between two others, or inside a face."""
    kept = np.arange(len(unit))
    for _ in range(_ROUNDS):
        made = attempt(unit[kept])
        if made is None:
            return None
        vertices, faces = kept[made[0]], made[1]
        spare = _find_spare(unit[vertices], faces, altitude) or _find_flat_vertices(unit[vertices], faces, altitude)
        if len(spare) == 0:
            return vertices, faces
        kept = np.delete(vertices, spare)
    return None


def _find_flat_vertices(vertices: Floats, faces: Ints, angle: float) -> list[int]:
    """Vertices whose faces lie in one plane or two, to `angle` [rad]: no corners, they can all go at once."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    if len(vertices) * len(faces) <= _MOST_INCIDENCES:
        at_vertex = np.zeros((len(vertices), len(faces)))
        at_vertex[faces, np.arange(len(faces))[:, None]] = 1.0
        entries = at_vertex @ (normals[:, _ROWS] * normals[:, _COLUMNS])
        if (_bound_eigenvalue(*entries.T) > angle * angle).all():
            return []
    spread = np.zeros((len(vertices), 3, 3))
    np.add.at(spread, faces.ravel(), np.repeat(normals[:, :, None] * normals[:, None, :], 3, axis=0))
    return [int(k) for k in np.flatnonzero(np.linalg.eigvalsh(spread)[:, 0] < angle * angle)]


def _find_spare(vertices: Floats, faces: Ints, altitude: float) -> list[int]:
    """Vertices that can go at once, each next to an edge whose ends stay."""
    heights, apex = lowest_altitudes(vertices, faces)
    spare: list[int] = []
    staying: set[int] = set()
    low = np.flatnonzero(heights < altitude)
    for k in low[np.argsort(heights[low], kind="stable")] if len(low) else ():
        corner = int(faces[k, apex[k]])
        ends = {int(faces[k, (apex[k] + 1) % 3]), int(faces[k, (apex[k] + 2) % 3])}
        if corner not in staying and corner not in spare and ends.isdisjoint(spare):
            spare.append(corner)
            staying |= ends
    return spare


def hull_by_manifold(points: Floats) -> HullIndices | None:
    """Return the hull by manifold3d; it leaves out points within 1e-7 of it. None where it finds none."""
    points = points + 0.0  # no negative zeros: vertices are found again by their bytes
    mesh = manifold3d.Manifold.hull_points(points).to_mesh64()
    faces = np.asarray(mesh.tri_verts, dtype=np.int64)
    if len(faces) < 4:
        return None
    index = dict(zip(_bytes_of_rows(points)[::-1], range(len(points) - 1, -1, -1), strict=True))
    vertices = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3] + 0.0
    return np.array([index[row] for row in _bytes_of_rows(vertices)]), faces


def measure_hull(points: Floats) -> float:
    """Return the volume [m^3] of the hull of points (n, 3), to what manifold3d leaves out: fast, and not verified."""
    return float(manifold3d.Manifold.hull_points(points - points.mean(axis=0)).volume())


def _bytes_of_rows(points: Floats) -> list[bytes]:
    return np.ascontiguousarray(points).view("V24").ravel().tolist()


def hull_by_qhull(points: Floats) -> HullIndices | None:
    """Return the hull by Qhull; None where it finds none."""
    from scipy.spatial import ConvexHull, QhullError  # lazy: half of the import time of geometry, hardly ever needed

    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        return None
    used, faces = np.unique(hull.simplices, return_inverse=True)
    vertices, faces = points[used], faces.reshape(-1, 3).copy()
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - vertices.mean(axis=0)) < 0
    faces[inward] = faces[inward][:, ::-1]
    return used.astype(np.int64), faces
