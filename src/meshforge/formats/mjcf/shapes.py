"""Where the bodies and geoms of a compiled model are, and each geom as a convex shape or the reason why it is none."""

from __future__ import annotations

import numpy as np

from meshforge import geometry
from meshforge.common import GeometryError
from meshforge.formats.collision_pieces import CollisionPiece
from meshforge.formats.libraries import mujoco
from meshforge.symbolic import Surface


class MjcfShapes:
    """The shapes of one model; the hull of a mesh that several geoms share is made once."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model = model
        self._hulls: dict[int, tuple[geometry.Polytope, float | None] | str] = {}

    def part_of(self, geom: int, pose: geometry.Pose) -> CollisionPiece:
        """The shape of a geom; pose: root_T_geom. Of a mesh it is the convex hull, with which MuJoCo collides."""
        kinds = mujoco.mjtGeom
        kind = kinds(int(self.model.geom_type[geom]))
        data = int(self.model.geom_dataid[geom])
        match kind:
            case kinds.mjGEOM_MESH:
                return self._mesh_part(data, pose)
            case kinds.mjGEOM_PLANE:
                return CollisionPiece(None, "a plane has no end")
            case kinds.mjGEOM_HFIELD:
                return CollisionPiece(None, "a height field is no convex hull", field_surface(self.model, data, pose))
            case kinds.mjGEOM_SDF:
                surface = mesh_surface(self.model, data, pose) if data >= 0 else None
                return CollisionPiece(None, "a signed distance field is no convex hull", surface)
        shape = self.primitive_of(geom, pose)
        return CollisionPiece(shape) if shape else CollisionPiece(None, f"{kind.name} is no geometry that is known")

    def primitive_of(self, geom: int, pose: geometry.Pose) -> geometry.Shape | None:
        """The shape of a geom that is no mesh; MuJoCo's sizes are half sizes."""
        kinds = mujoco.mjtGeom
        size = self.model.geom_size[geom].astype(np.float64)
        match kinds(int(self.model.geom_type[geom])):
            case kinds.mjGEOM_BOX:
                return geometry.Box(pose, size)
            case kinds.mjGEOM_SPHERE:
                return geometry.Sphere(pose, float(size[0]))
            case kinds.mjGEOM_CAPSULE:
                return geometry.Capsule(pose, float(size[0]), float(size[1]))
            case kinds.mjGEOM_CYLINDER:
                return geometry.Cylinder(pose, float(size[0]), float(size[1]))
            case kinds.mjGEOM_ELLIPSOID:
                return geometry.Ellipsoid(pose, size)
        return None

    def _mesh_part(self, mesh: int, pose: geometry.Pose) -> CollisionPiece:
        if mesh not in self._hulls:
            try:
                own = mesh_surface(self.model, mesh, geometry.Pose.identity())
                self._hulls[mesh] = geometry.hull_mesh(own.vertices, own.faces, _hull_vertices(self.model, mesh))
            except GeometryError as error:
                self._hulls[mesh] = error.problem
        made = self._hulls[mesh]
        if isinstance(made, str):
            return CollisionPiece(None, made, mesh_surface(self.model, mesh, pose))
        return CollisionPiece(made[0].move(pose), fill=made[1])


def _hull_vertices(model: mujoco.MjModel, mesh: int) -> geometry.Floats:
    """The vertices of MuJoCo's own hull of a mesh, fewer where `maxhullvert` says so; else all vertices."""
    vertices = _mesh_vertices(model, mesh)
    start = int(model.mesh_graphadr[mesh])
    if start < 0:
        return vertices
    count = int(model.mesh_graph[start])
    first = start + 2 + count  # after the numbers of vertices and faces, and each vertex's place among the edges
    corners: geometry.Floats = vertices[model.mesh_graph[first : first + count]]
    return corners


def mesh_surface(model: mujoco.MjModel, mesh: int, pose: geometry.Pose) -> Surface:
    """The triangles of a mesh in the root frame; pose: root_T_geom."""
    first, count = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
    faces = model.mesh_face[first : first + count].astype(np.int64)
    return Surface(pose.apply(_mesh_vertices(model, mesh)), faces)


def _mesh_vertices(model: mujoco.MjModel, mesh: int) -> geometry.Floats:
    first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    vertices: geometry.Floats = model.mesh_vert[first : first + count].astype(np.float64)
    return vertices


def field_surface(model: mujoco.MjModel, field: int, pose: geometry.Pose) -> Surface:
    """The upper side of a height field in the root frame."""
    rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
    start = int(model.hfield_adr[field])
    x, y, z, _ = model.hfield_size[field].astype(np.float64)
    heights = model.hfield_data[start : start + rows * columns].astype(np.float64) * z
    ys, xs = np.meshgrid(np.linspace(-y, y, rows), np.linspace(-x, x, columns), indexing="ij")
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    faces = np.concatenate(
        [
            np.stack([corner, corner + 1, corner + columns], axis=1),
            np.stack([corner + 1, corner + columns + 1, corner + columns], axis=1),
        ]
    )
    return Surface(pose.apply(np.stack([xs.ravel(), ys.ravel(), heights], axis=1)), faces)


def body_poses(model: mujoco.MjModel) -> list[geometry.Pose]:
    """root_T_body of all bodies. In the reference configuration no joint displaces anything, so poses only chain."""
    poses = [geometry.Pose.identity()]
    for k in range(1, model.nbody):
        parent_t_body = geometry.Pose(geometry.rotation_of_quaternion(model.body_quat[k]), model.body_pos[k])
        poses.append(poses[int(model.body_parentid[k])] @ parent_t_body)
    return poses


def geom_poses(model: mujoco.MjModel, bodies: list[geometry.Pose]) -> list[geometry.Pose]:
    """root_T_geom of all geoms; of a mesh, the frame in which MuJoCo keeps its vertices, at its principal axes."""
    return [
        bodies[int(model.geom_bodyid[k])]
        @ geometry.Pose(geometry.rotation_of_quaternion(model.geom_quat[k]), model.geom_pos[k])
        for k in range(model.ngeom)
    ]


def mesh_frame(model: mujoco.MjModel, mesh: int) -> geometry.Pose:
    """authored_T_kept: from the frame in which MuJoCo keeps a mesh's vertices to that of its scaled file."""
    return geometry.Pose(geometry.rotation_of_quaternion(model.mesh_quat[mesh]), model.mesh_pos[mesh])
