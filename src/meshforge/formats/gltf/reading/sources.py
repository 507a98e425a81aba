"""The collision geometry of a scene: the nodes that have it, by the first convention that the file keeps to."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from meshforge.errors import GeometryError
from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.reading.bodies import rigid
from meshforge.formats.gltf.reading.conventions import below_colliders, convention_of, source_name
from meshforge.formats.gltf.reading.physics import collider_of, has_collider
from meshforge.formats.gltf.reading.shapes import Z_TO_Y, Described
from meshforge.formats.mesh_parts import MeshPart, mesh_parts, placed
from meshforge.formats.meshfile import RawSurface, joined
from meshforge.formats.meshfile.gltf import Placement, Scene, Triangles
from meshforge.formats.meshfile.gltf.instances import NAME as INSTANCING
from meshforge.formats.meshfile.gltf.instances import is_instanced, repeated
from meshforge.formats.naming.marks import godot_kind
from meshforge.formats.naming.unreal_shapes import unreal_shape
from meshforge.geometry import Ellipsoid, Floats, Ints, Piece, Pose, Sphere, convex_hull, pieces

_LEAST = 1e-12  # of the largest stretch of a map; below, it is a projection


@dataclass(frozen=True, eq=False, slots=True)
class Source:
    """A node with collision: its name, and its pieces in the root frame.

    owner: see `Authored`; plane: root_T_plane of one that is an endless plane, whose normal is Z.
    """

    node: int
    name: str | None
    parts: Sequence[MeshPart]
    owner: Ints | None = None
    plane: Pose | None = None


@dataclass(slots=True)
class Reader:
    """Reads the collision of one scene; notes: what a user should know of how."""

    scene: Scene
    convention: Convention = "plain"
    notes: list[str] = field(default_factory=list)
    _pieces: dict[int, list[Piece]] = field(default_factory=dict)
    _colliding: frozenset[int] = frozenset()  # in files for Unity

    def read(self) -> list[Source]:
        """All nodes with collision, in the order of the scene."""
        self.convention = convention_of(self.scene)
        self._colliding = below_colliders(self.scene)
        read: dict[Convention, Callable[[Placement], Source | None]] = {
            "unreal": self._read_unreal,
            "godot": self._read_godot,
            "unity": self._read_unity,
            "plain": self._read_plain,
        }
        each = read.get(self.convention, self._read_physics)
        found = [
            self._read_instances(placement, each) if is_instanced(placement.node) else each(placement)
            for placement in self.scene.placements.values()
        ]
        return [source for source in found if source is not None and source.parts]

    def _read_instances(self, placement: Placement, each: Callable[[Placement], Source | None]) -> Source | None:
        """A node that stands for many: one piece, of all instances of what it collides with."""
        extensions = {name: own for name, own in placement.node["extensions"].items() if name != INSTANCING}
        alone = {key: value for key, value in placement.node.items() if key != "skin"} | {"extensions": extensions}
        one = each(replace(placement, node=alone, world=np.eye(4)))
        if one is None or not one.parts:
            return None
        reason = f"many at once by {INSTANCING}, which is not edited"
        shown = [surface for part in one.parts if (surface := part.shape or part.surface)]
        if not shown:
            return Source(placement.index, one.name, [MeshPart(None, reason)])
        whole = joined([RawSurface(None, np.asarray(s.vertices), s.faces) for s in shown])
        many = repeated(whole.vertices, whole.faces, self.scene.instances(placement))
        surface = placed(*many, placement.linear, placement.offset)
        return Source(placement.index, one.name, [MeshPart(None, reason, surface)])

    def _read_physics(self, placement: Placement) -> Source | None:
        if not has_collider(placement.node, self.convention, self.scene.tree):
            return None
        name, collider = (
            source_name(self.scene, placement, self.convention),
            collider_of(placement, self.convention, self.scene),
        )
        if collider.shape is not None:
            return self._place_shape(placement, name, collider.shape)
        if not isinstance(collider.mesh, int) or collider.mesh < 0:
            return Source(placement.index, name, [MeshPart(None, "its collider names no mesh")])
        mesh = self.scene.mesh(collider.mesh), placement.linear, placement.offset
        if collider.convex:
            return Source(placement.index, name, [self._hull_part(*mesh)])
        return self._read_pieces(placement.index, name, collider.mesh, *mesh)

    def _place_shape(self, placement: Placement, name: str | None, found: Described) -> Source:
        """A shape of an extension, in its place."""
        if found.shape is None:
            plane = rigid(placement) @ Z_TO_Y if found.is_plane else None
            return Source(placement.index, name, [MeshPart(None, found.reason)], plane=plane)
        if found.taper:
            self.notes.append(f"the collider of {name or f'node {placement.index}'!r} is tapered: it is read as a hull")
        if _flattens(placement.linear):
            return Source(placement.index, name, [MeshPart(None, "it is scaled to nothing")])
        shape = found.shape.transform(placement.linear, placement.offset)
        if isinstance(found.shape, Sphere) and not isinstance(shape, Sphere):
            egg = Ellipsoid(Pose.identity(), np.full(3, found.shape.radius))
            shape = egg.transform(placement.linear, placement.offset)
        return Source(placement.index, name, [MeshPart(shape)])

    def _read_unreal(self, placement: Placement) -> Source | None:
        name = source_name(self.scene, placement, "unreal")
        if name is None:
            return None
        mesh = self.scene.place_mesh(placement)
        if not len(mesh[0].faces):
            return None
        part = self._hull_part(*mesh)
        if part.shape is not None:
            shape, note = unreal_shape(name, part.shape)
            self.notes += [note] if note else []
            part = MeshPart(shape)
        return Source(placement.index, name, [part])

    def _read_godot(self, placement: Placement) -> Source | None:
        name = source_name(self.scene, placement, "godot")
        kind = godot_kind(name)
        if kind is None:
            return None
        mesh = self.scene.place_mesh(placement)
        if kind in ("convcol", "convcolonly") and len(mesh[0].faces):
            return Source(placement.index, name, [self._hull_part(*mesh)])
        return self._read_pieces(placement.index, name, placement.node["mesh"], *mesh)

    def _read_plain(self, placement: Placement) -> Source | None:
        if "mesh" not in placement.node:
            return None
        name = source_name(self.scene, placement, "plain")
        return self._read_pieces(placement.index, name, placement.node["mesh"], *self.scene.place_mesh(placement))

    def _read_unity(self, placement: Placement) -> Source | None:
        return self._read_plain(placement) if placement.index in self._colliding else None

    def _read_pieces(
        self, node: int, name: str | None, index: int, mesh: Triangles, linear: Floats, offset: Floats
    ) -> Source:
        """A mesh as its connected pieces."""
        if not len(mesh.faces):
            return Source(node, name, [])
        if _flattens(linear):
            return Source(node, name, [_opaque(mesh, linear, offset, "it is scaled to nothing")])
        found = self._pieces_of(index, mesh, name or f"node {node}")
        owner = np.zeros(len(mesh.faces), dtype=np.int64)
        for k, piece in enumerate(found):
            owner[piece.face_indices] = k
        return Source(node, name, mesh_parts(found, linear, offset), owner)

    def _pieces_of(self, index: int, mesh: Triangles, name: str) -> list[Piece]:
        """The pieces of a mesh; those of a mesh that several nodes show are found once, a skinned one's each time."""
        if mesh is not self.scene.mesh(index):
            return _taken_apart(mesh, name)
        if index not in self._pieces:
            self._pieces[index] = _taken_apart(mesh, name)
        return self._pieces[index]

    def _hull_part(self, mesh: Triangles, linear: Floats, offset: Floats) -> MeshPart:
        """A whole mesh as one hull, as engines take it."""
        if not len(mesh.faces):
            return MeshPart(None, "the mesh holds no triangles")
        if _flattens(linear):
            return _opaque(mesh, linear, offset, "it is scaled to nothing")
        points = mesh.vertices[np.unique(mesh.faces)]
        try:
            return MeshPart(convex_hull(points).transform(linear, offset))
        except GeometryError:
            return _opaque(mesh, linear, offset, "flat")


def _taken_apart(mesh: Triangles, name: str) -> list[Piece]:
    try:
        return pieces(mesh.vertices, mesh.faces, name=name)
    except GeometryError as error:
        raise ValueError(f"{error.problem}, in {name!r}") from error


def _flattens(linear: Floats) -> bool:
    """Whether a map (3, 3) leaves no volume."""
    stretch = np.linalg.svd(linear, compute_uv=False)
    return bool(stretch[-1] <= _LEAST * stretch[0])


def _opaque(mesh: Triangles, linear: Floats, offset: Floats, reason: str) -> MeshPart:
    return MeshPart(None, reason, placed(mesh.vertices, mesh.faces, linear, offset))
