"""Making a glTF file from an asset of another format: a node for each body and hull, with colliders of an extension,
plain, or named for an engine."""

from __future__ import annotations

import copy
import json
from pathlib import Path, PurePosixPath
from typing import Literal
from urllib.parse import quote

import numpy as np

from meshforge.formats.base import Output, nothing_collides_error
from meshforge.formats.engine_names.bodies import EngineBodies, EngineBody, has_triangles, name_bodies
from meshforge.formats.engine_names.conventions import CollisionNames, godot_kind, unreal_kind
from meshforge.formats.gltf.document import BODY, Convention, GltfDocument
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.edit import assign_names, style_of
from meshforge.formats.gltf.physics import KHR, motion_of
from meshforge.formats.gltf.physics_style import PhysicsStyle, pose_keys
from meshforge.formats.gltf.styles import NewPiece, PlainStyle
from meshforge.formats.meshfile.gltf_document import Container, Json
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.visuals import linear_color, read_visual_surfaces
from meshforge.symbolic import Asset, Geom, NonConvexPiece, Surface


def create_gltf(asset: Asset, name: str, convention: Literal["plain", "khr"] | None = None) -> Output:
    """The files of an asset that came from another format.

    One body of nothing but hull meshes becomes plain nodes. Else colliders of KHR_physics_rigid_bodies hold bodies and
    native shapes; where the asset shows nothing, a mesh on each collider's node shows that.
    convention: one of the two, whatever the asset is.
    """
    is_binary = PurePosixPath(name).suffix.lower() == ".glb"
    chosen = convention or ("plain" if _is_plain(asset) else "khr")
    return _Creator(asset, chosen, is_binary).build_output(PurePosixPath(name).stem)


def _is_plain(asset: Asset) -> bool:
    names = [geom.name for geom in asset.geoms] + [piece.name for piece in asset.non_convex]
    return (
        [body.name for body in asset.bodies] in ([BODY], [])
        and not len(asset.visuals)
        and not any(geom.shape.is_primitive for geom in asset.geoms)
        and not any(piece.plane for piece in asset.non_convex)
        and not any(unreal_kind(name) or godot_kind(name) for name in names)
    )


class _Creator:
    def __init__(self, asset: Asset, convention: Convention, is_binary: bool) -> None:
        self.asset, self.convention, self.is_binary = asset, convention, is_binary
        tree = self._build_tree()
        self.nodes: dict[str, int] = {node["name"]: k for k, node in enumerate(tree.get("nodes", []))}
        self.draft = new_draft(tree, asset.path, is_binary)

    def build_output(self, stem: str) -> Output:
        seen, lost = read_visual_surfaces(self.asset) if self.convention == "khr" else ([], [])
        style = PlainStyle(self.draft) if self.convention == "plain" else PhysicsStyle(self.draft, "khr", not seen)
        non_convex = [
            piece
            for piece in self.asset.non_convex
            if has_triangles(piece) or (piece.plane and self.convention == "khr")
        ]
        pieces: list[Geom | NonConvexPiece] = [*self.asset.geoms, *non_convex]
        for piece in pieces:
            own = piece.name.removeprefix(f"{piece.body}/") if self.nodes else piece.name
            style.add(NewPiece(piece, own, self.nodes.get(piece.body)))
        if not self.draft.expected:
            raise nothing_collides_error(self.asset)
        for body, surface in seen:
            self._add_visual(body, surface)
        bodies = tuple((node, body) for body, node in self.nodes.items())
        names = assign_names(self.draft, GltfDocument(b"", self.convention, (), bodies), renames=True)
        hulls = {geom.name for geom in self.asset.geoms}
        renamed = {old: now for old, now in names.items() if old in hulls}
        main, made = pack_new(self.draft, stem, self.is_binary)
        return Output(main, made, names=renamed, lost=tuple(lost))

    def _build_tree(self) -> Json:
        """A tree with a node for each body but the one that all formats without bodies have."""
        tree = new_tree()
        if self.convention == "plain":
            return tree
        tree["extensionsUsed"] = [KHR]
        moving = [body for body in self.asset.bodies if body.name != BODY]
        nodes = [
            {"name": body.name, **pose_keys(body.pose), "extensions": {KHR: {"motion": motion_of(self.asset, body)}}}
            for body in moving
        ]
        if nodes:
            tree["scenes"][0]["nodes"] = list(range(len(nodes)))
            tree["nodes"] = nodes
        return tree

    def _add_visual(self, body: str, surface: Surface) -> None:
        holder, name = self.nodes.get(body), f"{body}-visual"
        points = self.draft.points_in(np.asarray(surface.vertices), holder)
        material = add_material(self.draft, surface)
        mesh, middle = self.draft.add_surface_mesh(points, surface.faces, name, material, surface.texture)
        self.draft.add_node({"name": name, "mesh": mesh, "translation": middle.tolist()}, holder)


