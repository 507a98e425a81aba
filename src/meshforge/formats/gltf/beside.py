"""Hulls written beside an unmarked scene: all of the scene stays as it is, and new nodes collide, by an extension or by
the names of an engine."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from dataclasses import replace
from pathlib import PurePosixPath

from meshforge.formats.base import Output, note_renames, nothing_collides_error
from meshforge.formats.collision_pieces import names_to_keep, refuse_changed_files
from meshforge.formats.engine_names.bodies import has_triangles, lose_opaque
from meshforge.formats.engine_names.conventions import CollisionNames
from meshforge.formats.gltf.document import GltfDocument, NodeRecord
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.edit import assign_names, note_lacking_shapes, style_of
from meshforge.formats.gltf.output import pack_scene, prepare_base
from meshforge.formats.gltf.styles import NewPiece
from meshforge.formats.meshfile.gltf_document import report_damage
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.symbolic import Asset, Geom, Opaque


def write_gltf_beside(asset: Asset, document: GltfDocument, name: str, engine: CollisionNames | None) -> Output:
    """The files of a scene with the hulls of an asset beside it, as colliders of KHR_physics_rigid_bodies.

    engine: by whose names they collide instead. Raises AssetError: a buffer changed since the asset was read, or there
    is no hull to write.
    """
    marked = GltfDocument(b"", engine.engine if engine else "khr", (), document.bodies)
    lost: list[Opaque] = []
    with report_damage(str(asset.path)):
        scene = GltfScene.of(document.source, asset.path)
        refuse_changed_files(document.digests, str(asset.path), "the buffer ")
        base = prepare_base(document.source, scene, name)
        draft = SceneDraft(scene, copy.deepcopy(base.tree), base.before)
        style = style_of(marked.convention, draft, PurePosixPath(name).stem)
        for piece in _list_pieces(asset, document, draft):
            if engine and not engine.takes_opaque and isinstance(piece.what, Opaque):
                lost.append(piece.what)
            elif isinstance(piece.what, Geom) or has_triangles(piece.what):
                style.add(piece)
        if not draft.expected:
            raise nothing_collides_error(asset)
        names = assign_names(draft, marked, renames=engine is None)
        output = pack_scene(base, scene, draft.geometry, name)
    hulls = {geom.name for geom in asset.geoms}
    renamed = {old: now for old, now in names.items() if old in hulls}
    notes = (*note_lacking_shapes(style, asset.geoms), *(() if engine else note_renames(renamed)), *style.notes)
    losses = [lose_opaque(engine, lost, is_seen=True)] if engine and lost else []
    return replace(output, notes=notes, names=renamed, lost=tuple(losses))


def _list_pieces(asset: Asset, document: GltfDocument, draft: SceneDraft) -> Iterator[NewPiece]:
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
        holder = _holder_of(draft, element, nodes.get(what.body))
        yield NewPiece(what, own, holder, element, part if stays else None)


def _holder_of(draft: SceneDraft, element: NodeRecord | None, body: int | None) -> int | None:
    """The node that a piece moves with: an animated one at or above where it comes from, else its body, else None."""
    at = element.node if element else None
    while at is not None and at != body:
        if at in draft.referred.animated and draft.keeps_volume(at):
            return at
        at = draft.scene.placements[at].parent
    return body
