"""Objects of trimesh, for those who go on with that library."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from meshforge.common import import_extra
from meshforge.geometry import Floats, Ints


def make_trimesh(vertices: Floats, faces: Ints, metadata: Mapping[str, str | None]) -> Any:
    """Return a `trimesh.Trimesh` with vertices (n, 3) and faces (m, 3) as they are. Raises MeshForgeError without
    trimesh."""
    trimesh = import_extra("trimesh", "trimesh", "to_trimesh()")
    return trimesh.Trimesh(vertices.copy(), faces.copy(), process=False, metadata=dict(metadata))


def make_scene(meshes: Mapping[str, Any]) -> Any:
    """Return a `trimesh.Scene` of meshes, each under its name. Raises MeshForgeError without trimesh."""
    scene = import_extra("trimesh", "trimesh", "to_trimesh()").Scene()
    for name, mesh in meshes.items():
        scene.add_geometry(mesh, node_name=name, geom_name=name)
    return scene
