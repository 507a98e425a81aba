"""A compiled geom as a convex shape in the root frame, or the reason why it is none."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from meshforge.asset import Surface
from meshforge.errors import GeometryError
from meshforge.formats.mesh_parts import MeshPart
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Pose, Shape, Sphere, convex_hull

if TYPE_CHECKING:
    import mujoco


def part_of(model: mujoco.MjModel, geom: int, pose: Pose) -> MeshPart:
    """The shape of a geom; pose: root_T_geom. Of a mesh it is the convex hull, with which MuJoCo collides."""
    import mujoco

    size = model.geom_size[geom].astype(np.float64)
    kind = mujoco.mjtGeom(int(model.geom_type[geom]))
    match kind:
        case mujoco.mjtGeom.mjGEOM_BOX:
            shape: Shape = Box(pose, size)
        case mujoco.mjtGeom.mjGEOM_SPHERE:
            shape = Sphere(pose, float(size[0]))
        case mujoco.mjtGeom.mjGEOM_CAPSULE:
            shape = Capsule(pose, float(size[0]), float(size[1]))
        case mujoco.mjtGeom.mjGEOM_CYLINDER:
            shape = Cylinder(pose, float(size[0]), float(size[1]))
        case mujoco.mjtGeom.mjGEOM_ELLIPSOID:
            shape = Ellipsoid(pose, size)
        case mujoco.mjtGeom.mjGEOM_MESH:
            return _mesh(model, int(model.geom_dataid[geom]), pose)
        case mujoco.mjtGeom.mjGEOM_PLANE:
            return MeshPart(None, "a plane has no end")
        case mujoco.mjtGeom.mjGEOM_HFIELD:
            return MeshPart(None, "a height field is no convex hull")
        case mujoco.mjtGeom.mjGEOM_SDF:
            return MeshPart(None, "a signed distance field is no convex hull", mesh_surface(model, geom, pose))
        case _:
            return MeshPart(None, f"{kind.name} is no geometry that is known")
    return MeshPart(shape)


def _mesh(model: mujoco.MjModel, mesh: int, pose: Pose) -> MeshPart:
    start, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    vertices = model.mesh_vert[start : start + count].astype(np.float64)
    if model.mesh_graphadr[mesh] >= 0:
        graph = model.mesh_graph[int(model.mesh_graphadr[mesh]) :]
        corners = int(graph[0])
        vertices = vertices[graph[2 + corners : 2 + 2 * corners]]
    points = pose.apply(vertices)
    try:
        return MeshPart(convex_hull(points))
    except GeometryError as error:
        return MeshPart(None, error.problem)


def mesh_surface(model: mujoco.MjModel, geom: int, pose: Pose) -> Surface | None:
    """The triangles of a geom's mesh in the root frame, None where it has none."""
    mesh = int(model.geom_dataid[geom])
    if mesh < 0:
        return None
    start, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    first, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
    vertices = model.mesh_vert[start : start + count].astype(np.float64)
    return Surface(pose.apply(vertices), model.mesh_face[first : first + faces].astype(np.int64))
