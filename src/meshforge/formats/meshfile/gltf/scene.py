"""The scene of a glTF file: which nodes are in it, and where each of them is."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile.gltf.buffers import Buffers
from meshforge.formats.meshfile.gltf.container import Container
from meshforge.formats.meshfile.gltf.instances import all_instances, instances, is_instanced
from meshforge.formats.meshfile.gltf.items import Json, entries, entry, numbers
from meshforge.formats.meshfile.gltf.meshes import Triangles, triangles
from meshforge.formats.meshfile.gltf.turns import turns_of
from meshforge.geometry import Floats

_DAMAGE = (ValueError, LookupError, TypeError, AttributeError, RecursionError, OverflowError, MemoryError)
_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")  # an escape that is half a character, unless another one follows
_PLACED = frozenset(("matrix", "translation", "rotation", "scale"))


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


class Scene:
    """The default scene of a file, or its first one; without scenes, all nodes that are no children.

    Its methods raise ValueError and the like for damage; `damage_at` makes one message of them.
    """

    def __init__(self, tree: Json, binary: bytes | None, path: Path) -> None:
        self.tree, self.path = tree, path
        self.buffers = Buffers(tree, binary, path)
        self._meshes: dict[int, Triangles] = {}

    @staticmethod
    def of(data: bytes, path: Path) -> Scene:
        """The scene in the bytes of the file at a path."""
        container = Container.of(data)
        return Scene(parsed(container.text), container.binary, path)

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
                ring = index in _ancestors(found, parent)
                raise ValueError(f"node {index} is {'its own ancestor' if ring else 'a child of two nodes'}")
            world = above @ matrix_of(node)
            if not np.isfinite(world).all():
                raise ValueError(f"the place of node {index} is not finite")
            found[index] = Placement(index, node, world, parent)
            waiting += [(child, index, world) for child in reversed(entries(node, "children"))]
        return found

    def mesh(self, index: Any) -> Triangles:
        """The triangles of a mesh, in its own space."""
        if index not in self._meshes:
            self._meshes[index] = triangles(entry(self.tree, "meshes", index), self.buffers)
        return self._meshes[index]

    def instances(self, placement: Placement) -> Floats:
        """The places (k, 4, 4) of the instances of a node, in its space."""
        return instances(placement.node, self.buffers)

    def place_mesh(self, placement: Placement) -> tuple[Triangles, Floats, Floats]:
        """The triangles of the mesh of a node, and the map x -> linear @ x + offset that puts them in the root frame.

        A skinned mesh is put in place by its joints, as the file has them; of an instanced one it is all instances.
        """
        mesh = self.mesh(placement.node["mesh"])
        if is_instanced(placement.node):
            return all_instances(mesh, self.instances(placement)), placement.linear, placement.offset
        if "skin" in placement.node:
            from meshforge.formats.meshfile.gltf.skin import posed

            return posed(self, placement.node, mesh), np.eye(3), np.zeros(3)
        return mesh, placement.linear, placement.offset


@contextmanager
def damage_at(where: str) -> Iterator[None]:
    """Makes one clear AssetError of all that reading a damaged file may raise."""
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # numbers beyond all bounds are found and told
            yield
    except _DAMAGE as error:
        problem = f"{error.args[0]!r} is missing in it" if isinstance(error, KeyError) and error.args else str(error)
        raise AssetError(f"this glTF file is damaged: {problem}", where=where, remedy="Export it again.") from error


def matrix_of(node: Json) -> Floats:
    """The transform (4, 4) of a node to its parent. Raises ValueError."""
    matrix = np.eye(4)
    if _PLACED.isdisjoint(node):
        return matrix
    if "matrix" in node:
        return numbers(node, "matrix", 16, ()).reshape(4, 4).T
    quaternion = numbers(node, "rotation", 4, (0.0, 0.0, 0.0, 1.0))
    matrix[:3, :3] = turns_of(quaternion) * numbers(node, "scale", 3, (1.0, 1.0, 1.0))
    matrix[:3, 3] = numbers(node, "translation", 3, (0.0, 0.0, 0.0))
    return matrix


def _ancestors(found: dict[int, Placement], index: int | None) -> set[int]:
    above: set[int] = set()
    while index is not None:
        above.add(index)
        index = found[index].parent
    return above


def parsed(text: bytes) -> Json:
    """The JSON of a file, `?` for each half of a character in it. Raises ValueError: none, or another version."""
    plain = text.decode("utf-8-sig").rstrip("\0")
    tree = json.loads(plain, parse_constant=_refused)
    if _SURROGATE.search(plain):
        tree = json.loads(json.dumps(tree, ensure_ascii=False).encode("utf-8", "replace"))
    if not isinstance(tree, dict):
        raise ValueError("its JSON is no object")
    asset = tree.get("asset", {})
    version = asset.get("minVersion", asset.get("version", "2.0"))
    if not str(version).startswith("2."):
        raise ValueError(f"it is glTF {version}, only glTF 2 is read")
    return tree


def _refused(constant: str) -> float:
    raise ValueError(f"{constant} is no number of JSON")
