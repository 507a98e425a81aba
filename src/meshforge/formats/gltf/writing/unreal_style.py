"""Edits of files whose collision Unreal takes by name."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.asset import Geom
from meshforge.formats.gltf.document import Authored
from meshforge.formats.gltf.writing.styles import Style
from meshforge.formats.meshfile.gltf.items import entries
from meshforge.formats.naming.marks import render_name, unreal_kind
from meshforge.formats.naming.unreal import NATIVE, next_name


class UnrealStyle(Style):
    """A hull is a node with a mesh, called after the mesh it stands for: `UCX_table_02`."""

    holds = ("polytope", *NATIVE)
    lacks = "Unreal has no"

    def remove(self, element: Authored) -> None:
        self.draft.empty_node(element.node)

    def keep_pieces(self, element: Authored, kept: Sequence[int]) -> None:
        raise AssertionError("Unreal's nodes have one piece each")

    def add_hull(self, geom: Geom, own: str, body: int | None, parent: Authored | None) -> None:
        draft = self.draft
        holder = draft.holder_of(body, parent.node if parent else None)
        name = self._next_name(geom, parent)
        mesh, middle = draft.add_shape_mesh(draft.shape_in(geom.shape, holder), name)
        node = draft.add_node({"name": name, "mesh": mesh, "translation": middle.tolist()}, holder)
        draft.expected[node] = (geom.name,)

    def _next_name(self, geom: Geom, parent: Authored | None) -> str:
        """The next name of a collision node of the mesh that the parent stands for."""
        nodes, meshes = entries(self.draft.tree, "nodes"), entries(self.draft.tree, "meshes")
        names = [str(thing.get("name", "")) for thing in (*nodes, *meshes)]
        shown = [str(node["name"]) for node in nodes if node.get("name") and "mesh" in node]
        rendered = [name for name in shown if not unreal_kind(name)]
        base = render_name(parent.names[0], rendered) if parent else next(iter(rendered), "hull")
        return next_name(geom, base, names)
