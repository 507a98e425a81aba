"""Edits of files where all meshes are collision."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshforge.asset import Geom, Opaque, Surface
from meshforge.formats.gltf.document import Authored
from meshforge.formats.gltf.writing.draft import plain_material
from meshforge.formats.gltf.writing.styles import Style
from meshforge.formats.naming.marks import holds_colliders


class PlainStyle(Style):
    """A hull is a node with a mesh, and is seen."""

    renames = True

    def remove(self, element: Authored) -> None:
        self.draft.empty_node(element.node)

    def keep_pieces(self, element: Authored, kept: Sequence[int]) -> None:
        """The pieces stay in the node where they keep their names; else each goes to a node of its own below it."""
        draft, mesh = self.draft, self.draft.node(element.node)["mesh"]
        names = tuple(element.names[k] for k in kept)
        if len(kept) > 1 and list(kept) == list(range(len(kept))):
            assert element.owner is not None  # only meshes have several pieces
            parted = draft.extract_pieces(mesh, element.owner, kept, strokes=True)
            draft.node(element.node)["mesh"] = draft.add_mesh(parted, mesh)
            draft.expected[element.node] = names
        else:
            node = draft.node(element.node)
            if holds_colliders(node.get("name")):  # else what lies below would be all that collides
                node["name"] += "_"
            self.split_node(element, kept, mesh, names)

    def add_hull(self, geom: Geom, own: str, body: int | None, parent: Authored | None) -> None:
        draft, holder = self.draft, self.holder(body, parent)
        source = draft.scene.placements[parent.node].node if parent else {}
        material = plain_material(draft.scene.tree, source["mesh"]) if "mesh" in source else None
        mesh, middle = draft.add_shape_mesh(draft.shape_in(geom.shape, holder), own, material)
        node = draft.add_node({"name": own, "mesh": mesh, "translation": middle.tolist()}, holder)
        draft.expected[node] = (geom.name,)

    def holder(self, body: int | None, parent: Authored | None) -> int | None:
        """The node below which a made hull goes."""
        return self.draft.holder_of(body, parent.node if parent else None)

    def add_opaque(self, piece: Opaque, surface: Surface, own: str, body: int | None) -> None:
        """Add a surface that is no hull."""
        points = self.draft.points_in(np.asarray(surface.vertices), body)
        mesh, middle = self.draft.add_surface_mesh(points, surface.faces, own)
        node = self.draft.add_node({"name": own, "mesh": mesh, "translation": middle.tolist()}, body)
        self.draft.expected[node] = (piece.name,)
