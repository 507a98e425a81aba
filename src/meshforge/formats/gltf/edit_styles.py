"""How an edit is written where meshes are collision: all of them, or those that Unreal, Godot or Unity know by name."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from meshforge.formats.engine_names import conventions
from meshforge.formats.gltf.colliders import nodes_below_colliders
from meshforge.formats.gltf.document import NodeRecord
from meshforge.formats.gltf.draft import SceneDraft, material_without_texture
from meshforge.formats.meshfile.gltf_document import entries, entry
from meshforge.geometry import Floats
from meshforge.symbolic import Geom, Opaque, Surface


class EditStyle(ABC):
    """Edits one draft.

    renames: whether a node may be given the name that its hull should have; holds: the shapes that come back as they
    are, or, as a box does in a mesh, just as exactly; lacks: why others do not.
    """

    renames = False
    holds: tuple[str, ...] = ("polytope", "box")
    lacks = "meshes have no"

    def __init__(self, draft: SceneDraft) -> None:
        self.draft = draft

    @abstractmethod
    def remove(self, element: NodeRecord) -> None:
        """Take the collision of a node away, all else of it stays."""

    @abstractmethod
    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """Leave some pieces of a node only."""

    @abstractmethod
    def add_hull(self, geom: Geom, own: str, body: int | None, parent: NodeRecord | None) -> None:
        """Add a hull; own: its name without the body; body: the node of that; parent: the node it comes after."""

    def holder(self, body: int | None, parent: NodeRecord | None) -> int | None:
        """The node below which a new hull goes."""
        return self.draft.holder_of(body, parent.node if parent else None)

    def add_mesh_node(self, name: str, mesh: tuple[int, Floats], holder: int | None, piece: str) -> None:
        """Add a node that collides with a mesh, at its middle (3,); piece: the name of the hull or non-convex piece."""
        node = {"name": name, "mesh": mesh[0], "translation": mesh[1].tolist()}
        self.draft.expected[self.draft.add_node(node, holder)] = (piece,)

    def split_node(self, element: NodeRecord, kept: Sequence[int], mesh: int, own: Sequence[str]) -> list[int]:
        """Give a node that lost its mesh a child for each kept piece of that, ahead of others; own: their names."""
        draft, gone = self.draft, self.draft.remove_mesh(element.node)
        assert element.owner is not None  # only meshes have several pieces
        made: list[int] = []
        for k, name in zip(kept, own, strict=True):
            part = draft.add_mesh(draft.extract_pieces(mesh, element.owner, [k]), mesh)
            made.append(draft.add_node({"name": name, **gone, "mesh": part}, element.node, at=len(made)))
            draft.expected[made[-1]] = (element.names[k],)
        return made


class PlainStyle(EditStyle):
    """A hull is a node with a mesh, and is seen."""

    renames = True

    def remove(self, element: NodeRecord) -> None:
        self.draft.empty_node(element.node)

    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """The pieces stay in the node where they keep their names; else each goes to a node of its own below it."""
        draft, mesh = self.draft, self.draft.node(element.node)["mesh"]
        names = tuple(element.names[k] for k in kept)
        if len(kept) > 1 and list(kept) == list(range(len(kept))):
            assert element.owner is not None  # only meshes have several pieces
            part = draft.extract_pieces(mesh, element.owner, kept, strokes=True)
            draft.node(element.node)["mesh"] = draft.add_mesh(part, mesh)
            draft.expected[element.node] = names
        else:
            node = draft.node(element.node)
            if conventions.holds_colliders(node.get("name")):  # else what lies below would be all that collides
                node["name"] += "_"
            self.split_node(element, kept, mesh, names)

    def add_hull(self, geom: Geom, own: str, body: int | None, parent: NodeRecord | None) -> None:
        draft, holder = self.draft, self.holder(body, parent)
        source = draft.scene.placements[parent.node].node if parent else {}
        material = material_without_texture(draft.scene.tree, source["mesh"]) if "mesh" in source else None
        mesh = draft.add_shape_mesh(draft.shape_in(geom.shape, holder), own, material)
        self.add_mesh_node(own, mesh, holder, geom.name)

    def add_opaque(self, piece: Opaque, surface: Surface, own: str, body: int | None) -> None:
        """Add a surface that is no hull."""
        points = self.draft.points_in(np.asarray(surface.vertices), body)
        self.add_mesh_node(own, self.draft.add_surface_mesh(points, surface.faces, own), body, piece.name)


class UnityStyle(PlainStyle):
    """A hull is a node with a mesh, below a node called `table_colliders`."""

    def holder(self, body: int | None, parent: NodeRecord | None) -> int | None:
        """Beside the parent; without one, beside the first hull of the file."""
        holder = super().holder(body, parent)
        colliding, scene = nodes_below_colliders(self.draft.scene), self.draft.scene
        if holder in colliding or (
            holder is not None and conventions.holds_colliders(self.draft.node(holder).get("name"))
        ):
            return holder
        return scene.placements[min(colliding)].parent


class GodotStyle(EditStyle):
    """A hull is a node with a mesh, called `table-convcolonly`; `-col` and `-convcol` nodes are seen as well."""

    def remove(self, element: NodeRecord) -> None:
        if self._is_visible(element):
            self._strip_suffix(element)
        else:
            self.draft.empty_node(element.node)

    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """The pieces that are left stay in one mesh; where the whole is seen, they get a node of their own."""
        draft, mesh = self.draft, self.draft.node(element.node)["mesh"]
        assert element.owner is not None  # only meshes have several pieces
        names = tuple(element.names[k] for k in kept)
        if self._is_visible(element):
            base = self._strip_suffix(element)
            skinned = {key: draft.node(element.node)[key] for key in ("skin",) if key in draft.node(element.node)}
            part = draft.add_mesh({**draft.extract_pieces(mesh, element.owner, kept), "name": f"{base}-colonly"})
            node = draft.add_node({"name": f"{base}-colonly", "mesh": part, **skinned}, element.node)
            draft.expected[node] = names
        else:
            left = draft.extract_pieces(mesh, element.owner, kept, strokes=True)
            draft.node(element.node)["mesh"] = draft.add_mesh(left, mesh)
            draft.expected[element.node] = names

    def add_hull(self, geom: Geom, own: str, body: int | None, parent: NodeRecord | None) -> None:
        draft, holder = self.draft, self.holder(body, parent)
        base, tilde, number = own.rpartition("~")
        name = (
            f"{conventions.strip_godot_suffix(base)}~{number}-convcolonly"
            if tilde
            else f"{conventions.strip_godot_suffix(own)}-convcolonly"
        )
        self.add_mesh_node(name, draft.add_shape_mesh(draft.shape_in(geom.shape, holder), name), holder, geom.name)

    def _is_visible(self, element: NodeRecord) -> bool:
        node = self.draft.scene.placements[element.node].node
        names = (node.get("name"), entry(self.draft.scene.tree, "meshes", node["mesh"]).get("name"))
        return next((kind for kind in map(conventions.godot_kind, names) if kind), None) in ("col", "convcol")

    def _strip_suffix(self, element: NodeRecord) -> str:
        """Take the suffix from the name of a node, or of its mesh; the name without it."""
        node = self.draft.node(element.node)
        if conventions.godot_kind(node.get("name")):
            node["name"] = conventions.strip_godot_suffix(node["name"])
        mesh = entry(self.draft.tree, "meshes", node["mesh"])
        if conventions.godot_kind(mesh.get("name")):
            renamed = {**copy.deepcopy(mesh), "name": conventions.strip_godot_suffix(mesh["name"])}
            node["mesh"] = self.draft.add_mesh(renamed, node["mesh"])
        return str(node.get("name") or entry(self.draft.tree, "meshes", node["mesh"]).get("name") or "collision")


class UnrealStyle(EditStyle):
    """A hull is a node with a mesh, called after the mesh it stands for: `UCX_table_02`."""

    holds = ("polytope", *conventions.NATIVE_SHAPES)
    lacks = "Unreal has no"

    def remove(self, element: NodeRecord) -> None:
        self.draft.empty_node(element.node)

    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        raise AssertionError("Unreal's nodes have one piece each")

    def add_hull(self, geom: Geom, own: str, body: int | None, parent: NodeRecord | None) -> None:
        draft, holder, name = self.draft, self.holder(body, parent), self._next_name(geom, parent)
        self.add_mesh_node(name, draft.add_shape_mesh(draft.shape_in(geom.shape, holder), name), holder, geom.name)

    def _next_name(self, geom: Geom, parent: NodeRecord | None) -> str:
        nodes, meshes = entries(self.draft.tree, "nodes"), entries(self.draft.tree, "meshes")
        names = [str(thing.get("name", "")) for thing in (*nodes, *meshes)]
        shown = [str(node["name"]) for node in nodes if node.get("name") and "mesh" in node]
        rendered = [name for name in shown if not conventions.unreal_kind(name)]
        base = conventions.visible_mesh_of(parent.names[0], rendered) if parent else next(iter(rendered), "hull")
        return conventions.next_name(geom, base, names)
