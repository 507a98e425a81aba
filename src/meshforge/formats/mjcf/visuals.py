"""What the bodies of a compiled model show: geoms that do not collide, and meshes of which only the hull does."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from meshforge.formats.mjcf.assets import Folders
from meshforge.formats.mjcf.kinematics import mesh_frame, rotation_of
from meshforge.formats.mjcf.model import Reading
from meshforge.formats.mjcf.shapes import Shapes
from meshforge.formats.triangles import MESH_SUFFIXES
from meshforge.formats.visuals import LazySurfaces, Visual
from meshforge.geometry import Pose

if TYPE_CHECKING:
    import mujoco

_SHOWN_GROUPS = 3  # MuJoCo's viewers show the groups 0, 1 and 2


def read_visuals(reading: Reading, spec: mujoco.MjSpec, hidden: frozenset[int] = frozenset()) -> LazySurfaces:
    """The visuals of all bodies; hidden: geoms that only stand for others."""
    shapes = Shapes(reading.model)
    meshes = {mesh.id: mesh for mesh in spec.meshes}
    return LazySurfaces(
        tuple(
            visual
            for k in range(reading.model.ngeom)
            if k not in hidden and _shown(reading, k)
            for visual in _visual(reading, shapes, meshes, k)
        )
    )


def _shown(reading: Reading, k: int) -> bool:
    model = reading.model
    material = int(model.geom_matid[k])
    opacity = model.mat_rgba[material, 3] if material >= 0 else model.geom_rgba[k, 3]
    if opacity <= 0:
        return False
    is_mesh = model.geom_dataid[k] >= 0
    return not reading.collides[k] or bool(is_mesh and model.geom_group[k] < _SHOWN_GROUPS)


def _visual(reading: Reading, shapes: Shapes, meshes: dict[int, mujoco.MjsMesh], k: int) -> Iterator[Visual]:
    import mujoco

    model, body, pose = reading.model, reading.body_of[k], reading.geom_poses[k]
    if (shape := shapes.primitive(k, pose)) is not None:
        yield Visual(body, shape, np.eye(3), np.zeros(3))
        return
    mesh = int(model.geom_dataid[k])
    if mesh not in meshes or model.geom_type[k] == mujoco.mjtGeom.mjGEOM_HFIELD:
        return
    path = _file(reading, meshes[mesh])
    if path is not None:
        yield _of_file(model, mesh, meshes[mesh], body, pose, path)


def _file(reading: Reading, mesh: mujoco.MjsMesh) -> Path | None:
    """The file of a mesh that can be read again, None where there is none."""
    node = reading.flat.node(mesh.info)
    if node is None or not node.attributes.get("file"):
        return None
    path = Folders.of(reading.tree).find(reading.tree, node)
    return path if path.suffix.lower() in MESH_SUFFIXES else None


def _of_file(
    model: mujoco.MjModel, mesh: int, spec: mujoco.MjsMesh, body: str, root_t_geom: Pose, path: Path
) -> Visual:
    """A mesh file in place: moved to its reference pose, scaled, then placed as the geom says."""
    placed = root_t_geom @ mesh_frame(model, mesh).inverse()
    linear = placed.rotation * np.asarray(spec.scale) @ rotation_of(np.asarray(spec.refquat)).T
    return Visual(body, path, linear, placed.translation - linear @ np.asarray(spec.refpos))
