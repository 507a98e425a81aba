"""The collision geometry of a scene: the convention of its file, the nodes that collide by it, and their pieces."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from meshforge.common import GeometryError
from meshforge.formats.collision_pieces import CollisionPiece, leaves_volume, place_pieces, place_surface
from meshforge.formats.engine_names import godot_kind, holds_colliders, interpret_unreal_shape, unreal_kind
from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.physics import EXTENSIONS, collider_of, has_collider, physics_extension_of, rigid_pose_of
from meshforge.formats.meshfile.gltf_document import Json, entry
from meshforge.formats.meshfile.gltf_meshes import GltfMesh
from meshforge.formats.meshfile.gltf_scene import SKINNED, GltfScene, Placement
from meshforge.geometry import Ellipsoid, Floats, Ints, Piece, Polytope, Pose, Sphere, hull_mesh, split_pieces

PlacedMesh = tuple[GltfMesh, Floats, Floats]
"""A mesh, and the map x -> linear @ x + offset that puts it in the root frame."""
NodePieces = tuple[Sequence[CollisionPiece], Ints | None]
"""The pieces of a node, and the piece (m,) of each triangle where they are parts of its mesh."""


@dataclass(frozen=True, eq=False, slots=True)
class NodeCollision:
    """A node with collision: its name, and its pieces in the root frame.

    owner: the piece (m,) of each triangle, as in `NodeRecord`.
    """

    node: int
    name: str | None
    parts: Sequence[CollisionPiece]
    owner: Ints | None = None


@dataclass(slots=True)
class CollisionReader:
    """Reads the collision of one scene; notes: what a user should know of how."""

    scene: GltfScene
    convention: Convention = "plain"
    notes: list[str] = field(default_factory=list)
    _pieces: dict[int, list[Piece]] = field(default_factory=dict)

    def read(self) -> list[NodeCollision]:
        """Return all nodes with collision, in the order of the scene."""
        self.convention = convention_of(self.scene)
        below, found = nodes_below_colliders(self.scene), []
        for index, placement in self.scene.placements.items():
            if self.convention in EXTENSIONS:
                collides = has_collider(placement.node, self.convention)
            else:
                collides = "mesh" in placement.node and (self.convention != "unity" or index in below)
            if collides:
                name = collision_name_of(self.scene, placement, self.convention)
                parts, owner = self._read_node(placement, name)
                found += [NodeCollision(index, name, parts, owner)] if parts else []
        return found

    def _read_node(self, placement: Placement, name: str | None) -> NodePieces:
        if self.convention in EXTENSIONS:
            return self._read_physics(placement, name)
        if self.convention in ("unreal", "godot") and name is None:
            return [], None
        if "skin" in placement.node:
            return [CollisionPiece(None, SKINNED)], None
        placed = self.scene.place_mesh(placement)
        if not len(placed[0].faces):
            return [], None
        if self.convention == "unreal":
            part = _hull_part(*placed)
            if part.shape is None:
                return [part], None
            shape, note = interpret_unreal_shape(name or "", part.shape)
            self.notes += [note] if note else []
            return [replace(part, shape=shape)], None
        if self.convention == "godot" and godot_kind(name) in ("convcol", "convcolonly"):
            return [_hull_part(*placed)], None
        return self._split(placement, name, placement.node["mesh"], placed)

    def _read_physics(self, placement: Placement, name: str | None) -> NodePieces:
        collider = collider_of(placement, self.convention, self.scene)
        if collider.shape is not None:
            return [self._place_shape(placement, name, collider.shape)], None
        if not isinstance(collider.mesh, int) or collider.mesh < 0:
            return [CollisionPiece(None, "its collider names no mesh")], None
        placed = self.scene.mesh(collider.mesh), placement.linear, placement.offset
        if collider.convex:
            return [_hull_part(*placed)], None
        return self._split(placement, name, collider.mesh, placed)

    def _place_shape(self, placement: Placement, name: str | None, found: CollisionPiece) -> CollisionPiece:
        if found.shape is None:
            return replace(found, plane=rigid_pose_of(placement) @ found.plane if found.plane else None)
        if isinstance(found.shape, Polytope):
            self.notes.append(f"the collider of {name or f'node {placement.index}'!r} is tapered: it is read as a hull")
        if not leaves_volume(placement.linear):
            return CollisionPiece(None, "it is scaled to nothing")
        shape = found.shape.transform(placement.linear, placement.offset)
        if isinstance(found.shape, Sphere) and not isinstance(shape, Sphere):
            egg = Ellipsoid(Pose.identity(), np.full(3, found.shape.radius))
            shape = egg.transform(placement.linear, placement.offset)
        return CollisionPiece(shape)

    def _split(self, placement: Placement, name: str | None, index: int, placed: PlacedMesh) -> NodePieces:
        mesh, linear, offset = placed
        if not len(mesh.faces):
            return [], None
        if not leaves_volume(linear):
            return [_non_convex_part(mesh, linear, offset, "it is scaled to nothing")], None
        if index not in self._pieces:
            self._pieces[index] = _split_mesh(mesh, name or f"node {placement.index}")
        found, owner = self._pieces[index], np.zeros(len(mesh.faces), dtype=np.int64)
        for k, piece in enumerate(found):
            owner[piece.face_indices] = k
        return place_pieces(found, linear, offset), owner


def _hull_part(mesh: GltfMesh, linear: Floats, offset: Floats) -> CollisionPiece:
    if not len(mesh.faces):
        return CollisionPiece(None, "the mesh holds no triangles")
    if not leaves_volume(linear):
        return _non_convex_part(mesh, linear, offset, "it is scaled to nothing")
    try:
        hull, fill = hull_mesh(mesh.vertices, mesh.faces)
        return CollisionPiece(hull.transform(linear, offset), fill=fill)
    except GeometryError:
        return _non_convex_part(mesh, linear, offset, "flat")


def _split_mesh(mesh: GltfMesh, name: str) -> list[Piece]:
    try:
        return split_pieces(mesh.vertices, mesh.faces, name=name)
    except GeometryError as error:
        raise ValueError(f"{error.problem}, in {name!r}") from error


def _non_convex_part(mesh: GltfMesh, linear: Floats, offset: Floats, reason: str) -> CollisionPiece:
    return CollisionPiece(None, reason, place_surface(mesh.vertices, mesh.faces, linear, offset))


def names_of(tree: Json, node: Json) -> list[str]:
    """Return the names of a node and of its mesh, without those that are none."""
    things = [node, entry(tree, "meshes", node["mesh"])] if "mesh" in node else [node]
    return [name for thing in things if isinstance(name := thing.get("name"), str)]


def convention_of(scene: GltfScene) -> Convention:
    """Return the first convention of collision that a node of the scene keeps to."""
    physics = physics_extension_of(scene)
    if physics is not None:
        return physics
    shown = [placement.node for placement in scene.placements.values() if "mesh" in placement.node]
    names = [node.get("name") for node in shown]
    names += [entry(scene.tree, "meshes", node["mesh"]).get("name") for node in shown]
    if any(map(unreal_kind, names)):
        return "unreal"
    if any(map(godot_kind, names)):
        return "godot"
    colliding = any("mesh" in scene.placements[index].node for index in nodes_below_colliders(scene))
    return "unity" if colliding else "plain"


def nodes_below_colliders(scene: GltfScene) -> frozenset[int]:
    """Return the nodes below those whose name says, for a script in Unity, that what they hold collides."""
    found: set[int] = set()
    for index, placement in scene.placements.items():
        above = placement.parent
        if above is not None and (above in found or holds_colliders(scene.placements[above].node.get("name"))):
            found.add(index)
    return frozenset(found)


def visible_nodes(scene: GltfScene, convention: Convention) -> list[int]:
    """Return the nodes of meshes that are there to be seen; none where all meshes are taken for collision."""
    shown = [index for index, placement in scene.placements.items() if "mesh" in placement.node]
    below = nodes_below_colliders(scene) if convention == "unity" else frozenset(shown if convention == "plain" else ())
    return [
        index
        for index in shown
        if index not in below and not _is_only_collision(scene.tree, scene.placements[index].node, convention)
    ]


def _is_only_collision(tree: Json, node: Json, convention: Convention) -> bool:
    """Whether a node with a mesh collides by a name, and is not seen."""
    if convention == "unreal":
        return any(map(unreal_kind, names_of(tree, node)))
    kind = next(filter(None, map(godot_kind, names_of(tree, node))), None)
    return convention == "godot" and kind in ("colonly", "convcolonly")


def collision_name_of(scene: GltfScene, placement: Placement, convention: Convention) -> str | None:
    """Return the name of a node that collides by a convention: its own, or that of its mesh where that one counts."""
    if convention in EXTENSIONS:
        own = placement.node.get("name")
        return own if isinstance(own, str) else None
    counts = {"unreal": unreal_kind, "godot": godot_kind}.get(convention, bool)
    return next(filter(counts, names_of(scene.tree, placement.node)), None) if "mesh" in placement.node else None
