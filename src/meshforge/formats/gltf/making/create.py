"""Making a glTF file of an asset of another format: a node for each hull, below a node for each body."""

from __future__ import annotations

from pathlib import PurePosixPath

import numpy as np

from meshforge.asset import Asset, Geom, Opaque, Surface
from meshforge.errors import AssetError
from meshforge.formats.base import Output
from meshforge.formats.gltf.document import BODY, Convention, GltfDocument
from meshforge.formats.gltf.making.new_scene import bare_tree, material, new_draft, packed_new
from meshforge.formats.gltf.reading.motions import motion_of
from meshforge.formats.gltf.reading.physics import KHR
from meshforge.formats.gltf.writing.naming import settle
from meshforge.formats.gltf.writing.physics_style import PhysicsStyle
from meshforge.formats.gltf.writing.plain_style import PlainStyle
from meshforge.formats.gltf.writing.shape_entries import place_keys
from meshforge.formats.meshfile.gltf import Json
from meshforge.formats.naming.marks import godot_kind, unreal_kind
from meshforge.formats.shown import shown


def create_gltf(asset: Asset, name: str) -> Output:
    """The files of an asset that came from another format.

    One body of nothing but hull meshes becomes plain nodes. Else colliders of KHR_physics_rigid_bodies hold bodies and
    native shapes; where the asset shows nothing, a mesh on each collider's node shows that.
    """
    is_binary = PurePosixPath(name).suffix.lower() == ".glb"
    return _Creator(asset, "plain" if _is_plain(asset) else "khr", is_binary).build_output(PurePosixPath(name).stem)


def _is_plain(asset: Asset) -> bool:
    names = [geom.name for geom in asset.geoms] + [piece.name for piece in asset.opaque]
    return (
        [body.name for body in asset.bodies] in ([BODY], [])
        and not len(asset.visuals)
        and not any(geom.shape.is_primitive for geom in asset.geoms)
        and not any(piece.plane for piece in asset.opaque)
        and not any(unreal_kind(name) or godot_kind(name) for name in names)
    )


class _Creator:
    def __init__(self, asset: Asset, convention: Convention, is_binary: bool) -> None:
        self.asset, self.convention, self.is_binary = asset, convention, is_binary
        tree = self._build_tree()
        self.nodes: dict[str, int] = {node["name"]: k for k, node in enumerate(tree.get("nodes", []))}
        self.draft = new_draft(tree, asset.path, is_binary)

    def build_output(self, stem: str) -> Output:
        seen, lost = shown(self.asset) if self.convention == "khr" else ([], [])
        style = PlainStyle(self.draft) if self.convention == "plain" else PhysicsStyle(self.draft, "khr", not seen)
        for geom in self.asset.geoms:
            style.add_hull(geom, self._own_name(geom), self.nodes.get(geom.body), None)
        for piece in self.asset.opaque:
            self._add_opaque(style, piece)
        if not self.draft.expected:
            raise AssetError("there is no hull to write", where=str(self.asset.path))
        for body, surface in seen:
            self._add_visual(body, surface)
        renamed = self._assign_names()
        main, made = packed_new(self.draft, stem, self.is_binary)
        return Output(main, made, names=renamed, lost=tuple(lost))

    def _assign_names(self) -> dict[str, str]:
        """The hulls that read back under other names, with these."""
        bodies = tuple((node, body) for body, node in self.nodes.items())
        names = settle(self.draft, GltfDocument(b"", self.convention, (), bodies), renames=True)
        hulls = {geom.name for geom in self.asset.geoms}
        return {old: now for old, now in names.items() if old in hulls}

    def _build_tree(self) -> Json:
        """A tree with a node for each body but the one that all formats without bodies have."""
        tree = bare_tree()
        if self.convention == "plain":
            return tree
        tree["extensionsUsed"] = [KHR]
        moving = [body for body in self.asset.bodies if body.name != BODY]
        nodes = [
            {"name": body.name, **place_keys(body.pose), "extensions": {KHR: {"motion": motion_of(self.asset, body)}}}
            for body in moving
        ]
        if nodes:
            tree["scenes"][0]["nodes"] = list(range(len(nodes)))
            tree["nodes"] = nodes
        return tree

    def _own_name(self, thing: Geom | Opaque) -> str:
        return thing.name.removeprefix(f"{thing.body}/") if self.nodes else thing.name

    def _add_opaque(self, style: PlainStyle | PhysicsStyle, piece: Opaque) -> None:
        """A piece as its triangles, or as a plane; one that is neither is told in the report."""
        if piece.plane is not None and isinstance(style, PhysicsStyle):
            style.add_plane(piece, self._own_name(piece), self.nodes.get(piece.body))
        elif piece.surface is not None and len(piece.surface.faces):
            style.add_opaque(piece, piece.surface, self._own_name(piece), self.nodes.get(piece.body))

    def _add_visual(self, body: str, surface: Surface) -> None:
        """A node that shows a surface."""
        holder, name = self.nodes.get(body), f"{body}-visual"
        points = self.draft.points_in(np.asarray(surface.vertices), holder)
        mesh, middle = self.draft.add_surface_mesh(points, surface.faces, name, material(self.draft.tree, surface.rgba))
        self.draft.add_node({"name": name, "mesh": mesh, "translation": middle.tolist()}, holder)
