"""Solids of boxes and rods, and their surfaces."""

import numpy as np
from manifold3d import Manifold

from meshforge.geometry import Floats, Ints


def block(size: tuple[float, float, float], middle: tuple[float, float, float]) -> Manifold:
    return Manifold.cube(size, True).translate(middle)


def surface(solid: Manifold) -> tuple[Floats, Ints]:
    mesh = solid.to_mesh()
    return np.asarray(mesh.vert_properties)[:, :3].astype(float), np.asarray(mesh.tri_verts).astype(np.int64)
