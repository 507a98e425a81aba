"""A scene being edited: nodes emptied and added, meshes split and made, while no index of the file changes."""

import copy
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.collision_pieces import leaves_volume
from meshforge.formats.gltf import output, physics
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension
from meshforge.formats.meshfile.gltf_meshes import DRACO
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.geometry import Floats, Ints, Shape
from meshforge.symbolic import Geom, NonConvexPiece, Texture

_POINTER = re.compile(r"/nodes/(\d+)(/.*)?")


class SceneDraft:
    """The tree of a scene, to be edited; before: the chunk that new geometry follows, None for a buffer of its own.

    expected: for each node with collision, the names that its pieces should read back as; pictures: images by bytes.
    """

    def __init__(self, scene: GltfScene, tree: Json, before: bytes | None) -> None:
        self.scene, self.tree = scene, tree
        self.geometry = output.GeometryBuffer(tree, before)
        self.referred = SceneReferences(scene.tree)
        self.expected: dict[int, tuple[str, ...]] = {}
        self.pictures: dict[bytes, int] = {}
        self._bodies = physics.body_nodes(scene)

    def node(self, index: int) -> Json:
        """Return a node of the edited tree."""
        return entry(self.tree, "nodes", index)

    def empty_node(self, index: int) -> None:
        """Take the triangles from a node, and the node from the tree where nothing else hangs on it.

        It stays in the list of nodes, so that no other gets its number.
        """
        self.remove_mesh(index)
        node = self.node(index)
        needed = node.get("children") or node.get("extensions") or {"camera", "mesh"} & node.keys()
        if not needed and index not in self.referred.nodes:
            self._remove_node(index)

    def remove_mesh(self, index: int) -> Json:
        """Take the mesh from a node but for its points and lines; what belonged to it is returned.

        Raises AssetError: an animation morphs it.
        """
        node = self.node(index)
        if index in self.referred.morphed:
            called = node.get("name") or index
            problem = f"an animation drives the morph weights of node {called!r}, whose mesh would go"
            remedy = "Leave the hull as it is, or take the animation out of the file."
            raise AssetError(problem, where=str(self.scene.path), remedy=remedy)
        gone: Json = {key: node.pop(key) for key in ("mesh", "skin", "weights") if key in node}
        if "mesh" in gone:
            mesh = entry(self.scene.tree, "meshes", gone["mesh"])
            solid = {patch.index for patch in self.scene.mesh(gone["mesh"]).patches}
            parts = enumerate(entries(mesh, "primitives"))
            strokes = [copy.deepcopy(part) for k, part in parts if k not in solid]
            if strokes:
                node |= {**gone, "mesh": self.add_mesh({**mesh, "primitives": strokes}, gone["mesh"])}
        return gone

    def add_node(self, node: Json, holder: int | None, at: int | None = None) -> int:
        """Return a new node below another one, or at the root; at: before which child, None for the last."""
        nodes: list[Any] = self.tree.setdefault("nodes", [])
        nodes.append(node)
        index = len(nodes) - 1
        if holder is not None:
            children: list[Any] = self.node(holder).setdefault("children", [])
            children.insert(len(children) if at is None else at, index)
        elif entries(self.tree, "scenes"):
            entry(self.tree, "scenes", self.tree.get("scene", 0)).setdefault("nodes", []).append(index)
        return index

    def declare_extension(self, extension: str) -> None:
        """Say that the file uses an extension."""
        used: list[Any] = self.tree.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def add_mesh(self, mesh: Json, instead_of: int | None = None) -> int:
        """Return a new mesh; in the place of another one where that one stood in a single node only."""
        meshes: list[Any] = self.tree.setdefault("meshes", [])
        if instead_of is not None and self.referred.users.get(instead_of, 0) == 1:
            self.referred.users[instead_of] = 0
            meshes[instead_of] = mesh
            return instead_of
        meshes.append(mesh)
        return len(meshes) - 1

    def add_surface_mesh(
        self, points: Floats, faces: Ints, name: str, material: int | None = None, texture: Texture | None = None
    ) -> tuple[int, Floats]:
        """Return a new mesh of vertices (n, 3) and faces (m, 3) about the middle of their box, and that middle (3,)."""
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        primitive = self.build_primitive(points - middle, faces, material, texture)
        return self.add_mesh({"name": name, "primitives": [primitive]}), middle

    def build_primitive(
        self, points: Floats, faces: Ints, material: int | None = None, texture: Texture | None = None
    ) -> Json:
        """Return a primitive of vertices (n, 3) and faces (m, 3), where they are; texture: that its material has."""
        part: Json = {"attributes": {"POSITION": self.geometry.add_vertex_data(points.astype("<f4"), bounds=True)}}
        if texture is not None:
            downwards = np.column_stack([texture.coordinates[:, 0], 1 - texture.coordinates[:, 1]])
            part["attributes"]["TEXCOORD_0"] = self.geometry.add_vertex_data(downwards.astype("<f4"))
        part["indices"] = self.geometry.add_triangles(faces)
        return part if material is None else {**part, "material": material}

    def extract_pieces(self, index: int, owner: Ints | None, kept: Iterable[int], *, strokes: bool = False) -> Json:
        """Return a mesh of some pieces only: with the vertices, attributes and materials of the whole.

        strokes: whether its points and lines, which are no part of a piece, stay in it.
        """
        assert owner is not None  # only meshes have several pieces
        mesh = copy.deepcopy(entry(self.scene.tree, "meshes", index))
        stays = np.isin(owner, list(kept))
        patches = self.scene.mesh(index).patches
        starts = np.cumsum([0, *(len(patch.faces) for patch in patches)])
        whole = {patch.index: (patch, start) for patch, start in zip(patches, starts, strict=False)}
        parts = []
        for k, part in enumerate(mesh["primitives"]):
            if k not in whole:
                parts += [part] * strokes
                continue
            patch, start = whole[k]
            own = stays[start : start + len(patch.faces)]
            if own.any():
                parts.append(part if own.all() else self._keep_faces(part, patch.faces[own]))
        return {**mesh, "primitives": parts}

    def _keep_faces(self, part: Json, faces: Ints) -> Json:
        """A primitive with some of its triangles. Raises AssetError: Draco compressed it."""
        if extension(part, DRACO) is not None:
            problem = f"a hull would be taken out of a mesh that {DRACO} compresses"
            raise AssetError(problem, where=str(self.scene.path), remedy="Export it without mesh compression.")
        part = {**part, "indices": self.geometry.add_triangles(faces)}
        part.pop("mode", None)
        return part

    def holder_of(self, body: int | None, source: int | None) -> int | None:
        """Return the node below which a new hull goes, None for the root of the scene.

        body: the node that is its body; source: the node of the hull that it comes after, beside which it goes, or
        below which where that one is a body or is moved by an animation.
        """
        holder = body
        if source is not None:
            below = source == body or source in self.referred.animated
            holder = source if below else self.scene.placements[source].parent
        if holder is None or self._bodies.get(holder) != body:
            return body
        return holder if self.keeps_volume(holder) else body

    def keeps_volume(self, index: int) -> bool:
        """Return whether a node leaves a volume to what is below it."""
        return leaves_volume(self.scene.placements[index].linear, 1e-9)

    def shape_in(self, shape: Shape, holder: int | None) -> Shape:
        """Return a shape of the root frame in the space of a node."""
        if holder is None:
            return shape
        inverse = self.matrix_below(None, holder)
        return shape.transform(inverse[:3, :3], inverse[:3, 3])

    def triangles_in(self, what: Geom | NonConvexPiece, holder: int | None) -> tuple[Floats, Ints]:
        """Return the vertices (n, 3) of a hull or a piece in the space of a node, and its faces (m, 3)."""
        if isinstance(what, Geom):
            hull = self.shape_in(what.shape, holder).tessellate()
            return hull.vertices, hull.faces
        assert what.surface is not None  # one that has triangles
        return self.points_in(np.asarray(what.surface.vertices), holder), what.surface.faces

    def points_in(self, points: Floats, holder: int | None) -> Floats:
        """Return points (n, 3) of the root frame in the space of a node."""
        if holder is None:
            return points
        inverse = self.matrix_below(None, holder)
        return np.asarray(points @ inverse[:3, :3].T + inverse[:3, 3], dtype=np.float64)

    def matrix_below(self, node: int | None, holder: int | None) -> Floats:
        """Return the place (4, 4) of a node in the space of another one; None is the root frame."""
        if node is None and holder is not None:
            return np.asarray(np.linalg.inv(self.scene.placements[holder].world), dtype=np.float64)
        world = np.eye(4) if node is None else self.scene.placements[node].world
        return world if holder is None else np.asarray(np.linalg.solve(self.scene.placements[holder].world, world))

    def _remove_node(self, index: int) -> None:
        parent = self.scene.placements[index].parent
        holders = [(self.node(parent), "children")] if parent is not None else []
        holders += [(scene, "nodes") for scene in entries(self.tree, "scenes")]
        for holder, key in holders:
            if index in holder.get(key, ()):
                holder[key] = [child for child in holder[key] if child != index]
                if not holder[key]:
                    del holder[key]  # an empty list is not allowed


