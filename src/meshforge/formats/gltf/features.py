"""What a glTF file holds besides hulls, bodies and visuals."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from meshforge.asset import Asset, Feature, What
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.gltf.reading.motions import told_motion, why_weightless
from meshforge.formats.meshfile.gltf import Json, Scene, damage_at
from meshforge.formats.meshfile.gltf.items import entries, entry, extension

_LISTS = {
    "materials": What.MATERIALS,
    "textures": What.TEXTURES,
    "animations": What.ANIMATIONS,
    "skins": What.SKINS,
    "cameras": What.CAMERAS,
}
_ATTRIBUTES = {"COLOR_0": What.VERTEX_COLORS, "TEXCOORD_0": What.TEXTURE_COORDINATES}
_LIGHTS, _PHYSICS = "KHR_lights_punctual", "KHR_physics_rigid_bodies"


def features_of(document: GltfDocument, asset: Asset) -> list[Feature]:
    """The features of a glTF file that its asset does not tell. Raises AssetError: what lists them is damaged."""
    with damage_at(str(asset.path)):
        tree = Scene.of(document.source, asset.path).tree
        return [*_features(tree), *_weightless(tree, document, asset)]


def _features(tree: Json) -> Iterator[Feature]:
    for key, what in _LISTS.items():
        yield _feature(what, entries(tree, key))
    yield _feature(What.LIGHTS, entries(extension(tree, _LIGHTS) or {}, "lights"))
    parts = [part for mesh in entries(tree, "meshes") for part in entries(mesh, "primitives")]
    for name, what in _ATTRIBUTES.items():
        yield Feature(what, unnamed=sum(name in part.get("attributes", {}) for part in parts))
    physics = extension(tree, _PHYSICS) or {}
    yield Feature(What.CONTACT, unnamed=sum(len(entries(physics, k)) for k in ("physicsMaterials", "collisionFilters")))
    yield Feature(What.JOINTS, unnamed=sum(_is_joined(node) for node in entries(tree, "nodes")))


def _weightless(tree: Json, document: GltfDocument, asset: Asset) -> Iterator[Feature]:
    """The masses that the file says and the asset does not have."""
    known = {inertial.body for inertial in asset.mechanism.inertials}
    told = {name: told_motion(entry(tree, "nodes", node)) for node, name in document.bodies if name not in known}
    reasons = {name: why_weightless(motion) for name, motion in told.items() if "mass" in motion}
    for reason in dict.fromkeys(reasons.values()):
        yield Feature(What.MASSES, tuple(name for name, why in reasons.items() if why == reason), reason=reason)


def _is_joined(node: Json) -> bool:
    return "joint" in (extension(node, _PHYSICS) or {}) or extension(node, "OMI_physics_joint") is not None


def _feature(what: What, things: list[Any]) -> Feature:
    names = tuple(str(thing["name"]) for thing in things if thing.get("name"))
    return Feature(what, names, len(things) - len(names))
