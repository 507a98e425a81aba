"""What a glTF file holds besides hulls, bodies, joints, masses and visuals."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from meshforge.formats.base import feature_of
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.gltf.physics import explain_missing_mass, read_motion
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension, report_damage
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.symbolic import Asset, Feature, FeatureKind

_LISTS = {
    "materials": FeatureKind.MATERIALS,
    "textures": FeatureKind.TEXTURES,
    "animations": FeatureKind.ANIMATIONS,
    "skins": FeatureKind.SKINS,
    "cameras": FeatureKind.CAMERAS,
}
_ATTRIBUTES = {"COLOR_0": FeatureKind.VERTEX_COLORS, "TEXCOORD_0": FeatureKind.TEXTURE_COORDINATES}
_LIGHTS, _PHYSICS = "KHR_lights_punctual", "KHR_physics_rigid_bodies"


def features_of(document: GltfDocument, asset: Asset) -> list[Feature]:
    """The features of a glTF file that its asset does not have. Raises AssetError: what lists them is damaged."""
    with report_damage(str(asset.path)):
        tree = GltfScene.of(document.source, asset.path).tree
        return [*_list_features(tree), *_list_missing_masses(tree, document, asset)]


def _list_features(tree: Json) -> Iterator[Feature]:
    for key, what in _LISTS.items():
        yield _feature_of(what, entries(tree, key))
    yield _feature_of(FeatureKind.LIGHTS, entries(extension(tree, _LIGHTS) or {}, "lights"))
    parts = [part for mesh in entries(tree, "meshes") for part in entries(mesh, "primitives")]
    for name, what in _ATTRIBUTES.items():
        yield Feature(what, unnamed=sum(name in part.get("attributes", {}) for part in parts))
    physics = extension(tree, _PHYSICS) or {}
    settings = [one for key in ("physicsMaterials", "collisionFilters") for one in entries(physics, key)]
    yield Feature(FeatureKind.CONTACT, unnamed=len(settings))
    nodes = entries(tree, "nodes")
    joined = [
        n for n in nodes if "joint" in (extension(n, _PHYSICS) or {}) or extension(n, "OMI_physics_joint") is not None
    ]
    yield Feature(FeatureKind.JOINTS, unnamed=len(joined))


def _list_missing_masses(tree: Json, document: GltfDocument, asset: Asset) -> Iterator[Feature]:
    """The masses that the file says and the asset does not have."""
    known = {inertial.body for inertial in asset.mechanism.inertials}
    motions = {name: read_motion(entry(tree, "nodes", node)) for node, name in document.bodies if name not in known}
    reasons = {name: explain_missing_mass(motion) for name, motion in motions.items() if "mass" in motion}
    for reason in dict.fromkeys(reasons.values()):
        yield Feature(FeatureKind.MASSES, tuple(name for name, why in reasons.items() if why == reason), reason=reason)


def _feature_of(what: FeatureKind, things: list[Any]) -> Feature:
    return feature_of(what, (str(thing.get("name") or "") for thing in things))
