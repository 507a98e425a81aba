"""The format glTF as the registry has it, with a variant for each engine that knows collision by name; what a file
can hold, and what one holds besides hulls."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, ClassVar, Literal

from meshforge.common import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.engine_names.base import CollisionNames, fallbacks_of
from meshforge.formats.engine_names.godot_unity import GodotNames, UnityNames
from meshforge.formats.engine_names.unreal import UnrealNames
from meshforge.formats.gltf.create import create_for_engine, create_gltf
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.gltf.edit import write_gltf
from meshforge.formats.gltf.mechanism import explain_missing_mass, read_motion
from meshforge.formats.gltf.read import read_gltf
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

HOLDS = frozenset(
    {
        FeatureKind.NAMES,
        FeatureKind.BODIES,
        FeatureKind.BOXES,
        FeatureKind.SPHERES,
        FeatureKind.CYLINDERS,
        FeatureKind.CAPSULES,
        FeatureKind.OPAQUE,
        FeatureKind.PLANES,
        FeatureKind.MASSES,
        FeatureKind.VISUALS,
        FeatureKind.COLORS,
    }
)
COULD = frozenset(
    {
        FeatureKind.JOINTS,
        FeatureKind.BALL_JOINTS,
        FeatureKind.FIXED_JOINTS,
        FeatureKind.MATERIALS,
        FeatureKind.VERTEX_COLORS,
        FeatureKind.TEXTURES,
        FeatureKind.TEXTURE_COORDINATES,
        FeatureKind.CONTACT,
        FeatureKind.PAIRS,
        FeatureKind.CAMERAS,
        FeatureKind.LIGHTS,
        FeatureKind.ANIMATIONS,
        FeatureKind.SKINS,
    }
)
COULD_NAMED = COULD - {
    FeatureKind.JOINTS,
    FeatureKind.BALL_JOINTS,
    FeatureKind.FIXED_JOINTS,
    FeatureKind.CONTACT,
    FeatureKind.PAIRS,
}
"""Those of them that are no physics, which names do not tell."""


class GltfFormat(Format):
    """glTF 2.0, as text with its buffers beside it, or as one GLB."""

    name: ClassVar[str] = "gltf"
    title: ClassVar[str] = "glTF"
    suffixes: ClassVar[tuple[str, ...]] = (".glb", ".gltf")

    up: ClassVar[Literal["y", "z"] | None] = "y"
    holds: ClassVar[frozenset[FeatureKind]] = HOLDS
    could: ClassVar[frozenset[FeatureKind]] = COULD
    instead: ClassVar[Mapping[FeatureKind, str]] = {FeatureKind.ELLIPSOIDS: "written as triangles"}

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return read_gltf(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, GltfDocument):
            raise AssetError("this asset was not read from a glTF file", where=str(asset.path))
        return write_gltf(asset, asset.document, name)

    def create(self, asset: Asset, name: str) -> Output:
        return create_gltf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document, asset) if isinstance(asset.document, GltfDocument) else ()


class EngineGltf(GltfFormat):
    """glTF whose collision an engine knows by name."""

    engine: ClassVar[CollisionNames]
    could: ClassVar[frozenset[FeatureKind]] = COULD_NAMED

    def can_write_back(self, asset: Asset) -> bool:
        return isinstance(asset.document, GltfDocument) and asset.document.convention == self.engine.engine

    def create(self, asset: Asset, name: str) -> Output:
        return create_for_engine(asset, name, self.engine)


class GltfForUnreal(EngineGltf):
    """With prefixes: `UCX_table_00`."""

    engine = UnrealNames()
    title = "glTF for Unreal"
    holds = engine.holds
    instead = fallbacks_of(engine)


class GltfForGodot(EngineGltf):
    """With suffixes: `leg-convcolonly`."""

    engine = GodotNames()
    title = "glTF for Godot"
    holds = engine.holds
    instead = fallbacks_of(engine)


class GltfForUnity(EngineGltf):
    """With a node for what collides: `table_colliders`."""

    engine = UnityNames()
    title = "glTF for Unity"
    holds = engine.holds
    instead = fallbacks_of(engine)


def features_of(document: GltfDocument, asset: Asset) -> list[Feature]:
    """The features of a glTF file that its asset does not tell. Raises AssetError: what lists them is damaged."""
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
    yield Feature(
        FeatureKind.CONTACT, unnamed=sum(len(entries(physics, k)) for k in ("physicsMaterials", "collisionFilters"))
    )
    yield Feature(FeatureKind.JOINTS, unnamed=sum(_is_joined(node) for node in entries(tree, "nodes")))


def _list_missing_masses(tree: Json, document: GltfDocument, asset: Asset) -> Iterator[Feature]:
    """The masses that the file says and the asset does not have."""
    known = {inertial.body for inertial in asset.mechanism.inertials}
    told = {name: read_motion(entry(tree, "nodes", node)) for node, name in document.bodies if name not in known}
    reasons = {name: explain_missing_mass(motion) for name, motion in told.items() if "mass" in motion}
    for reason in dict.fromkeys(reasons.values()):
        yield Feature(FeatureKind.MASSES, tuple(name for name, why in reasons.items() if why == reason), reason=reason)


def _is_joined(node: Json) -> bool:
    return "joint" in (extension(node, _PHYSICS) or {}) or extension(node, "OMI_physics_joint") is not None


def _feature_of(what: FeatureKind, things: list[Any]) -> Feature:
    names = tuple(str(thing["name"]) for thing in things if thing.get("name"))
    return Feature(what, names, len(things) - len(names))
