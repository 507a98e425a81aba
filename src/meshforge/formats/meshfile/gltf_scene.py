"""The scene of a glTF file: which nodes are in it, where each of them is, and all of it as surfaces."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.meshfile import gltf_meshes
from meshforge.formats.meshfile.gltf_document import (
    Container,
    Json,
    entries,
    entry,
    extension,
    numbers,
    parse_json,
    report_damage,
)
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces
from meshforge.geometry import Floats, rotation_of_quaternion

_INSTANCING = "EXT_mesh_gpu_instancing"
SKINNED = "a mesh that a skin moves, which is not read"
_PLACED = frozenset(("matrix", "translation", "rotation", "scale"))


def parse_gltf(data: bytes, path: Path) -> list[RawSurface]:
    """Return the surfaces of a glTF or GLB file, whose buffers may lie beside it.

    Raises AssetError: damaged, compressed in a way that is not read, or a buffer is missing.
    """
    where = str(path)
    with report_damage(where):
        scene = GltfScene.of(data, path)
        found = [surface for placement in scene.placements.values() for surface in _read_surface(scene, placement)]
    return check_surfaces(found, where)


def _read_surface(scene: "GltfScene", placement: "Placement") -> Iterator[RawSurface]:
    if "skin" in placement.node:
        problem = f"node {placement.node.get('name') or placement.index!r} has {SKINNED}"
        raise AssetError(problem, where=str(scene.path), remedy="Apply its pose, and export it without a skin.")
    if "mesh" in placement.node:
        mesh, linear, offset = scene.place_mesh(placement)
        name = placement.node.get("name") or entry(scene.tree, "meshes", placement.node["mesh"]).get("name")
        yield RawSurface(name, mesh.vertices @ linear.T + offset, mesh.faces)


@dataclass(frozen=True, eq=False, slots=True)
class Placement:
    """A node of the scene; world: (4, 4), root_T_node, which may scale and shear; parent: None for a root."""

    index: int
    node: Json
    world: Floats
    parent: int | None

    @property
    def linear(self) -> Floats:
        return self.world[:3, :3]

    @property
    def offset(self) -> Floats:
        return self.world[:3, 3]


class GltfScene:
    """The default scene of a file, or its first one; without scenes, all nodes that are no children.

    Its methods raise ValueError and the like for damage; `report_damage` makes one message of them.
    """

    def __init__(self, tree: Json, binary: bytes | None, path: Path) -> None:
        self.tree, self.path = tree, path
        self.buffers = gltf_meshes.Buffers(tree, binary, path)
        self._meshes: dict[int, gltf_meshes.GltfMesh] = {}

    @staticmethod
    def of(data: bytes, path: Path) -> "GltfScene":
        """Return the scene in the bytes of the file at a path."""
        container = Container.of(data)
        return GltfScene(parse_json(container.text), container.binary, path)

    @cached_property
    def roots(self) -> list[int]:
        scenes = entries(self.tree, "scenes")
        if scenes:
            return entries(entry(self.tree, "scenes", self.tree.get("scene", 0)), "nodes")
        nodes = entries(self.tree, "nodes")
        children = {child for node in nodes for child in entries(node, "children")}
        return [k for k in range(len(nodes)) if k not in children]

    @cached_property
    def placements(self) -> dict[int, Placement]:
        """All nodes of the scene by their number, each before its children, in the order of the file."""
        found: dict[int, Placement] = {}
        waiting: list[tuple[int, int | None, Floats]] = [(k, None, np.eye(4)) for k in reversed(self.roots)]
        while waiting:
            index, parent, above = waiting.pop()
            node = entry(self.tree, "nodes", index)
            if index in found:
                ring = index in _ancestors_of(found, parent)
                raise ValueError(f"node {index} is {'its own ancestor' if ring else 'a child of two nodes'}")
            world = above @ matrix_of(node)
            if not np.isfinite(world).all():
                raise ValueError(f"the place of node {index} is not finite")
            if extension(node, _INSTANCING) is not None:
                name = node.get("name") or index
                problem = f"node {name!r} shows a mesh many times by {_INSTANCING}, which is not read"
                raise AssetError(problem, where=str(self.path), remedy="Give each a node: gltf-transform uninstance.")
            found[index] = Placement(index, node, world, parent)
            waiting += [(child, index, world) for child in reversed(entries(node, "children"))]
        return found

    def mesh(self, index: Any) -> gltf_meshes.GltfMesh:
        """Return the triangles of a mesh, in its own space."""
        if index not in self._meshes:
            self._meshes[index] = gltf_meshes.read_mesh(entry(self.tree, "meshes", index), self.buffers)
        return self._meshes[index]

    def place_mesh(self, placement: Placement) -> tuple[gltf_meshes.GltfMesh, Floats, Floats]:
        """Return the triangles of the mesh of a node, and the map x -> linear @ x + offset to the root frame."""
        return self.mesh(placement.node["mesh"]), placement.linear, placement.offset


def matrix_of(node: Json) -> Floats:
    """Return the transform (4, 4) of a node to its parent. Raises ValueError."""
    matrix = np.eye(4)
    if _PLACED.isdisjoint(node):
        return matrix
    if "matrix" in node:
        return numbers(node, "matrix", 16, ()).reshape(4, 4).T
    matrix[:3, :3] = rotation_in(node, "rotation") * numbers(node, "scale", 3, (1.0, 1.0, 1.0))
    matrix[:3, 3] = numbers(node, "translation", 3, (0.0, 0.0, 0.0))
    return matrix


def rotation_in(owner: Json, key: str) -> Floats:
    """Return the rotation (3, 3) under a key, a quaternion x y z w of any length. Raises ValueError."""
    x, y, z, w = numbers(owner, key, 4, (0.0, 0.0, 0.0, 1.0)).tolist()
    if not any((x, y, z, w)):
        raise ValueError("a rotation of all zeros")
    return rotation_of_quaternion([w, x, y, z])


def _ancestors_of(found: dict[int, Placement], index: int | None) -> set[int]:
    above: set[int] = set()
    while index is not None:
        above.add(index)
        index = found[index].parent
    return above
