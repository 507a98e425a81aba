"""The triangles given to a decomposition: checked, welded, their planar holes closed by caps, flat ones made thick.

Engines first rebuild an open mesh from voxels, roughly; a closed one they take as it is. They refuse flat surfaces:
these are decomposed as thick sheets, of which a slice is taken.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import manifold3d
import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Aabb, Floats, Ints, freeze_floats, freeze_ints
from meshforge.geometry.connectivity import edges_of
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents, spans_volume
from meshforge.geometry.shape import Box, Polytope, volume_and_centroid
from meshforge.geometry.solidity import judge_solidity, refuse_dents
from meshforge.geometry.solids import intersect
from meshforge.geometry.surface import is_closed

ROUGH_RIM = 0.3
"""Of the size of a hole between two parts: how uneven its rim may be, along triangles or around a curve."""
_FLAT = 1e-7  # an extent below this share of the largest spans no volume
_LEVEL = 1e-3  # a hole is planar when it is level within this share of the mesh's diagonal
_THICK = 0.1  # of the length: thick enough for voxels and cuts, thin enough to count as a sheet
_SLICE = 0.1, 0.2  # of the thickness, out of the middle, where engines like to cut

DecomposeSolid = Callable[[Floats, Ints], list[Polytope]]


@dataclass(frozen=True, eq=False, slots=True)
class TriangleMesh:
    """Welded triangles of some extent; vertices (n, 3) [m], faces (m, 3); open_edges: those of one triangle only."""

    vertices: Floats
    faces: Ints
    open_edges: int

    @property
    def diagonal(self) -> float:
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))


def clean_triangles(vertices: Any, faces: Any) -> TriangleMesh:
    """Return the triangles with equal vertices welded and collapsed triangles dropped.

    Raises GeometryError: nothing to decompose, a coordinate that is not finite, an index out of range, a flat mesh.
    """
    points, triangles = freeze_floats(vertices, (-1, 3)), freeze_ints(faces, (-1, 3))
    if len(triangles) == 0:
        raise GeometryError("there are no triangles to decompose")
    if triangles.min() < 0 or triangles.max() >= len(points):
        raise GeometryError(f"a triangle refers to a vertex that is not there (there are {len(points)})")
    if not np.isfinite(points[triangles]).all():
        raise GeometryError("a coordinate is not a finite number", remedy="Fix the file's vertices.")
    welded, index = np.unique(points[triangles].reshape(-1, 3) + 0.0, axis=0, return_inverse=True)
    welded_faces = index.reshape(-1, 3)
    kept = np.diff(np.sort(welded_faces, axis=1), axis=1).min(axis=1) > 0
    extents = np.linalg.svd(welded - welded.mean(axis=0), compute_uv=False)
    if not kept.any() or len(extents) < 3 or extents[2] <= _FLAT * extents[0]:
        remedy = "Give it a thickness; for a single flat piece, a convex hull with a thickness is enough."
        raise GeometryError("the mesh is flat: it spans no volume", remedy=remedy)
    _, uses = np.unique(edges_of(welded_faces[kept])[0], axis=0, return_counts=True)
    return TriangleMesh(welded, welded_faces[kept].astype(np.int64), int((uses == 1).sum()))


def cap_holes(mesh: TriangleMesh, rough: float = 0.0) -> tuple[TriangleMesh, int]:
    """Return the mesh with caps on its holes, and how many these were; 0 where planar caps do not close it.

    rough: of the size of a hole, how far from a plane its rim may be to count as planar. Where flat caps do not close
    the mesh, as an edge of one may be there already, holes are closed by fans around the middles of their rims.
    """
    loops = _find_loops(mesh.faces) if mesh.open_edges else []
    groups = _group_by_plane([mesh.vertices[loop] for loop in loops], _LEVEL * mesh.diagonal, rough)
    if not loops or not groups:
        return mesh, 0
    faces = np.concatenate([mesh.faces, *[_make_cap(mesh.vertices, [loops[k] for k in group]) for group in groups]])
    if is_closed(faces):
        return TriangleMesh(mesh.vertices, faces, 0), len(loops)
    if rough > 0:
        middles = [mesh.vertices[loop].mean(axis=0) for loop in loops]
        tips = [np.full(len(loop), len(mesh.vertices) + k) for k, loop in enumerate(loops)]
        fans = [np.column_stack([loop, np.roll(loop, -1), tip]) for loop, tip in zip(loops, tips, strict=True)]
        faces = np.concatenate([mesh.faces, *fans])
        if is_closed(faces):
            return TriangleMesh(np.concatenate([mesh.vertices, middles]), faces, 0), len(loops)
    return mesh, 0


def volume_inside(vertices: Any, faces: Any) -> float | None:
    """Return the volume [m^3] inside of triangles with their planar holes closed, None where they stay open."""
    try:
        mesh, _ = cap_holes(clean_triangles(vertices, faces))
    except GeometryError:
        return None
    volume = abs(volume_and_centroid(mesh.vertices, mesh.faces)[0])
    return volume if volume > 0 and not mesh.open_edges else None


def _find_loops(faces: Ints) -> list[Ints]:
    """The rims that faces (m, 3) leave open, each as its vertices in the order in which a cap runs along them.

    None at all where a rim branches.
    """
    start, end = _find_rim(faces)
    follows = dict(zip(end.tolist(), start.tolist(), strict=True))
    if len(follows) < len(end):
        return []
    loops = []
    while follows:
        loop = [next(iter(follows))]
        while loop[-1] in follows:
            loop.append(follows.pop(loop[-1]))
        if loop[-1] != loop[0]:
            return []
        loops.append(np.array(loop[1:]))
    return loops


def _find_rim(faces: Ints) -> tuple[Ints, Ints]:
    """Where the edges start (k,) and end (k,) that no triangle runs along in the other sense."""
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    count = int(faces.max()) + 1
    rim = ~np.isin(start * count + end, end * count + start)
    return start[rim], end[rim]


def _group_by_plane(loops: list[Floats], level: float, rough: float) -> list[list[int]]:
    """Loops (n, 3) that lie in one plane together, by their indices; none at all where one is not planar."""
    groups: list[list[int]] = []
    for k, loop in enumerate(loops):
        if not _is_planar(loop, level, rough):
            return []
        joint = (np.concatenate([loop, *(loops[j] for j in group)]) for group in groups)
        home = next((g for g, points in zip(groups, joint, strict=False) if _is_planar(points, level, rough)), None)
        if home is None:
            groups.append(home := [])
        home.append(k)
    return groups


def _is_planar(points: Floats, level: float, rough: float) -> bool:
    center, axes = _plane_of(points)
    local = (points - center) @ axes.T
    return bool(np.abs(local[:, 2]).max() <= max(level, rough * float(np.ptp(local[:, 0]))))


def _plane_of(points: Floats) -> tuple[Floats, Floats]:
    """The middle (3,) of points and their principal axes as the rows of a rotation, the last across their plane."""
    center = points.mean(axis=0)
    axes = np.linalg.eigh((points - center).T @ (points - center))[1].T[::-1]
    return center, axes * np.sign(np.linalg.det(axes))


def _make_cap(vertices: Floats, loops: list[Ints]) -> Ints:
    rim = np.concatenate(loops)
    center, axes = _plane_of(vertices[rim])
    outlines = [(vertices[loop] - center) @ axes[:2].T for loop in loops]
    areas = [x @ np.roll(y, -1) - y @ np.roll(x, -1) for x, y in (outline.T for outline in outlines)]
    if sum(areas) < 0:  # seen from behind: mirrored, they run as the library wants them
        outlines = [outline * [1.0, -1.0] for outline in outlines]
    return rim[np.asarray(manifold3d.triangulate(outlines), dtype=np.int64).reshape(-1, 3)]


def is_sheet(vertices: Any) -> bool:
    """Return whether points (n, 3) lie in a plane."""
    return not spans_volume(freeze_floats(vertices, (-1, 3)))


def is_line(vertices: Any) -> bool:
    """Return whether points (n, 3) lie on a line, so that there are no hulls of what they span."""
    points = freeze_floats(vertices, (-1, 3))
    return not spans_volume(points) and _is_narrow(principal_extents(points)[2])


def sheet_hulls(vertices: Any, faces: Any, decompose: DecomposeSolid, name: str) -> list[Polytope]:
    """Return the thin hulls of a flat surface of vertices (n, 3) [m] and faces (m, 3), 1e-4 of its length thick.

    decompose: what makes hulls of a solid one. Raises GeometryError naming `name` where the surface has no area.
    """
    points, triangles = freeze_floats(vertices, (-1, 3)), freeze_ints(faces, (-1, 3))
    used, local = np.unique(triangles, return_inverse=True)
    points, triangles = points[used], local.reshape(-1, 3)
    center, axes, extents = principal_extents(points)
    thin = FLATNESS * float(extents[0])
    if _is_narrow(extents):
        raise GeometryError("it is a line: it has no area", where=name, remedy="Delete it.")
    whole = convex_hull(points, name=name, thicken=thin)
    flat = (points - center) @ axes.T * [1, 1, 0]  # in its own frame, since engines cut along the coordinate axes
    rise = _THICK * float(extents[0])
    solid = _thicken(flat, triangles, rise)
    if refuse_dents(judge_solidity(*solid), *solid).shape:
        return [whole]
    slices = (_slice(hull, rise) for hull in decompose(*solid))
    hulls = [convex_hull(s @ axes + center, name=name, thicken=thin) for s in slices if s is not None]
    return hulls or [whole]


def _is_narrow(extents: Floats) -> bool:
    return bool(extents[1] <= FLATNESS * extents[0])


def _slice(hull: Polytope, rise: float) -> Floats | None:
    """The outline (n, 3) of a hull between two levels, pressed flat; None where it does not reach there."""
    low, high = hull.aabb.min.copy(), hull.aabb.max.copy()
    low[2], high[2] = np.multiply(_SLICE, rise)
    part = intersect(hull, Box.of_bounds(Aabb(low, high)))
    return part.vertices * [1, 1, 0] if part else None


def _thicken(flat: Floats, triangles: Ints, rise: float) -> tuple[Floats, Ints]:
    """The closed surface of triangles (m, 3) in the plane z = 0 that reach half of `rise` up and down."""
    corners = flat[triangles]
    down = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] < 0
    up = np.where(down[:, None], triangles[:, ::-1], triangles)
    up = up[np.unique(np.sort(up, axis=1), axis=0, return_index=True)[1]]
    n = len(flat)
    a, b = _find_rim(up)
    walls = np.concatenate([np.column_stack([b, a, a + n]), np.column_stack([b, a + n, b + n])])
    half = np.array([0, 0, rise / 2])
    return np.concatenate([flat + half, flat - half]), np.concatenate([up, up[:, ::-1] + n, walls])
