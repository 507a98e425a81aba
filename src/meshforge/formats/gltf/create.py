"""Making a glTF file from an asset of another format: a node for each body and hull, with colliders of an extension,
plain, or named for an engine."""

from __future__ import annotations

import copy
import json
from collections.abc import Sequence
from pathlib import PurePosixPath
from typing import Literal
from urllib.parse import quote

import numpy as np

from meshforge.formats.base import Loss, Output, nothing_collides_error
from meshforge.formats.engine_names.bodies import EngineBody, has_triangles, name_bodies
from meshforge.formats.engine_names.conventions import CollisionNames, godot_kind, unreal_kind
from meshforge.formats.gltf.document import BODY, GltfDocument
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.edit import assign_names, style_of
from meshforge.formats.gltf.physics import KHR, motion_of
from meshforge.formats.gltf.physics_style import PhysicsStyle, pose_keys
from meshforge.formats.gltf.styles import NewPiece
from meshforge.formats.meshfile.gltf_document import Container, Json
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.visuals import linear_color, read_visual_surfaces
from meshforge.symbolic import Asset, Geom, Opaque, Surface


def create_gltf(asset: Asset, name: str, convention: Literal["plain", "khr"] | None = None) -> Output:
    """Return the files of an asset that came from another format.

    One body of nothing but hull meshes becomes plain nodes. Else colliders of KHR_physics_rigid_bodies hold bodies and
    native shapes; where the asset shows nothing, a mesh on each collider's node shows that.
    convention: one of the two, whatever the asset is.
    """
    path, marks = PurePosixPath(name), convention or ("plain" if _is_plain(asset) else "khr")
    is_khr = marks == "khr"
    bodies = [body for body in asset.bodies if is_khr and body.name != BODY]  # which all formats without bodies have
    motions = [{"extensions": {KHR: {"motion": motion_of(asset, body)}}} for body in bodies]
    places = [{"name": body.name, **pose_keys(body.pose)} for body in bodies]
    draft = new_draft(asset, path, [place | motion for place, motion in zip(places, motions, strict=True)])
    seen, lost = read_visual_surfaces(asset) if is_khr else ([], [])
    if is_khr:
        draft.declare_extension(KHR)
    style = PhysicsStyle(draft, marks, drawn=not seen) if is_khr else style_of(marks, draft, path.stem)
    nodes = {body.name: node for node, body in enumerate(bodies)}
    opaque = [piece for piece in asset.opaque if has_triangles(piece) or (piece.plane and is_khr)]
    pieces: list[Geom | Opaque] = [*asset.geoms, *opaque]
    for piece in pieces:
        own = piece.name.removeprefix(f"{piece.body}/") if nodes else piece.name
        style.add(NewPiece(piece, own, nodes.get(piece.body)))
    if not draft.expected:
        raise nothing_collides_error(asset)
    for body_name, surface in seen:
        holder, called = nodes.get(body_name), f"{body_name}-visual"
        points = draft.points_in(np.asarray(surface.vertices), holder)
        material = _add_material(draft, surface)
        mesh, middle = draft.add_surface_mesh(points, surface.faces, called, material, surface.texture)
        draft.add_node({"name": called, "mesh": mesh, "translation": middle.tolist()}, holder)
    document = GltfDocument(b"", marks, (), tuple((node, body) for body, node in nodes.items()))
    return pack_new(asset, draft, document, path, lost, renames=True)


def _is_plain(asset: Asset) -> bool:
    names = [geom.name for geom in asset.geoms] + [piece.name for piece in asset.opaque]
    return (
        [body.name for body in asset.bodies] in ([BODY], [])
        and not len(asset.visuals)
        and not any(geom.shape.is_primitive for geom in asset.geoms)
        and not any(piece.plane for piece in asset.opaque)
        and not any(unreal_kind(name) or godot_kind(name) for name in names)
    )


