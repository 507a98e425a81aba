"""The pieces of mesh files that a description puts in place: convex shapes, and what is none, in the root frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.asset import Surface
from meshforge.geometry import FLATNESS, Floats, Ints, Piece, Pose, Shape, principal_extents


@dataclass(frozen=True, eq=False, slots=True)
class MeshPart:
    """A piece of collision geometry in the root frame: a shape, or None with the reason why it is no hull.

    plane: root_T_plane of an endless plane, whose normal is Z.
    """

    shape: Shape | None
    reason: str = ""
    surface: Surface | None = None
    plane: Pose | None = None


def mesh_parts(pieces: Sequence[Piece], linear: Floats, offset: Floats) -> list[MeshPart]:
    """The pieces of a mesh file under x -> linear @ x + offset, reflections included."""
    parts = [
        MeshPart(piece.shape.transform(linear, offset))
        if piece.shape is not None
        else MeshPart(None, piece.reason or "no hull", placed(piece.vertices, piece.faces, linear, offset))
        for piece in pieces
    ]
    return parts or [MeshPart(None, "the mesh holds no triangles")]


def placed(vertices: Floats, faces: Ints, linear: Floats, offset: Floats, body: str | None = None) -> Surface:
    """A surface under x -> linear @ x + offset; a reflection turns its faces round."""
    return Surface(vertices @ linear.T + offset, faces if np.linalg.det(linear) > 0 else faces[:, ::-1], body)


def is_flat(vertices: Floats) -> bool:
    """Whether points (n, 3) span no volume to speak of; MuJoCo refuses a mesh of such points."""
    extents = principal_extents(vertices)[2]
    return bool(extents.min() <= FLATNESS * extents.max())


def facing(normal: Floats) -> Pose:
    """The least turn that takes Z onto a direction (3,)."""
    length = float(np.linalg.norm(normal))
    x, y, z = normal / length if length > 0 else np.array([0.0, 0.0, 1.0])
    if z < -1 + 1e-12:
        return Pose(np.diag([1.0, -1.0, -1.0]), np.zeros(3))
    cross = np.array([[0, 0, x], [0, 0, y], [-x, -y, 0]])
    return Pose(np.eye(3) + cross + cross @ cross / (1 + z), np.zeros(3))