def name_of(thing: Json) -> str:
    """Return the name of a node, mesh or material, empty where it has none."""
    name = thing.get("name")
    return name if isinstance(name, str) else ""


class SceneReferences:
    """References to the nodes and meshes of a tree.

    animated, morphed: nodes that animations move, or morph; nodes: all that are referred to other than as children;
    users: how many nodes show each mesh, and how many colliders name it.
    """

    def __init__(self, tree: Json) -> None:
        targets = list(_animation_targets(tree))
        self.morphed = {node for node, what in targets if what == "weights"}
        self.animated = {node for node, what in targets if what != "weights"}
        self.nodes = {node for node, _ in targets} | set(_skin_joints(tree))
        self.nodes |= set(_numbers_under(tree, ("node", "connectedNode")))
        self.users: Counter[int] = Counter(_numbers_under(tree, ("mesh",)))


def _animation_targets(tree: Json) -> Iterator[tuple[int, str]]:
    for animation in entries(tree, "animations"):
        for channel in entries(animation, "channels"):
            target = channel.get("target", {})
            if isinstance(target.get("node"), int):
                yield target["node"], str(target.get("path"))
            pointer = (extension(target, "KHR_animation_pointer") or {}).get("pointer", "")
            if found := _POINTER.fullmatch(str(pointer)):
                yield int(found[1]), (found[2] or "/").split("/")[1]


def _skin_joints(tree: Json) -> Iterator[int]:
    for skin in entries(tree, "skins"):
        yield from entries(skin, "joints")
        if isinstance(skin.get("skeleton"), int):
            yield skin["skeleton"]


def _numbers_under(tree: Json, keys: tuple[str, ...]) -> Iterator[int]:
    """The numbers under some keys, anywhere in extensions and nodes; a node's own number in itself is none."""
    waiting: list[tuple[Any, int | None]] = [(tree.get("extensions"), None)]
    waiting += [(node, k if "node" in keys else None) for k, node in enumerate(entries(tree, "nodes"))]
    while waiting:
        value, itself = waiting.pop()
        if isinstance(value, dict):
            yield from (v for k, v in value.items() if k in keys and isinstance(v, int) and v != itself)
            waiting += [(inner, itself) for inner in value.values()]
        elif isinstance(value, list):
            waiting += [(inner, itself) for inner in value]