def create_for_engine(asset: Asset, name: str, engine: CollisionNames) -> Output:
    """Return the files of an asset with the names of an engine.

    No node is scaled. For Unreal, the meshes of a body are in its frame, since its importers have not always obeyed the
    places of nodes with collision; for others they lie about their own middle, so that single precision is fine.
    """
    path = PurePosixPath(name)
    found = name_bodies(asset, engine, path.stem)
    draft = draft_bodies(asset, found.each, path)
    for node, family in enumerate(found.each):
        if family.surfaces:
            draft.node(node)["mesh"] = add_visuals(draft, family, node)
    style = style_of(engine.engine, draft, path.stem)
    for node, family in enumerate(found.each):
        for piece, own in family.pieces:
            style.add(NewPiece(piece, own, node))
    return pack_new(asset, draft, GltfDocument(b"", engine.engine, ()), path, found.lost, found.notes)


def new_draft(asset: Asset, path: PurePosixPath, nodes: list[Json]) -> SceneDraft:
    """Return a draft of a new scene with some nodes."""
    scene = {"nodes": list(range(len(nodes)))} if nodes else {}
    tree = {"asset": {"version": "2.0", "generator": "MeshForge"}, "scene": 0, "scenes": [scene]}
    tree |= {"nodes": nodes} if nodes else {}
    return SceneDraft(GltfScene(copy.deepcopy(tree), None, asset.path), tree, b"" if _is_binary(path) else None)


def draft_bodies(asset: Asset, bodies: Sequence[EngineBody], path: PurePosixPath) -> SceneDraft:
    """Return a draft with a node for each body."""
    return new_draft(asset, path, [{"name": family.name, **pose_keys(family.body.pose)} for family in bodies])


def add_visuals(draft: SceneDraft, family: EngineBody, node: int) -> int:
    """Add one mesh of all that is seen of a body, a part for each surface."""
    parts = []
    for surface in family.surfaces:
        points = draft.points_in(np.asarray(surface.vertices), node)
        parts.append(draft.build_primitive(points, surface.faces, _add_material(draft, surface), surface.texture))
    return draft.add_mesh({"name": family.name, "primitives": parts})


def _add_material(draft: SceneDraft, surface: Surface) -> int | None:
    """The number of a material of the colour or picture of a surface, which is added where it is not there yet."""
    shading: Json = {"metallicFactor": 0.0}
    wanted: Json = {"pbrMetallicRoughness": shading}
    if surface.texture is not None:
        picture = surface.texture.picture  # a PNG, which is in the buffer once
        if picture not in draft.pictures:
            image = {"bufferView": draft.geometry.add_bytes(picture), "mimeType": "image/png"}
            draft.pictures[picture] = _number_of(draft.tree, "images", image)
        texture = _number_of(draft.tree, "textures", {"source": draft.pictures[picture]})
        shading["baseColorTexture"] = {"index": texture}
    elif surface.rgba is not None:
        shading["baseColorFactor"] = [*linear_color(surface.rgba), float(surface.rgba[3])]
        if surface.rgba[3] < 1:
            wanted["alphaMode"] = "BLEND"
    else:
        return None
    return _number_of(draft.tree, "materials", wanted)


def _number_of(tree: Json, key: str, wanted: Json) -> int:
    found: list[Json] = tree.setdefault(key, [])
    if wanted not in found:
        found.append(wanted)
    return found.index(wanted)


def pack_new(
    asset: Asset,
    draft: SceneDraft,
    document: GltfDocument,
    path: PurePosixPath,
    lost: Sequence[Loss],
    notes: Sequence[str] = (),
    *,
    renames: bool = False,
) -> Output:
    """Return the files of a new scene, with the names that hulls read back as; renames: as for `assign_names`."""
    hulls, buffer = {geom.name for geom in asset.geoms}, f"{path.stem}.bin"
    names = {old: now for old, now in assign_names(draft, document, renames=renames).items() if old in hulls}
    draft.geometry.finish(embed=False, uri=quote(buffer))
    if _is_binary(path):
        text = json.dumps(draft.tree, separators=(",", ":")).encode()
        main, made = Container(text, True).with_text(text, draft.geometry.chunk).as_bytes(), {}
    else:
        main = (json.dumps(draft.tree, indent=2) + "\n").encode()
        made = {buffer: bytes(draft.geometry.added)}
    return Output(main, made, names=names, lost=tuple(lost), notes=tuple(notes))


def _is_binary(path: PurePosixPath) -> bool:
    return path.suffix.lower() == ".glb"
