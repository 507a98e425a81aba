"""What a glTF scene shows, besides nodes that are nothing but collision; read when somebody looks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import overload

from meshforge.asset import Surface
from meshforge.errors import MeshForgeError
from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.reading.colors import coloured
from meshforge.formats.gltf.reading.conventions import convention_of
from meshforge.formats.gltf.reading.names import godot_kind, unreal_kind
from meshforge.formats.mesh_parts import placed
from meshforge.formats.meshfile.gltf import Scene, damage_at
from meshforge.formats.meshfile.gltf.items import entry


class SceneSurfaces(Sequence[Surface]):
    """The visible surfaces of a file; bodies: the body of each node that is in one."""

    def __init__(self, source: bytes, path: Path, bodies: dict[int, str]) -> None:
        self._source, self._path, self._bodies = source, path, bodies
        self._made: tuple[Surface, ...] | None = None

    @property
    def _surfaces(self) -> tuple[Surface, ...]:
        if self._made is None:
            try:
                self._made = tuple(self._read())
            except MeshForgeError:
                self._made = ()
        return self._made

    def _read(self) -> list[Surface]:
        with damage_at(str(self._path)):
            scene = Scene.of(self._source, self._path)
            found = []
            for index in visible(scene, convention_of(scene)):
                mesh, linear, offset = scene.placed(scene.placements[index])
                body = self._bodies.get(index)
                for part, rgba in coloured(scene, scene.placements[index].node["mesh"], mesh):
                    found.append(replace(placed(part.vertices, part.faces, linear, offset, body), rgba=rgba))
            return found

    @overload
    def __getitem__(self, index: int) -> Surface: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Surface, ...]: ...
    def __getitem__(self, index: int | slice) -> Surface | tuple[Surface, ...]:
        return self._surfaces[index]

    def __len__(self) -> int:
        return len(self._surfaces)


def visible(scene: Scene, convention: Convention) -> list[int]:
    """The nodes of meshes that are there to be seen; none where all meshes are taken for collision."""
    if convention == "plain":
        return []
    return [
        index
        for index, placement in scene.placements.items()
        if "mesh" in placement.node and not _only_collides(scene, index, convention)
    ]


def _only_collides(scene: Scene, index: int, convention: Convention) -> bool:
    node = scene.placements[index].node
    names = [node.get("name"), entry(scene.tree, "meshes", node["mesh"]).get("name")]
    if convention == "unreal":
        return any(unreal_kind(name) for name in names)
    kind = next((kind for kind in map(godot_kind, names) if kind), None)
    return convention == "godot" and kind in ("colonly", "convcolonly")
