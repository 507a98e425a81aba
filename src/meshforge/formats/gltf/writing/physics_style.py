"""Edits of files whose collision is told by a physics extension."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import numpy as np

from meshforge.asset import Geom, Opaque, Surface
from meshforge.formats.gltf.document import Authored, Convention
from meshforge.formats.gltf.reading.bodies import rigid
from meshforge.formats.gltf.reading.physics import KHR, OMI, OMI_COLLIDER, collider_of
from meshforge.formats.gltf.reading.shapes import Z_TO_Y
from meshforge.formats.gltf.writing.draft import Draft
from meshforge.formats.gltf.writing.shape_entries import add_plane, add_shape, geometry_of, place_keys, place_of
from meshforge.formats.gltf.writing.styles import Style
from meshforge.formats.meshfile.gltf import Json
from meshforge.formats.meshfile.gltf.items import entries, extension
from meshforge.geometry import Box, Capsule, Cylinder, Pose, Sphere

DRAWN = {"meshforge": {"drawn": True}}
"""The extras of a node whose mesh only shows its collider, and goes with it."""


class PhysicsStyle(Style):
    """A hull is a node with a collider: a shape of the extension, or the hull of a mesh.

    drawn: whether each made hull is shown by a mesh, beside those whose parent is.
    """

    renames = True
    holds = ("polytope", "box", "sphere", "cylinder", "capsule")
    lacks = "the extension has no"

    def __init__(self, draft: Draft, convention: Convention, drawn: bool = False) -> None:
        super().__init__(draft)
        self.convention, self.drawn = convention, drawn

    def remove(self, element: Authored) -> None:
        node = self.draft.node(element.node)
        _without_collider(node)
        if is_drawn(node) or "mesh" not in node:
            self.draft.empty_node(element.node)

    def keep_pieces(self, element: Authored, kept: Sequence[int]) -> None:
        """Each piece that is left becomes a collider of its own, on a node below."""
        draft = self.draft
        assert element.owner is not None  # only meshes have several pieces
        source = draft.scene.placements[element.node]
        mesh = collider_of(source, self.convention, draft.scene).mesh
        for at, k in enumerate(kept):
            own = element.names[k].removeprefix(f"{element.body}/")
            parted = draft.add_mesh({**draft.extract_pieces(mesh, element.owner, [k]), "name": own})
            index = draft.add_node({"name": own}, element.node, at)
            self._set_collider(
                index, source.node, geometry_of(draft, self.convention, parted, None, hulled=False, like=source.node)
            )
            draft.expected[index] = (element.names[k],)
        _without_collider(draft.node(element.node))

    def add_hull(self, geom: Geom, own: str, body: int | None, parent: Authored | None) -> None:
        draft = self.draft
        holder = draft.holder_of(body, parent.node if parent else None)
        shape = draft.shape_in(geom.shape, holder)
        like = draft.scene.placements[parent.node].node if parent else {}
        drawn = self.drawn or is_drawn(like)
        node: Json = {"name": own}
        if isinstance(shape, Box | Sphere | Cylinder | Capsule):
            if drawn:
                node["mesh"], _ = draft.add_shape_mesh(shape.move(place_of(shape).inverse()), own)
            node |= place_keys(place_of(shape))
            self._add_node(node, drawn, holder, like, add_shape(draft, self.convention, shape), geom.name)
        else:
            mesh, middle = draft.add_shape_mesh(shape, own)
            node["translation"] = middle.tolist()
            self._add_mesh(node, drawn, holder, like, mesh, geom.name)

    def add_opaque(self, piece: Opaque, surface: Surface, own: str, body: int | None) -> None:
        """Add a surface that is no hull."""
        points = self.draft.points_in(np.asarray(surface.vertices), body)
        mesh, middle = self.draft.add_surface_mesh(points, surface.faces, own)
        node: Json = {"name": own, "translation": middle.tolist()}
        self._add_mesh(node, self.drawn, body, {}, mesh, piece.name, hulled=False)

    def add_plane(self, piece: Opaque, own: str, body: int | None) -> None:
        """Add an endless plane."""
        assert piece.plane is not None
        above = rigid(self.draft.scene.placements[body]) if body is not None else Pose.identity()
        node = {"name": own, **place_keys(above.inverse() @ piece.plane @ Z_TO_Y.inverse())}
        self._add_node(node, False, body, {}, add_plane(self.draft), piece.name)

    def _add_mesh(
        self, node: Json, drawn: bool, holder: int | None, like: Json, mesh: int, name: str, *, hulled: bool = True
    ) -> None:
        """Add a node that collides with a mesh, or with its hull."""
        own = len(entries(self.draft.tree, "nodes")) if drawn else None
        if drawn:
            node["mesh"] = mesh
            self.draft.tree.setdefault("nodes", [])
        geometry = geometry_of(self.draft, self.convention, mesh, own, hulled=hulled, like=like)
        self._add_node(node, drawn, holder, like, geometry, name)

    def _add_node(self, node: Json, drawn: bool, holder: int | None, like: Json, geometry: Any, name: str) -> None:
        if drawn:
            node["extras"] = copy.deepcopy(DRAWN)
        index = self.draft.add_node(node, holder)
        self._set_collider(index, like, geometry)
        self.draft.expected[index] = (name,)

    def _set_collider(self, index: int, like: Json, geometry: Any) -> None:
        """Give a node a collider with that geometry, and all else of the collider of another node."""
        extensions = self.draft.node(index).setdefault("extensions", {})
        self.draft.declare_extension({"khr": KHR, "omi": OMI}.get(self.convention, OMI_COLLIDER))
        match self.convention:
            case "khr":
                old = (extension(like, KHR) or {}).get("collider", {})
                rest = {k: copy.deepcopy(v) for k, v in old.items() if k not in ("geometry", "shape")}
                extensions[KHR] = {"collider": {**geometry, **rest}}
            case "omi":
                old = (extension(like, OMI) or {}).get("collider", {})
                extensions[OMI] = {"collider": {**copy.deepcopy(old), "shape": geometry}}
            case _:
                old = extension(like, OMI_COLLIDER) or {}
                extensions[OMI_COLLIDER] = {**copy.deepcopy(old), "collider": geometry}


def is_drawn(node: Json) -> bool:
    """Whether a node's mesh only shows its collider."""
    extras = node.get("extras")
    own = extras.get("meshforge") if isinstance(extras, dict) else None
    return isinstance(own, dict) and own.get("drawn") is True


def _without_collider(node: Json) -> None:
    """Take the collider from a node, and what is empty then."""
    extensions = node.get("extensions", {})
    for name in (KHR, OMI):
        own = extensions.get(name, {})
        if "collider" in own:
            del own["collider"]
            if not own:
                del extensions[name]
    extensions.pop(OMI_COLLIDER, None)
    if not extensions:
        node.pop("extensions", None)
