"""The collision geometry of a scene: the convention that its file keeps to, the nodes that collide by it, and their
pieces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from meshforge.common import GeometryError
from meshforge.formats.collision_pieces import CollisionPiece, leaves_volume, place_pieces, place_surface
from meshforge.formats.engine_names.conventions import godot_kind, holds_colliders, interpret_unreal_shape, unreal_kind
from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.physics import collider_of, has_collider, physics_extension_of, rigid_pose_of
from meshforge.formats.meshfile.gltf_document import entry
from meshforge.formats.meshfile.gltf_meshes import GltfMesh
from meshforge.formats.meshfile.gltf_scene import GltfScene, Placement
from meshforge.geometry import Ellipsoid, Floats, Ints, Piece, Polytope, Pose, Sphere, hull_mesh, split_pieces


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
        """All nodes with collision, in the order of the scene."""
        self.convention = convention_of(self.scene)
        below = nodes_below_colliders(self.scene)  # of Unity's nodes
        read: dict[Convention, Callable[[Placement], NodeCollision | None]] = {
            "unreal": self._read_unreal,
            "godot": self._read_godot,
            "unity": lambda placement: self._read_plain(placement) if placement.index in below else None,
            "plain": self._read_plain,
        }
        each = read.get(self.convention, self._read_physics)
        found = map(each, self.scene.placements.values())
        return [source for source in found if source is not None and source.parts]

    def _read_physics(self, placement: Placement) -> NodeCollision | None:
        if not has_collider(placement.node, self.convention):
            return None
        name = collision_name_of(self.scene, placement, self.convention)
        collider = collider_of(placement, self.convention, self.scene)
        if collider.shape is not None:
            return self._place_shape(placement, name, collider.shape)
        if not isinstance(collider.mesh, int) or collider.mesh < 0:
            return NodeCollision(placement.index, name, [CollisionPiece(None, "its collider names no mesh")])
        mesh = self.scene.mesh(collider.mesh), placement.linear, placement.offset
        if collider.convex:
            return NodeCollision(placement.index, name, [self._hull_part(*mesh)])
        return self._read_pieces(placement.index, name, collider.mesh, *mesh)

    def _place_shape(self, placement: Placement, name: str | None, found: CollisionPiece) -> NodeCollision:
        if found.shape is None:
            plane = rigid_pose_of(placement) @ found.plane if found.plane else None
            return NodeCollision(placement.index, name, [replace(found, plane=plane)])
        if isinstance(found.shape, Polytope):
            self.notes.append(f"the collider of {name or f'node {placement.index}'!r} is tapered: it is read as a hull")
        if not leaves_volume(placement.linear):
            return NodeCollision(placement.index, name, [CollisionPiece(None, "it is scaled to nothing")])
        shape = found.shape.transform(placement.linear, placement.offset)
        if isinstance(found.shape, Sphere) and not isinstance(shape, Sphere):
            egg = Ellipsoid(Pose.identity(), np.full(3, found.shape.radius))
            shape = egg.transform(placement.linear, placement.offset)
        return NodeCollision(placement.index, name, [CollisionPiece(shape)])

    def _read_unreal(self, placement: Placement) -> NodeCollision | None:
        name = collision_name_of(self.scene, placement, "unreal")
        if name is None:
            return None
        mesh = self.scene.place_mesh(placement)
        if not len(mesh[0].faces):
            return None
        part = self._hull_part(*mesh)
        if part.shape is not None:
            shape, note = interpret_unreal_shape(name, part.shape)
            self.notes += [note] if note else []
            part = replace(part, shape=shape)
        return NodeCollision(placement.index, name, [part])

    def _read_godot(self, placement: Placement) -> NodeCollision | None:
        name = collision_name_of(self.scene, placement, "godot")
        kind = godot_kind(name)
        if kind is None:
            return None
        mesh = self.scene.place_mesh(placement)
        if kind in ("convcol", "convcolonly") and len(mesh[0].faces):
            return NodeCollision(placement.index, name, [self._hull_part(*mesh)])
        return self._read_pieces(placement.index, name, placement.node["mesh"], *mesh)

    def _read_plain(self, placement: Placement) -> NodeCollision | None:
        if "mesh" not in placement.node:
            return None
        name = collision_name_of(self.scene, placement, "plain")
        return self._read_pieces(placement.index, name, placement.node["mesh"], *self.scene.place_mesh(placement))

    def _read_pieces(
        self, node: int, name: str | None, index: int, mesh: GltfMesh, linear: Floats, offset: Floats
    ) -> NodeCollision:
        if not len(mesh.faces):
            return NodeCollision(node, name, [])
        if not leaves_volume(linear):
            return NodeCollision(node, name, [_non_convex_part(mesh, linear, offset, "it is scaled to nothing")])
        found = self._pieces_of(index, mesh, name or f"node {node}")
        owner = np.zeros(len(mesh.faces), dtype=np.int64)
        for k, piece in enumerate(found):
            owner[piece.face_indices] = k
        return NodeCollision(node, name, place_pieces(found, linear, offset), owner)

    def _pieces_of(self, index: int, mesh: GltfMesh, name: str) -> list[Piece]:
        """The pieces of a mesh; those of a mesh that several nodes show are found once, a skinned one's each time."""
        if mesh is not self.scene.mesh(index):
            return _split_mesh(mesh, name)
        if index not in self._pieces:
            self._pieces[index] = _split_mesh(mesh, name)
        return self._pieces[index]

    def _hull_part(self, mesh: GltfMesh, linear: Floats, offset: Floats) -> CollisionPiece:
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


def convention_of(scene: GltfScene) -> Convention:
    """The first convention of collision that a node of the scene keeps to."""
    physics = physics_extension_of(scene)
    if physics is not None:
        return physics
    shown = [placement.node for placement in scene.placements.values() if "mesh" in placement.node]
    names = [node.get("name") for node in shown]
    names += [entry(scene.tree, "meshes", node["mesh"]).get("name") for node in shown]
    if any(unreal_kind(name) for name in names):
        return "unreal"
    if any(godot_kind(name) for name in names):
        return "godot"
    colliding = any("mesh" in scene.placements[index].node for index in nodes_below_colliders(scene))
    return "unity" if colliding else "plain"


def nodes_below_colliders(scene: GltfScene) -> frozenset[int]:
    """The nodes below those whose name says, for a script in Unity, that what they hold collides."""
    found: set[int] = set()
    for index, placement in scene.placements.items():
        above = placement.parent
        if above is not None and (above in found or holds_colliders(scene.placements[above].node.get("name"))):
            found.add(index)
    return frozenset(found)


def collision_name_of(scene: GltfScene, placement: Placement, convention: Convention) -> str | None:
    """The name of a node that is collision by a convention: its own, or that of its mesh where that one counts."""
    own = placement.node.get("name")
    if convention not in ("unreal", "godot", "unity", "plain"):
        return own if isinstance(own, str) else None
    if "mesh" not in placement.node:
        return None
    names = [own, entry(scene.tree, "meshes", placement.node["mesh"]).get("name")]
    counts = {"unreal": unreal_kind, "godot": godot_kind}.get(convention, bool)
    return next((name for name in names if isinstance(name, str) and counts(name)), None)
