"""What a glTF scene shows, with its colours, besides nodes that are nothing but collision; read when somebody looks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.formats.collision_pieces import place_surface
from meshforge.formats.engine_names.base import godot_kind, unreal_kind
from meshforge.formats.gltf.colliders import convention_of, nodes_below_colliders
from meshforge.formats.gltf.document import Convention
from meshforge.formats.meshfile.gltf_document import entries, entry, report_damage
from meshforge.formats.meshfile.gltf_meshes import GltfMesh
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.visuals import LazySurfaces, Rgba
from meshforge.symbolic import Surface

GAMMA = 2.2
"""Colours of glTF are linear, those of other formats are as screens show them."""


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
        with report_damage(str(self._path)):
            scene = GltfScene.of(self._source, self._path)
            found = []
            for index in visible_nodes(scene, convention_of(scene)):
                mesh, linear, offset = scene.place_mesh(scene.placements[index])
                body = self._bodies.get(index)
                for part, rgba in split_by_color(scene, scene.placements[index].node["mesh"], mesh):
                    found.append(replace(place_surface(part.vertices, part.faces, linear, offset, body), rgba=rgba))
            return found


def visible_nodes(scene: GltfScene, convention: Convention) -> list[int]:
    """The nodes of meshes that are there to be seen; none where all meshes are taken for collision."""
    if convention == "plain":
        return []
    colliding = nodes_below_colliders(scene) if convention == "unity" else frozenset()
    return [
        index
        for index, placement in scene.placements.items()
        if "mesh" in placement.node and index not in colliding and not _is_only_collision(scene, index, convention)
    ]


def _is_only_collision(scene: GltfScene, index: int, convention: Convention) -> bool:
    node = scene.placements[index].node
    names = [node.get("name"), entry(scene.tree, "meshes", node["mesh"]).get("name")]
    if convention == "unreal":
        return any(unreal_kind(name) for name in names)
    kind = next((kind for kind in map(godot_kind, names) if kind), None)
    return convention == "godot" and kind in ("colonly", "convcolonly")


def split_by_color(scene: GltfScene, mesh: int, whole: GltfMesh) -> Iterator[tuple[GltfMesh, Rgba | None]]:
    """The triangles of a mesh, apart where its parts have colours of their own; None for those without one."""
    parts = entries(entry(scene.tree, "meshes", mesh), "primitives")
    colors = [_read_color(scene, parts[patch.index].get("material")) for patch in whole.patches]
    if not len(whole.faces):
        return
    if len(set(colors)) == 1:
        yield whole, colors[0]
        return
    start = 0
    for patch, color in zip(whole.patches, colors, strict=True):
        end = start + len(patch.points)
        yield GltfMesh(whole.vertices[start:end], patch.faces, (patch,)), color
        start = end


def _read_color(scene: GltfScene, material: int | None) -> Rgba | None:
    """The colour of a material; None where it has a texture, or tells no colour."""
    shading = {} if material is None else entry(scene.tree, "materials", material).get("pbrMetallicRoughness", {})
    factor = shading.get("baseColorFactor")
    if factor is None or "baseColorTexture" in shading or len(factor) != 4:
        return None
    red, green, blue = (np.clip(np.asarray(factor[:3], dtype=np.float64), 0, 1) ** (1 / GAMMA)).tolist()
    return round(red, 4), round(green, 4), round(blue, 4), float(factor[3])
