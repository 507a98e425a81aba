"""The triangles given to a decomposition: checked, welded, their planar holes closed by caps.

Engines first rebuild an open mesh from voxels, roughly; a closed one they take as it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import manifold3d
import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints, freeze_floats, freeze_ints
from meshforge.geometry.shape import volume_and_centroid
from meshforge.geometry.surface import is_closed

_FLAT = 1e-7  # an extent below this share of the largest spans no volume

_LEVEL = 1e-3  # a hole is planar when it is level within this share of the mesh's diagonal


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
    """The triangles with equal vertices welded and collapsed triangles dropped.

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
    _refuse_flat(welded, bool(kept.any()))
    return TriangleMesh(welded, welded_faces[kept].astype(np.int64), _count_open_edges(welded_faces[kept]))


def _refuse_flat(points: Floats, any_triangle: bool) -> None:
    extents = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if not any_triangle or len(extents) < 3 or extents[2] <= _FLAT * extents[0]:
        raise GeometryError(
            "the mesh is flat: it spans no volume",
            remedy="Give it a thickness; for a single flat piece, a convex hull with a thickness is enough.",
        )


def _count_open_edges(faces: Ints) -> int:
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, uses = np.unique(edges, axis=0, return_counts=True)
    return int((uses == 1).sum())


def cap_holes(mesh: TriangleMesh) -> tuple[TriangleMesh, int]:
    """The mesh with caps on its holes, and how many these were; 0 where caps on planar holes alone do not close it."""
    loops = _find_loops(mesh.faces) if mesh.open_edges else []
    level = _LEVEL * mesh.diagonal
    groups = _group_by_plane([mesh.vertices[loop] for loop in loops], level)
    if loops and groups:
        caps = [_make_cap(mesh.vertices, [loops[k] for k in group]) for group in groups]
        faces = np.concatenate([mesh.faces, *caps])
        if is_closed(faces):
            return TriangleMesh(mesh.vertices, faces, 0), len(loops)
    return mesh, 0


def volume_inside(vertices: Any, faces: Any) -> float | None:
    """The volume [m^3] inside of triangles with their planar holes closed, None where they are open all the same."""
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
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    count = int(faces.max()) + 1
    rim = ~np.isin(start * count + end, end * count + start)
    follows = dict(zip(end[rim].tolist(), start[rim].tolist(), strict=True))
    if len(follows) < rim.sum():
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


def _group_by_plane(loops: list[Floats], level: float) -> list[list[int]]:
    """Loops (n, 3) that lie in one plane together, by their indices; none at all where one is not planar."""
    groups: list[list[int]] = []
    for k, loop in enumerate(loops):
        if not _is_planar(loop, level):
            return []
        home = next((g for g in groups if _is_planar(np.concatenate([loop, *(loops[j] for j in g)]), level)), None)
        if home is None:
            groups.append(home := [])
        home.append(k)
    return groups


def _is_planar(points: Floats, level: float) -> bool:
    center, axes = _plane_of(points)
    return bool(np.abs((points - center) @ axes[2]).max() <= level)


def _plane_of(points: Floats) -> tuple[Floats, Floats]:
    """The middle (3,) of points and their principal axes as the rows of a rotation, the last across their plane."""
    center = points.mean(axis=0)
    axes = np.linalg.eigh((points - center).T @ (points - center))[1].T[::-1]
    return center, axes * np.sign(np.linalg.det(axes))


def _make_cap(vertices: Floats, loops: list[Ints]) -> Ints:
    """The triangles (m, 3) between loops of one plane."""
    rim = np.concatenate(loops)
    center, axes = _plane_of(vertices[rim])
    outlines = [(vertices[loop] - center) @ axes[:2].T for loop in loops]
    if sum(map(_area_with_sign, outlines)) < 0:  # seen from behind: mirrored, they run as the library wants them
        outlines = [outline * [1.0, -1.0] for outline in outlines]
    return rim[np.asarray(manifold3d.triangulate(outlines), dtype=np.int64).reshape(-1, 3)]


def _area_with_sign(outline: Floats) -> float:
    x, y = outline.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
