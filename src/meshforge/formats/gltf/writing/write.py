"""Writing an edited glTF file: the authored JSON where nothing changed, and all bytes of its buffers."""

from __future__ import annotations

import copy
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from meshforge.asset import Asset, Geom
from meshforge.errors import AssetError
from meshforge.formats.base import Output
from meshforge.formats.collision_meshes import digest_of
from meshforge.formats.companions import companions
from meshforge.formats.gltf.document import Authored, Convention, GltfDocument
from meshforge.formats.gltf.writing.draft import Draft
from meshforge.formats.gltf.writing.godot_style import GodotStyle
from meshforge.formats.gltf.writing.naming import settle
from meshforge.formats.gltf.writing.packing import based, packed
from meshforge.formats.gltf.writing.physics_style import PhysicsStyle
from meshforge.formats.gltf.writing.plain_style import PlainStyle
from meshforge.formats.gltf.writing.styles import Style
from meshforge.formats.gltf.writing.unity_style import UnityStyle
from meshforge.formats.gltf.writing.unreal_style import UnrealStyle
from meshforge.formats.meshfile.gltf import Scene, damage_at
from meshforge.formats.plain.parts import renaming
from meshforge.words import counted


def write_gltf(asset: Asset, document: GltfDocument, name: str) -> Output:
    """The files of an asset that was read from a glTF file; without an edit, its own bytes.

    Raises AssetError: a buffer changed since the asset was read, nothing would be left, or an animation is in the way.
    """
    kept = {geom.name for geom in asset.geoms if geom.parent is None} | {piece.name for piece in asset.opaque}
    known = {piece for element in document.authored for piece in element.names}
    made = [geom for geom in asset.geoms if geom.parent is not None or geom.name not in known]
    with damage_at(str(asset.path)):
        scene = Scene.of(document.source, asset.path)
        if known <= kept and not made and Path(name).suffix.lower() == asset.path.suffix.lower():
            return Output(document.source, copies=companions(asset.path))
        _refuse_changed(document, asset)
        base = based(document.source, scene, name)
        if known <= kept and not made:
            return packed(base, scene, None, name)
        draft = Draft(scene, copy.deepcopy(base.tree), base.before)
        names = _edited(draft, document, kept, made, asset.path)
        output = packed(base, scene, draft.geometry, name)
    notes = _as_hulls(style_of(document.convention, draft), made)
    return replace(output, notes=(*notes, *renaming(names)), names=names)


def _edited(draft: Draft, document: GltfDocument, kept: set[str], made: Sequence[Geom], path: Path) -> dict[str, str]:
    """Edit a draft; kept: the pieces that stay; made: the hulls that come. The names that read back otherwise."""
    style = style_of(document.convention, draft)
    for element in document.authored:
        _settle_pieces(style, element, [k for k, piece in enumerate(element.names) if piece in kept])
    for geom in made:
        _place(style, geom, document, path)
    if not draft.expected:
        raise AssetError(
            "the edit leaves no collision in this file",
            where=str(path),
            remedy="Leave one hull: without any, all its meshes would be taken for collision.",
        )
    return settle(draft, document, renames=style.renames)


def style_of(convention: Convention, draft: Draft) -> Style:
    """What writes edits in a convention."""
    match convention:
        case "plain":
            return PlainStyle(draft)
        case "unreal":
            return UnrealStyle(draft)
        case "godot":
            return GodotStyle(draft)
        case "unity":
            return UnityStyle(draft)
    return PhysicsStyle(draft, convention)


def _settle_pieces(style: Style, element: Authored, kept: list[int]) -> None:
    if len(kept) == len(element.names):
        style.draft.expected[element.node] = element.names
    elif kept:
        style.keep_pieces(element, kept)
    else:
        style.remove(element)


def _place(style: Style, geom: Geom, document: GltfDocument, path: Path) -> None:
    """Add a made hull to its body."""
    nodes = {name: node for node, name in document.bodies}
    bodies = {element.body for element in document.authored} | {"body"}
    if geom.body not in nodes and geom.body not in bodies:
        raise AssetError(f"hull {geom.name!r} is on {geom.body!r}, which is no body of the file", where=str(path))
    parent = next((e for e in document.authored if geom.parent in e.names and e.body == geom.body), None)
    own = geom.name.removeprefix(f"{geom.body}/") if document.bodies else geom.name
    style.add_hull(geom, own, nodes.get(geom.body), parent)


def _as_hulls(style: Style, made: Sequence[Geom]) -> list[str]:
    """Notes on the round shapes that the convention of a file lacks."""
    count = Counter(geom.shape.kind for geom in made if geom.shape.kind not in style.holds)
    return [
        f"{counted(number, kind)} written as hull meshes: {style.lacks} {kind}"
        for kind, number in sorted(count.items())
    ]


def _refuse_changed(document: GltfDocument, asset: Asset) -> None:
    for path, digest in document.digests:
        if not path.is_file() or digest_of(path) != digest:
            raise AssetError(
                f"the buffer {path.name} has changed since the asset was read",
                where=str(asset.path),
                remedy="Read the asset again.",
            )
