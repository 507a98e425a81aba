"""What the bodies of a compiled model show: geoms that do not collide, and meshes of which only the hull does."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from meshforge.formats.mjcf.files.assets import Folders
from meshforge.formats.mjcf.reading.kinematics import mesh_frame, rotation_of
from meshforge.formats.mjcf.reading.model import Reading
from meshforge.formats.mjcf.reading.shapes import Shapes, mesh_surface
from meshforge.formats.triangles import MESH_SUFFIXES
from meshforge.formats.visuals import Rgba, Visual, VisualSurfaces
from meshforge.geometry import Floats, Polytope

if TYPE_CHECKING:
    import mujoco

_SHOWN_GROUPS = 3  # MuJoCo's viewers show the groups 0, 1 and 2


def read_visuals(reading: Reading, spec: mujoco.MjSpec, hidden: frozenset[int] = frozenset()) -> VisualSurfaces:
    """The visuals of all bodies; hidden: geoms that only stand for others."""
    seen = _Visuals(reading, spec)
    found = (seen.of(k) for k in range(reading.model.ngeom) if k not in hidden)
    return VisualSurfaces(tuple(visual for visual in found if visual))


class _Visuals:
    """The visuals of the geoms of one model."""

    def __init__(self, reading: Reading, spec: mujoco.MjSpec) -> None:
        import mujoco

        self.reading, self.model = reading, reading.model
        self.shapes = Shapes(reading.model)
        self.meshes = {mesh.id: mesh for mesh in spec.meshes}
        self.folders = Folders.of(reading.tree)
        self.field = mujoco.mjtGeom.mjGEOM_HFIELD

    def of(self, k: int) -> Visual | None:
        """What a geom shows, None where it is not to be seen; height fields and planes are opaque pieces already."""
        model, body, pose = self.model, self.reading.body_of[k], self.reading.geom_poses[k]
        rgba, mesh = self._rgba(k), int(model.geom_dataid[k])
        is_mesh = mesh >= 0 and model.geom_type[k] != self.field
        if rgba[3] <= 0 or (self.reading.collides[k] and not (is_mesh and model.geom_group[k] < _SHOWN_GROUPS)):
            return None
        if (shape := self.shapes.primitive_of(k, pose)) is not None:
            return Visual(body, shape, np.eye(3), np.zeros(3), rgba)
        if not is_mesh:
            return None
        if path := self._find_file(mesh):
            placed = pose @ mesh_frame(model, mesh).inverse()
            refpos, refquat = self._reference(mesh)
            linear = placed.rotation * model.mesh_scale[mesh] @ rotation_of(refquat).T
            return Visual(body, path, linear, placed.translation - linear @ refpos, rgba)
        surface = mesh_surface(model, mesh, pose)  # of the model itself, or of a kind of file that only MuJoCo reads
        return Visual(body, Polytope(surface.vertices, surface.faces), np.eye(3), np.zeros(3), rgba)

    def _rgba(self, k: int) -> Rgba:
        material = int(self.model.geom_matid[k])
        colour = self.model.mat_rgba[material] if material >= 0 else self.model.geom_rgba[k]
        red, green, blue, alpha = (float(share) for share in colour)
        return red, green, blue, alpha

    def _find_file(self, mesh: int) -> Path | None:
        """The file of a mesh that can be read again, None where there is none."""
        node = self.reading.flat.node_at(self.meshes[mesh].info) if mesh in self.meshes else None
        if node is None or not node.attributes.get("file"):
            return None
        path = self.folders.find(self.reading.tree, node)
        return path if path.suffix.lower() in MESH_SUFFIXES else None

    def _reference(self, mesh: int) -> tuple[Floats, Floats]:
        """The reference position (3,) and quaternion (4,) of a mesh, by which its vertices are moved first of all."""
        return np.asarray(self.meshes[mesh].refpos), np.asarray(self.meshes[mesh].refquat)
