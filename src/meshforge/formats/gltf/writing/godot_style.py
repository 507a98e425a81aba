"""Edits of files whose collision Godot takes by name."""

from __future__ import annotations

import copy
from collections.abc import Sequence

from meshforge.asset import Geom
from meshforge.formats.gltf.document import Authored
from meshforge.formats.gltf.writing.styles import Style
from meshforge.formats.meshfile.gltf.items import entry
from meshforge.formats.naming.marks import godot_kind, without_suffix


class GodotStyle(Style):
    """A hull is a node with a mesh, called `table-convcolonly`; `-col` and `-convcol` nodes are seen as well."""

    def remove(self, element: Authored) -> None:
        if self._is_visible(element):
            self._strip_suffix(element)
        else:
            self.draft.empty_node(element.node)

    def keep_pieces(self, element: Authored, kept: Sequence[int]) -> None:
        """The pieces that are left stay in one mesh; where the whole is seen, they get a node of their own."""
        draft, mesh = self.draft, self.draft.node(element.node)["mesh"]
        assert element.owner is not None  # only meshes have several pieces
        names = tuple(element.names[k] for k in kept)
        if self._is_visible(element):
            base = self._strip_suffix(element)
            skinned = {key: draft.node(element.node)[key] for key in ("skin",) if key in draft.node(element.node)}
            parted = draft.add_mesh({**draft.extract_pieces(mesh, element.owner, kept), "name": f"{base}-colonly"})
            node = draft.add_node({"name": f"{base}-colonly", "mesh": parted, **skinned}, element.node)
            draft.expected[node] = names
        else:
            left = draft.extract_pieces(mesh, element.owner, kept, strokes=True)
            draft.node(element.node)["mesh"] = draft.add_mesh(left, mesh)
            draft.expected[element.node] = names

    def add_hull(self, geom: Geom, own: str, body: int | None, parent: Authored | None) -> None:
        draft = self.draft
        holder = draft.holder_of(body, parent.node if parent else None)
        base, tilde, number = own.rpartition("~")
        name = f"{without_suffix(base)}~{number}-convcolonly" if tilde else f"{without_suffix(own)}-convcolonly"
        mesh, middle = draft.add_shape_mesh(draft.shape_in(geom.shape, holder), name)
        node = draft.add_node({"name": name, "mesh": mesh, "translation": middle.tolist()}, holder)
        draft.expected[node] = (geom.name,)

    def _is_visible(self, element: Authored) -> bool:
        return self._kind(element) in ("col", "convcol")

    def _kind(self, element: Authored) -> str | None:
        node = self.draft.scene.placements[element.node].node
        names = (node.get("name"), entry(self.draft.scene.tree, "meshes", node["mesh"]).get("name"))
        return next((kind for kind in map(godot_kind, names) if kind), None)

    def _strip_suffix(self, element: Authored) -> str:
        """Take the suffix from the name of a node, or of its mesh; the name without it."""
        node = self.draft.node(element.node)
        if godot_kind(node.get("name")):
            node["name"] = without_suffix(node["name"])
        mesh = entry(self.draft.tree, "meshes", node["mesh"])
        if godot_kind(mesh.get("name")):
            renamed = {**copy.deepcopy(mesh), "name": without_suffix(mesh["name"])}
            node["mesh"] = self.draft.add_mesh(renamed, node["mesh"])
        return str(node.get("name") or entry(self.draft.tree, "meshes", node["mesh"]).get("name") or "collision")
