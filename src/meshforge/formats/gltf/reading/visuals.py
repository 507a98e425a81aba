"""What a glTF scene shows, besides nodes that are nothing but collision; read when somebody looks."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from meshforge.asset import Surface
from meshforge.errors import MeshForgeError
from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.reading.colors import coloured
from meshforge.formats.gltf.reading.conventions import below_colliders, convention_of
from meshforge.formats.mesh_parts import placed
from meshforge.formats.meshfile.gltf import Scene, damage_at
from meshforge.formats.meshfile.gltf.items import entry
from meshforge.formats.naming.marks import godot_kind, unreal_kind
from meshforge.formats.visuals import LazySurfaces


class SceneSurfaces(LazySurfaces):
    """The visible surfaces of a file, none where it is damaged; bodies: the body of each node that is in one."""

    def __init__(self, source: bytes, path: Path, bodies: dict[int, str]) -> None:
        self._source, self._path, self._bodies = source, path, bodies

    def _make(self) -> list[Surface]:
        try:
            return self._read()
        except MeshForgeError:
            return []

    def _read(self) -> list[Surface]:
        with damage_at(str(self._path)):
            scene = Scene.of(self._source, self._path)
            found = []
            for index in visible(scene, convention_of(scene)):
                mesh, linear, offset = scene.place_mesh(scene.placements[index])
                body = self._bodies.get(index)
                for part, rgba in coloured(scene, scene.placements[index].node["mesh"], mesh):
                    found.append(replace(placed(part.vertices, part.faces, linear, offset, body), rgba=rgba))
            return found


def visible(scene: Scene, convention: Convention) -> list[int]:
    """The nodes of meshes that are there to be seen; none where all meshes are taken for collision."""
    if convention == "plain":
        return []
    colliding = below_colliders(scene) if convention == "unity" else frozenset()
    return [
        index
        for index, placement in scene.placements.items()
        if "mesh" in placement.node and index not in colliding and not _only_collides(scene, index, convention)
    ]


def _only_collides(scene: Scene, index: int, convention: Convention) -> bool:
    node = scene.placements[index].node
    names = [node.get("name"), entry(scene.tree, "meshes", node["mesh"]).get("name")]
    if convention == "unreal":
        return any(unreal_kind(name) for name in names)
    kind = next((kind for kind in map(godot_kind, names) if kind), None)
    return convention == "godot" and kind in ("colonly", "convcolonly")
