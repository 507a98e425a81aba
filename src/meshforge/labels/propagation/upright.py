"""Which way is up in a mesh: files tilt their assets, and what a part is shows in how it lies and how high it is."""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from meshforge.geometry import Floats
from meshforge.label_model import EQUAL, first_greatest, greatest_first
from meshforge.symbolic import SymbolicMesh

_ALIKE = np.cos(np.radians(4.0))  # faces of the whole that turn by less are one side of it
_MOST_SIDES = 24  # sides of the whole that it may stand on, the largest first
_SOFT = 3.0  # degrees by which a face may lean and still count as level or plumb
_PLUMB = 0.3  # worth of a plumb face beside a level one
_FAR = 40.0  # degrees from the file's own upright axis at which a direction is worth a third
_STAYS = 0.05  # how much better another direction must be than the file's own
_OTHER = np.cos(np.radians(30.0))  # directions that turn by less are one and the same way to lie


def find_up(mesh: SymbolicMesh) -> Floats:
    """The direction (3,) that points up in a mesh, whatever small turn its file gave it.

    Of the file's upright axis and the directions in which the whole could lie flat, the one in which most of the
    hulls' faces are level or plumb, those near the file's axis before others.
    """
    axis = np.array([0.0, 1.0, 0.0] if mesh.asset and mesh.asset.up == "y" else [0.0, 0.0, 1.0])
    found = np.concatenate([axis[None], _flat_sides(mesh)])
    worth = _score(mesh, found) * np.exp(-((_to_degrees(found @ axis) / _FAR) ** 2))
    worth[0] += _STAYS
    best: Floats = found[first_greatest(worth)]
    return best


def find_other_sides(mesh: SymbolicMesh, up: Floats, most: int) -> list[Floats]:
    """Up to `most` directions (3,) that point up if the mesh lies on another side than it seems to.

    Those under which most of the hulls' faces are level or plumb come first. up: what seems to be up.
    """
    sides = _flat_sides(mesh)
    found = [up]
    for place in greatest_first(_score(mesh, sides)):
        if len(found) <= most and all(sides[place] @ other < _OTHER - EQUAL for other in found):
            found.append(sides[place])
    return found[1:]


def _score(mesh: SymbolicMesh, directions: Floats) -> Floats:
    """How much of the hulls' faces is level or plumb (n,) if each of some directions (n, 3) points up."""
    normals, areas = _face_normals(mesh)
    shares = areas / (areas.sum() or 1.0)
    lean = _to_degrees(np.abs(directions @ normals.T))
    level, plumb = (np.exp(-((angle / _SOFT) ** 2)) @ shares for angle in (lean, 90.0 - lean))
    worth: Floats = level + _PLUMB * plumb
    return worth


def _to_degrees(cosines: Floats) -> Floats:
    angles: Floats = np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))
    return angles


def rotation_to_z(up: Floats) -> Floats:
    """The rotation (3, 3) by the smallest angle that takes a direction to Z."""
    cosine = float(up[2])
    if cosine < -1 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    x, y = float(up[0]), float(up[1])
    cross = np.array([[0.0, 0.0, -x], [0.0, 0.0, -y], [x, y, 0.0]])
    turn: Floats = np.eye(3) + cross + cross @ cross / (1 + cosine)
    return turn


def _flat_sides(mesh: SymbolicMesh) -> Floats:
    """Normals (k, 3) of the flat sides of the convex hull of all hulls, outward, the largest first, then inward."""
    if not mesh.hulls:
        return np.zeros((0, 3))
    points = np.concatenate([hull.vertices for hull in mesh.hulls])
    try:
        whole = ConvexHull(points - points.mean(axis=0))
    except (QhullError, ValueError):  # flat, or all in one place
        return np.zeros((0, 3))
    a, b, c = (whole.points[whole.simplices[:, k]] for k in range(3))
    areas, normals = np.linalg.norm(np.cross(b - a, c - a), axis=1), whole.equations[:, :3]
    free, found = np.ones(len(areas), dtype=bool), list[Floats]()
    while free.any() and len(found) < _MOST_SIDES:
        face = first_greatest(np.where(free, areas, -np.inf), EQUAL * areas.max())
        group = free & (normals @ normals[face] > _ALIKE)
        free &= ~group
        middle = areas[group] @ normals[group]
        found.append(middle / np.linalg.norm(middle))
    return np.array([*found, *(-side for side in found)]).reshape(-1, 3)


def _face_normals(mesh: SymbolicMesh) -> tuple[Floats, Floats]:
    """Unit normals (n, 3) and areas (n,) of all triangles of all hulls that have one."""
    corners = [hull.vertices[hull.faces] for hull in mesh.hulls]
    triangles = np.concatenate(corners) if corners else np.zeros((0, 3, 3))
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    areas = np.linalg.norm(across, axis=1)
    solid = areas > 1e-12 * areas.max(initial=0.0)
    return across[solid] / areas[solid, None], areas[solid] / 2
