"""How hulls are written where meshes are collision: all of them, or those that Unreal, Godot or Unity know by name;
into a scene that has some, beside what an unmarked one shows, and into a new one."""

import copy
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.common import join_names
from meshforge.formats import engine_names
from meshforge.formats.gltf.colliders import names_of, nodes_below_colliders
from meshforge.formats.gltf.document import NodeRecord
from meshforge.formats.gltf.draft import SceneDraft, name_of
from meshforge.formats.kinematic_tree import claim_name
from meshforge.formats.meshfile.gltf_document import Json, entries, entry
from meshforge.geometry import Floats
from meshforge.symbolic import Geom, NonConvexPiece

_FAR = 1e4  # sizes of a mesh away from its node, beyond which single precision would spoil it


@dataclass(frozen=True, eq=False, slots=True)
class NewPiece:
    """A hull or a non-convex piece that is to collide; own: its name without the body.

    holder: the node below which it goes, None for the root of the scene; source: the node that it comes from or takes
    after; part: which piece of the mesh of that node it is, None where an edit made it.
    """

    what: Geom | NonConvexPiece
    own: str
    holder: int | None
    source: NodeRecord | None = None
    part: int | None = None


class Style(ABC):
    """Writes into one draft.

    renames: whether a node may be given the name that its hull should have; holds: the shapes that come back as they
    are, or, as a box does in a mesh, just as exactly; lacks: why others do not.
    """

    renames = False
    holds: tuple[str, ...] = ("polytope", "box")
    lacks = "meshes have no"

    def __init__(self, draft: SceneDraft) -> None:
        self.draft = draft

    @property
    def notes(self) -> list[str]:
        """What a user should know of what was added."""
        return []

    @abstractmethod
    def remove(self, element: NodeRecord) -> None:
        """Take the collision of a node away, all else of it stays."""

    @abstractmethod
    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """Leave some pieces of a node only."""

    @abstractmethod
    def add(self, piece: NewPiece) -> None:
        """Add a hull or a non-convex piece that has triangles."""


