"""Planar holes of a surface closed by caps, as engines want it: an open mesh they first rebuild of voxels, roughly."""

from __future__ import annotations

from typing import Any

import manifold3d
import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.decompose.surface import Triangles, sound_triangles
from meshforge.geometry.shapes.polytope import volume_and_centroid
from meshforge.geometry.surface import is_closed

_LEVEL = 1e-3  # a hole is planar when it is level within this share of the mesh's diagonal


def capped(mesh: Triangles) -> tuple[Triangles, int]:
    """The mesh with caps on its holes, and how many these were; 0 where caps on planar holes alone do not close it."""
    loops = _loops(mesh.faces) if mesh.open_edges else []
    level = _LEVEL * mesh.diagonal
    groups = _by_plane([mesh.vertices[loop] for loop in loops], level)
    if loops and groups:
        caps = [_cap(mesh.vertices, [loops[k] for k in group]) for group in groups]
        faces = np.concatenate([mesh.faces, *caps])
        if is_closed(faces):
            return Triangles(mesh.vertices, faces, 0), len(loops)
    return mesh, 0


def enclosed_volume(vertices: Any, faces: Any) -> float | None:
    """The volume [m^3] inside of triangles with their planar holes closed, None where they are open all the same."""
    try:
        mesh, _ = capped(sound_triangles(vertices, faces))
    except GeometryError:
        return None
    volume = abs(volume_and_centroid(mesh.vertices, mesh.faces)[0])
    return volume if volume > 0 and not mesh.open_edges else None


def _loops(faces: Ints) -> list[Ints]:
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


def _by_plane(loops: list[Floats], level: float) -> list[list[int]]:
    """Loops (n, 3) that lie in one plane together, by their indices; none at all where one is not planar."""
    groups: list[list[int]] = []
    for k, loop in enumerate(loops):
        if not _is_level(loop, level):
            return []
        home = next((g for g in groups if _is_level(np.concatenate([loop, *(loops[j] for j in g)]), level)), None)
        if home is None:
            groups.append(home := [])
        home.append(k)
    return groups


def _is_level(points: Floats, level: float) -> bool:
    center, axes = _plane(points)
    return bool(np.abs((points - center) @ axes[2]).max() <= level)


def _plane(points: Floats) -> tuple[Floats, Floats]:
    """The middle (3,) of points and their principal axes as the rows of a rotation, the last across their plane."""
    center = points.mean(axis=0)
    axes = np.linalg.eigh((points - center).T @ (points - center))[1].T[::-1]
    return center, axes * np.sign(np.linalg.det(axes))


def _cap(vertices: Floats, loops: list[Ints]) -> Ints:
    """The triangles (m, 3) between loops of one plane."""
    rim = np.concatenate(loops)
    center, axes = _plane(vertices[rim])
    outlines = [(vertices[loop] - center) @ axes[:2].T for loop in loops]
    if sum(map(_signed_area, outlines)) < 0:  # seen from behind: mirrored, they run as the library wants them
        outlines = [outline * [1.0, -1.0] for outline in outlines]
    return rim[np.asarray(manifold3d.triangulate(outlines), dtype=np.int64).reshape(-1, 3)]


def _signed_area(outline: Floats) -> float:
    x, y = outline.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