def create_for_engine(asset: Asset, name: str, engine: CollisionNames) -> Output:
    """The files of an asset with the names of an engine.

    No node is scaled. For Unreal, the meshes of a body are in its frame, since its importers have not always obeyed the
    places of nodes with collision; for others they lie about their own middle, so that single precision is fine.
    """
    path = PurePosixPath(name)
    is_binary = path.suffix.lower() == ".glb"
    found = name_bodies(asset, engine, path.stem)
    draft = draft_bodies(asset, found, is_binary)
    for node, family in enumerate(found.each):
        if family.surfaces:
            draft.node(node)["mesh"] = add_visuals(draft, family, node)
    style = style_of(engine.engine, draft, path.stem)
    for node, family in enumerate(found.each):
        for piece, own in family.pieces:
            style.add(NewPiece(piece, own, node))
    return pack_bodies(asset, draft, GltfDocument(b"", engine.engine, ()), found, path)


def draft_bodies(asset: Asset, found: EngineBodies, is_binary: bool) -> SceneDraft:
    """A draft with a node for each body."""
    tree = new_tree()
    tree["scenes"][0]["nodes"] = list(range(len(found.each)))
    tree["nodes"] = [{"name": family.name, **pose_keys(family.body.pose)} for family in found.each]
    return new_draft(tree, asset.path, is_binary)


def add_visuals(draft: SceneDraft, family: EngineBody, node: int) -> int:
    """One mesh of all that is seen of a body, a part for each surface."""
    parts = []
    for surface in family.surfaces:
        points = draft.points_in(np.asarray(surface.vertices), node)
        material = add_material(draft, surface)
        parts.append(draft.build_primitive(points, surface.faces, material, surface.texture))
    return draft.add_mesh({"name": family.name, "primitives": parts})


def pack_bodies(
    asset: Asset, draft: SceneDraft, document: GltfDocument, found: EngineBodies, path: PurePosixPath
) -> Output:
    """The files of a draft of bodies, with the names that hulls read back as."""
    hulls = {geom.name for geom in asset.geoms}
    names = {old: now for old, now in assign_names(draft, document, renames=False).items() if old in hulls}
    main, made = pack_new(draft, path.stem, path.suffix.lower() == ".glb")
    return Output(main, made, names=names, lost=found.lost, notes=found.notes)


def new_tree() -> Json:
    """The tree of a scene without nodes."""
    return {"asset": {"version": "2.0", "generator": "MeshForge"}, "scene": 0, "scenes": [{}]}


def new_draft(tree: Json, path: Path, is_binary: bool) -> SceneDraft:
    """A draft of a tree that has nodes without meshes alone; path: for messages."""
    return SceneDraft(GltfScene(copy.deepcopy(tree), None, path), tree, b"" if is_binary else None)


def add_material(draft: SceneDraft, surface: Surface) -> int | None:
    """The number of a material of the colour or picture of a surface, which is added where it is not there yet."""
    shading: Json = {"metallicFactor": 0.0}
    wanted: Json = {"pbrMetallicRoughness": shading}
    if surface.texture is not None:
        shading["baseColorTexture"] = {"index": _add_picture(draft, surface.texture.picture)}
    elif surface.rgba is not None:
        shading["baseColorFactor"] = [*linear_color(surface.rgba), float(surface.rgba[3])]
        if surface.rgba[3] < 1:
            wanted["alphaMode"] = "BLEND"
    else:
        return None
    return _number_of(draft.tree, "materials", wanted)


def _add_picture(draft: SceneDraft, picture: bytes) -> int:
    """The number of a texture of a picture, a PNG, which is in the buffer once."""
    if picture not in draft.pictures:
        image = {"bufferView": draft.geometry.add_bytes(picture), "mimeType": "image/png"}
        draft.pictures[picture] = _number_of(draft.tree, "images", image)
    return _number_of(draft.tree, "textures", {"source": draft.pictures[picture]})


def _number_of(tree: Json, key: str, wanted: Json) -> int:
    found: list[Json] = tree.setdefault(key, [])
    if wanted not in found:
        found.append(wanted)
    return found.index(wanted)


def pack_new(draft: SceneDraft, stem: str, is_binary: bool) -> tuple[bytes, dict[str, bytes]]:
    """The main file of a new scene, and the one of its buffer."""
    geometry, made = draft.geometry, dict[str, bytes]()
    geometry.finish(embed=False, uri=quote(f"{stem}.bin"))
    if is_binary:
        text = json.dumps(draft.tree, separators=(",", ":")).encode()
        return Container(text, True).with_text(text, geometry.chunk).as_bytes(), made
    made[f"{stem}.bin"] = bytes(geometry.added)
    return (json.dumps(draft.tree, indent=2) + "\n").encode(), made
