"""Reading glTF 2.0 and GLB as triangles: a surface for each mesh in each node of the scene, transforms applied."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from meshforge.formats.meshfile.gltf.items import entry
from meshforge.formats.meshfile.gltf.scene import Placement, Scene, damage_at
from meshforge.formats.meshfile.surface import RawSurface, checked


def parse_gltf(data: bytes, path: Path) -> list[RawSurface]:
    """The surfaces of a glTF or GLB file, whose buffers may lie beside it.

    Raises AssetError: damaged, compressed in a way that is not read, or a buffer is missing.
    """
    where = str(path)
    with damage_at(where):
        scene = Scene.of(data, path)
        found = [surface for placement in scene.placements.values() for surface in _surface(scene, placement)]
    return checked(found, where)


def _surface(scene: Scene, placement: Placement) -> Iterator[RawSurface]:
    if "mesh" in placement.node:
        mesh, linear, offset = scene.place_mesh(placement)
        name = placement.node.get("name") or entry(scene.tree, "meshes", placement.node["mesh"]).get("name")
        yield RawSurface(name, mesh.vertices @ linear.T + offset, mesh.faces)
