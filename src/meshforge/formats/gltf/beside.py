"""Hulls written beside an unmarked scene: all of the scene stays as it is, and new nodes collide, by an extension or by
the names of an engine."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import count
from pathlib import PurePosixPath

import numpy as np

from meshforge.common import join_names
from meshforge.formats.base import Loss, Output, no_hulls_error, note_renames
from meshforge.formats.collision_pieces import names_to_keep, refuse_changed_files
from meshforge.formats.engine_names.conventions import CollisionNames
from meshforge.formats.gltf.document import Convention, GltfDocument, NodeRecord
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.edit import assign_names, note_lacking_shapes, style_of
from meshforge.formats.gltf.edit_physics import PhysicsStyle, pose_keys, write_mesh_geometry
from meshforge.formats.gltf.output import pack_scene, prepare_base
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, report_damage
from meshforge.formats.meshfile.gltf_meshes import DRACO
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.geometry import Floats, Ints, Pose
from meshforge.symbolic import Asset, FeatureKind, Geom, Opaque

_EVEN = 1e-9  # by which the stretches of a map may differ where it scales evenly
_SAME = 1e-12  # by which a stretch may differ from one where it is none


@dataclass(frozen=True, eq=False, slots=True)
class _Piece:
    """What collides: a hull or a non-convex piece; own: its name without the body; body: the node of that.

    element: the node that it comes from; part: which piece of that node's mesh it is, None where an edit made it.
    """

    what: Geom | Opaque
    own: str
    body: int | None
    element: NodeRecord | None
    part: int | None


def write_gltf_beside(asset: Asset, document: GltfDocument, name: str, engine: CollisionNames | None) -> Output:
    """The files of a scene with the hulls of an asset beside it, as colliders of KHR_physics_rigid_bodies.

    engine: by whose names they collide instead. Raises AssetError: a buffer changed since the asset was read, or there
    is no hull to write.
    """
    convention: Convention = engine.engine if engine else "khr"
    with report_damage(str(asset.path)):
        scene = GltfScene.of(document.source, asset.path)
        refuse_changed_files(document.digests, str(asset.path), "the buffer ")
        base = prepare_base(document.source, scene, name)
        draft = SceneDraft(scene, copy.deepcopy(base.tree), base.before)
        writer = _EngineWriter(draft, engine, PurePosixPath(name).stem) if engine else _ColliderWriter(draft)
        for piece in _list_pieces(asset, document):
            writer.add(piece)
        if not draft.expected:
            raise no_hulls_error(asset)
        marked = GltfDocument(b"", convention, (), document.bodies)
        names = assign_names(draft, marked, renames=engine is None)
        output = pack_scene(base, scene, draft.geometry, name)
    hulls = {geom.name for geom in asset.geoms}
    renamed = {old: now for old, now in names.items() if old in hulls}
    notes = [
        *note_lacking_shapes(style_of(convention, draft), asset.geoms),
        *(() if engine else note_renames(renamed)),
        *writer.notes,
    ]
    return replace(output, notes=tuple(notes), names=renamed, lost=tuple(writer.lost))


def _list_pieces(asset: Asset, document: GltfDocument) -> Iterator[_Piece]:
    """All that collides, hulls first, with where it comes from."""
    nodes, kept = {name: node for node, name in document.bodies}, names_to_keep(asset)
    sources = {name: (element, k) for element in document.authored for k, name in enumerate(element.names)}
    pieces: list[Geom | Opaque] = [*asset.geoms, *asset.opaque]
    for what in pieces:
        stays = what.name in sources and what.name in kept
        origin = what.name if stays else what.parent if isinstance(what, Geom) else None
        element, part = sources.get(origin or "", (None, None))
        if element is not None and element.body != what.body:
            element = None
        own = what.name.removeprefix(f"{what.body}/") if document.bodies else what.name
        yield _Piece(what, own, nodes.get(what.body), element, part if stays else None)


def _holder_of(draft: SceneDraft, piece: _Piece) -> int | None:
    """The node that a piece moves with: an animated one at or above where it comes from, else its body, else None."""
    at = piece.element.node if piece.element else None
    while at is not None and at != piece.body:
        if at in draft.referred.animated and draft.keeps_volume(at):
            return at
        at = draft.scene.placements[at].parent
    return piece.body


class _Writer(ABC):
    """Adds pieces to a scene; lost: what its way to mark collision cannot say; notes: for people."""

    def __init__(self, draft: SceneDraft) -> None:
        self.draft = draft
        self.lost: list[Loss] = []

    @property
    def notes(self) -> list[str]:
        return []

    @abstractmethod
    def add(self, piece: _Piece) -> None:
        """Add a piece, below the node that it moves with."""


class _BesideStyle(PhysicsStyle):
    """Colliders that are below what they move with; holding: the node for the next one."""

    holding: int | None = None

    def holder(self, body: int | None, parent: NodeRecord | None) -> int | None:
        return self.holding


class _ColliderWriter(_Writer):
    """Marks collision by KHR_physics_rigid_bodies."""

    def __init__(self, draft: SceneDraft) -> None:
        super().__init__(draft)
        self.style = _BesideStyle(draft, "khr")

    def add(self, piece: _Piece) -> None:
        what, holder = piece.what, _holder_of(self.draft, piece)
        self.style.holding = holder
        if self._add_as_authored(piece, holder):
            return
        if isinstance(what, Geom):
            self.style.add_hull(what, piece.own, piece.body, None)
        elif what.surface is not None and len(what.surface.faces):
            self.style.add_opaque(what, what.surface, piece.own, holder)

    def _add_as_authored(self, piece: _Piece, holder: int | None) -> bool:
        """Collide with the vertices of the scene themselves, where no skin moves them and no map shears them."""
        draft, element = self.draft, piece.element
        if element is None or element.owner is None or piece.part is None:
            return False
        source = draft.scene.placements[element.node]
        place = _even_place(draft, element.node, holder)
        if place is None or "skin" in source.node:
            return False
        whole = draft.extract_pieces(source.node["mesh"], element.owner, [piece.part])
        mesh = draft.add_mesh({"name": piece.own, "primitives": [_strip_look(part) for part in whole["primitives"]]})
        hulled = isinstance(piece.what, Geom)
        geometry = write_mesh_geometry(draft, "khr", mesh, None, hulled=hulled, like={})
        self.style.add_collider({"name": piece.own, **place}, holder, geometry, piece.what.name)
        return True


def _even_place(draft: SceneDraft, node: int, holder: int | None) -> Json | None:
    """The place of a node below another one, as a node has it; None where that mirrors, shears or stretches."""
    matrix = _matrix_below(draft, node, holder)
    linear = matrix[:3, :3]
    stretch = np.linalg.svd(linear, compute_uv=False)
    if np.linalg.det(linear) <= 0 or np.ptp(stretch) > _EVEN * stretch[0]:
        return None
    scale = float(stretch.mean())
    place = pose_keys(Pose(linear / scale, matrix[:3, 3]))
    return place if abs(scale - 1) <= _SAME else {**place, "scale": [scale] * 3}


def _matrix_below(draft: SceneDraft, node: int, holder: int | None) -> Floats:
    """The place (4, 4) of a node in the space of another one, of the root frame for None."""
    world = draft.scene.placements[node].world
    return world if holder is None else np.asarray(np.linalg.solve(draft.scene.placements[holder].world, world))


def _strip_look(part: Json) -> Json:
    """A primitive without what only matters to the eye; one that Draco compressed keeps its attributes."""
    kept: Json = {key: part[key] for key in ("attributes", "indices", "mode") if key in part}
    packed = part.get("extensions", {}).get(DRACO)
    if packed is not None:
        return {**kept, "extensions": {DRACO: packed}}
    return {**kept, "attributes": {"POSITION": part["attributes"]["POSITION"]}}


class _EngineWriter(_Writer):
    """Marks collision by the names of an engine; stem: of the file."""

    def __init__(self, draft: SceneDraft, engine: CollisionNames, stem: str) -> None:
        super().__init__(draft)
        self.engine, self.stem = engine, stem
        tree = draft.scene.tree
        self.seen = {_name_of(thing).lower() for key in ("nodes", "meshes") for thing in entries(tree, key)}
        self.taken = set(self.seen)
        self.number: Counter[str] = Counter()
        self.holders: dict[int | None, int] = {}
        self.stood_for: dict[str, set[int]] = {}

    @property
    def notes(self) -> list[str]:
        """The meshes that the engine cannot tell apart, where it goes by their names."""
        if self.engine.centred:
            return []
        many = [name or "without a name" for name, nodes in self.stood_for.items() if len(nodes) > 1 or not name]
        what = f"{self.engine.title} finds the mesh of a hull by its name"
        return [f"{what}: rename those that have none, or share one ({join_names(many, 3)})"] if many else []

    def add(self, piece: _Piece) -> None:
        what, draft = piece.what, self.draft
        if isinstance(what, Opaque):
            self._add_opaque(piece, what)
            return
        holder, space = self._places(piece)
        hull = draft.shape_in(what.shape.tessellate(), space)
        self._add_node(self._hull_name(piece, what), hull.vertices, hull.faces, holder, space, what.name)

    def _add_opaque(self, piece: _Piece, what: Opaque) -> None:
        if not self.engine.takes_opaque:
            why = f"{self.engine.title} makes one hull of any mesh that collides; meshforge prepare makes better ones"
            self.lost.append(Loss(FeatureKind.OPAQUE, (what.name,), why, "written to be seen alone"))
        elif what.surface is not None and len(what.surface.faces):
            holder, space = self._places(piece)
            points = self.draft.points_in(np.asarray(what.surface.vertices), space)
            name = self._claim(self.engine.opaque(own) for own in _number_names(piece.own))
            self._add_node(name, points, what.surface.faces, holder, space, what.name)

    def _places(self, piece: _Piece) -> tuple[int | None, int | None]:
        """The node below which a piece goes, and the one in whose space its mesh is.

        Unreal takes no notice of where a collision node is, so there that is the space of the mesh that is seen.
        """
        moved = _holder_of(self.draft, piece)
        element = piece.element
        if self.engine.centred or element is None or not self.draft.keeps_volume(element.node):
            return self._holder_below(moved), moved
        skinned = "skin" in self.draft.scene.placements[element.node].node
        return self._holder_below(moved), moved if skinned else element.node

    def _holder_below(self, node: int | None) -> int | None:
        """The node for what collides below another one, which is made where the engine wants one."""
        base = self.stem if node is None else _name_of(self.draft.node(node)) or self.stem
        if self.engine.holder(base) is None:
            return node
        if node not in self.holders:
            wanted = (self.engine.holder(self.engine.body(own)) or "" for own in _number_names(base))
            self.holders[node] = self.draft.add_node({"name": self._claim(wanted)}, node)
        return self.holders[node]

    def _hull_name(self, piece: _Piece, geom: Geom) -> str:
        """The name of a hull: of the mesh that it stands for, where the engine goes by that."""
        base, engine = self._mesh_seen(piece), self.engine
        if engine.centred:
            return self._claim(engine.hull(base, geom, 0, own) for own in _number_names(piece.own))
        start = self.number[base]
        self.number[base] += 1
        names = (engine.hull(base, geom, number, piece.own) for number in count(start))
        return self._claim(name for name in names if name.partition("_")[2].lower() not in self.seen)

    def _mesh_seen(self, piece: _Piece) -> str:
        if piece.element is None:
            return self.engine.body(self.stem)
        node, tree = self.draft.scene.placements[piece.element.node].node, self.draft.scene.tree
        name = _name_of(entry(tree, "meshes", node["mesh"])) or _name_of(node)
        self.stood_for.setdefault(name, set()).add(piece.element.node)
        return name or self.engine.body(self.stem)

    def _claim(self, names: Iterator[str]) -> str:
        name = next(name for name in names if name.lower() not in self.taken)
        self.taken.add(name.lower())
        return name

    def _add_node(
        self, name: str, points: Floats, faces: Ints, holder: int | None, space: int | None, piece: str
    ) -> None:
        """Add a node with a mesh of points (n, 3) in the space of a node; piece: the name that it has in the asset."""
        draft, place = self.draft, Json()
        if self.engine.centred:
            middle = (points.min(axis=0) + points.max(axis=0)) / 2
            points, place = points - middle, {"translation": middle.tolist()}
        elif space is not None and space != holder:
            matrix = _matrix_below(draft, space, holder)
            place = {} if np.array_equal(matrix, np.eye(4)) else {"matrix": matrix.T.ravel().tolist()}
        mesh = draft.add_mesh({"name": name, "primitives": [draft.build_primitive(points, faces)]})
        draft.expected[draft.add_node({"name": name, "mesh": mesh, **place}, holder)] = (piece,)


def _number_names(name: str) -> Iterator[str]:
    """A name, and then it with a number behind, in order."""
    yield name
    yield from (f"{name}-{number}" for number in count(2))


def _name_of(thing: Json) -> str:
    name = thing.get("name")
    return name if isinstance(name, str) else ""