class PlainStyle(Style):
    """A hull is a node with a mesh, and is seen.

    stem: of the file, after which a body without a name is called; taken: names of nodes and meshes, lower case;
    centred: whether the mesh of a hull lies about its own middle, so that single precision is fine.
    """

    renames = True
    centred = True

    def __init__(self, draft: SceneDraft, stem: str) -> None:
        super().__init__(draft)
        self.stem = stem
        self.taken = {name_of(thing).lower() for key in ("nodes", "meshes") for thing in entries(draft.tree, key)}

    def remove(self, element: NodeRecord) -> None:
        self.draft.empty_node(element.node)

    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """Keep the pieces in the node where they keep their names; else put each into a node of its own below it."""
        if len(kept) > 1 and list(kept) == list(range(len(kept))):
            self.keep_in_mesh(element, kept)
            return
        draft, node = self.draft, self.draft.node(element.node)
        mesh = node["mesh"]
        if engine_names.holds_colliders(node.get("name")):  # else what lies below would be all that collides
            node["name"] += "_"
        gone = draft.remove_mesh(element.node)
        for at, k in enumerate(kept):  # ahead of other children
            part = draft.add_mesh(draft.extract_pieces(mesh, element.owner, [k]), mesh)
            child = draft.add_node({"name": element.names[k], **gone, "mesh": part}, element.node, at)
            draft.expected[child] = (element.names[k],)

    def keep_in_mesh(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """Leave some pieces in the mesh of a node."""
        draft, node = self.draft, self.draft.node(element.node)
        part = draft.extract_pieces(node["mesh"], element.owner, kept, strokes=True)
        node["mesh"] = draft.add_mesh(part, node["mesh"])
        draft.expected[element.node] = tuple(element.names[k] for k in kept)

    def add(self, piece: NewPiece) -> None:
        draft, space = self.draft, self.space_of(piece)
        points, faces = draft.triangles_in(piece.what, space)
        middle, reach = (points.min(axis=0) + points.max(axis=0)) / 2, np.ptp(points, axis=0).max()
        if not self.centred and np.abs(middle).max() < _FAR * reach:
            middle = np.zeros(3)
        name, primitive = self.name_piece(piece), draft.build_primitive(points - middle, faces, self.material_of(piece))
        mesh = draft.add_mesh({"name": name, "primitives": [primitive]})
        node = {"name": name, "mesh": mesh, **self._place_of(space, piece.holder, middle)}
        draft.expected[draft.add_node(node, self.holder_of(piece))] = (piece.what.name,)

    def holder_of(self, piece: NewPiece) -> int | None:
        """Return the node below which the node of a piece goes."""
        return piece.holder

    def space_of(self, piece: NewPiece) -> int | None:
        """Return the node in whose space the mesh of a piece is."""
        return piece.holder

    def name_piece(self, piece: NewPiece) -> str:
        """Return the name of the node and the mesh of a piece."""
        return piece.own

    def material_of(self, piece: NewPiece) -> int | None:
        """Return the material of the mesh that a piece takes after; None for one that needs texture coordinates."""
        tree, source = self.draft.scene.tree, piece.source and self.draft.scene.placements[piece.source.node].node
        if not source or "mesh" not in source:
            return None
        parts = entries(entry(tree, "meshes", source["mesh"]), "primitives")
        found = next((part["material"] for part in parts if "material" in part), None)
        return None if found is None or "Texture" in str(entry(tree, "materials", found)) else int(found)

    def _place_of(self, space: int | None, holder: int | None, middle: Floats) -> Json:
        """Where a node is whose mesh is about a middle (3,) in the space of another node than its holder."""
        if space == holder:
            return {"translation": middle.tolist()} if middle.any() else {}
        matrix = self.draft.matrix_below(space, holder)
        matrix = np.column_stack([matrix[:, :3], matrix @ [*middle, 1.0]])
        return {} if np.array_equal(matrix, np.eye(4)) else {"matrix": matrix.T.ravel().tolist()}


class EngineStyle(PlainStyle):
    """A hull is a node with a mesh, by whose name, or that of a node above it, an engine takes it for collision."""

    names: engine_names.CollisionNames

    def name_piece(self, piece: NewPiece) -> str:
        """Return a name that nothing else in the file has."""
        is_hull = isinstance(piece.what, Geom)
        named = self.names.hull if is_hull else self.names.non_convex
        return claim_name(piece.own, self.taken, named, str.lower, "-")

    def material_of(self, piece: NewPiece) -> int | None:
        return None


class UnityStyle(EngineStyle):
    """A hull is below a node called `table_colliders`."""

    names: engine_names.UnityNames = engine_names.UnityNames()

    def __init__(self, draft: SceneDraft, stem: str) -> None:
        super().__init__(draft, stem)
        self.colliding, self.holders = nodes_below_colliders(draft.scene), dict[int | None, int]()

    def holder_of(self, piece: NewPiece) -> int | None:
        node, names = piece.holder, self.names
        above = "" if node is None else name_of(self.draft.node(node))
        if node in self.colliding or engine_names.holds_colliders(above):
            return node
        if node not in self.holders:
            name = claim_name(
                above or self.stem, self.taken, lambda own: names.body(own) + engine_names.COLLIDERS, str.lower, "-"
            )
            self.holders[node] = self.draft.add_node({"name": name}, node)
        return self.holders[node]


class GodotStyle(EngineStyle):
    """A hull is called `table-convcolonly`; `-col` and `-convcol` nodes are seen as well."""

    renames = False
    names = engine_names.GodotNames()

    def remove(self, element: NodeRecord) -> None:
        if self._is_visible(element):
            self._strip_suffix(element)
        else:
            self.draft.empty_node(element.node)

    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """Keep the pieces that are left in one mesh; where the whole is seen, they get a node of their own."""
        if not self._is_visible(element):
            self.keep_in_mesh(element, kept)
            return
        draft, node = self.draft, self.draft.node(element.node)
        mesh, name = node["mesh"], f"{self._strip_suffix(element)}-colonly"
        part = draft.add_mesh({**draft.extract_pieces(mesh, element.owner, kept), "name": name})
        child = draft.add_node({"name": name, "mesh": part}, element.node)
        draft.expected[child] = tuple(element.names[k] for k in kept)

    def _is_visible(self, element: NodeRecord) -> bool:
        names = names_of(self.draft.scene.tree, self.draft.scene.placements[element.node].node)
        return next(filter(None, map(engine_names.godot_kind, names)), None) in ("col", "convcol")

    def _strip_suffix(self, element: NodeRecord) -> str:
        """Take the suffix from the name of a node, or of its mesh; the name without it."""
        node = self.draft.node(element.node)
        if engine_names.godot_kind(node.get("name")):
            node["name"] = engine_names.strip_godot_suffix(node["name"])
        mesh = entry(self.draft.tree, "meshes", node["mesh"])
        if engine_names.godot_kind(mesh.get("name")):
            renamed = {**copy.deepcopy(mesh), "name": engine_names.strip_godot_suffix(mesh["name"])}
            node["mesh"] = self.draft.add_mesh(renamed, node["mesh"])
        return next(filter(None, names_of(self.draft.tree, node)), "collision")


class UnrealStyle(EngineStyle):
    """A hull is called after the mesh it stands for: `UCX_table_02`; Unreal takes no notice of where its node is."""

    renames = False
    centred = False  # its older importers take no notice of where a collision node is
    holds = ("polytope", *engine_names.NATIVE_SHAPES)
    lacks = "Unreal has no"
    names = engine_names.UnrealNames()

    def __init__(self, draft: SceneDraft, stem: str) -> None:
        super().__init__(draft, stem)
        shown = [name_of(node) for node in entries(draft.tree, "nodes") if "mesh" in node]
        self.rendered = [name for name in shown if name and not engine_names.unreal_kind(name)]
        self.seen = {name for name in self.taken if not engine_names.unreal_kind(name)}
        self.numbers = dict[str, Iterator[int]]()
        self.stood_for = dict[str, set[int]]()

    @property
    def notes(self) -> list[str]:
        many = [name or "without a name" for name, nodes in self.stood_for.items() if len(nodes) > 1 or not name]
        what = "Unreal finds the mesh of a hull by its name"
        return [f"{what}: rename those that have none, or share one ({join_names(many, 3)})"] if many else []

    def space_of(self, piece: NewPiece) -> int | None:
        """Return the space of the mesh that it stands for."""
        if piece.source is None or not self.draft.keeps_volume(piece.source.node):
            return piece.holder
        return piece.source.node

    def name_piece(self, piece: NewPiece) -> str:
        assert isinstance(piece.what, Geom)  # Unreal takes no others
        base = self._mesh_seen(piece)
        if base not in self.numbers:
            self.numbers[base] = engine_names.number_hulls(base, self.taken)
        names = (engine_names.unreal_hull(base, piece.what, number) for number in self.numbers[base])
        name = next(n for n in names if n.lower() not in self.taken and n.partition("_")[2].lower() not in self.seen)
        self.taken.add(name.lower())
        return name

    def _mesh_seen(self, piece: NewPiece) -> str:
        if piece.source is None:
            holder = {} if piece.holder is None else self.draft.node(piece.holder)
            others = self.names.body(self.stem), *self.rendered[:1]
            return name_of(holder) if "mesh" in holder else others[-1]
        own = names_of(self.draft.scene.tree, self.draft.scene.placements[piece.source.node].node)
        if mark := next(filter(engine_names.unreal_kind, reversed(own)), ""):
            return engine_names.visible_mesh_of(mark, self.rendered)
        name = next(filter(None, reversed(own)), "")  # that of the mesh, if it has one
        self.stood_for.setdefault(name, set()).add(piece.source.node)
        return name or self.names.body(self.stem)
