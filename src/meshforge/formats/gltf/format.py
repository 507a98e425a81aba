"""The format glTF as the registry has it, with a variant for each engine that knows collision by name, and what a file
can hold. Reading, writing and making files are imported when they are asked for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar

from meshforge.common import AssetError
from meshforge.formats import gltf
from meshforge.formats.base import BODY_FEATURES, SCENE_FEATURES, Format, Mass, Output, ReadOptions
from meshforge.formats.engine_names.conventions import CollisionNames, GodotNames, UnityNames, UnrealNames, fallbacks_of
from meshforge.symbolic import Asset, Feature, FeatureKind

_COULD_NAMED = SCENE_FEATURES - {FeatureKind.CONTACT} | {
    *(FeatureKind.VERTEX_COLORS, FeatureKind.TEXTURE_COORDINATES, FeatureKind.ANIMATIONS, FeatureKind.SKINS)
}
"""What a file can hold and `create` leaves out, but for physics, which names do not say."""


class GltfFormat(Format):
    """glTF 2.0, as text with its buffers beside it, or as one GLB."""

    name = "gltf"
    title = "glTF"
    suffixes = (".glb", ".gltf")
    up = "y"
    holds = BODY_FEATURES | {FeatureKind.CAPSULES, FeatureKind.OPAQUE, FeatureKind.PLANES}
    could = _COULD_NAMED | {
        *(FeatureKind.JOINTS, FeatureKind.BALL_JOINTS, FeatureKind.FIXED_JOINTS, FeatureKind.CONTACT, FeatureKind.PAIRS)
    }
    instead: ClassVar[Mapping[FeatureKind, str]] = {FeatureKind.ELLIPSOIDS: "written as triangles"}

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return gltf.read_gltf(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, gltf.GltfDocument):
            raise AssetError("this asset was not read from a glTF file", where=str(asset.path))
        return gltf.write_gltf(asset, asset.document, name)

    def create(self, asset: Asset, name: str) -> Output:
        return gltf.create_gltf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return gltf.features_of(asset.document, asset) if isinstance(asset.document, gltf.GltfDocument) else ()


class EngineGltf(GltfFormat):
    """glTF whose collision an engine knows by name."""

    engine: ClassVar[CollisionNames]
    could = _COULD_NAMED

    def can_write_back(self, asset: Asset) -> bool:
        return isinstance(asset.document, gltf.GltfDocument) and asset.document.convention == self.engine.engine

    def create(self, asset: Asset, name: str) -> Output:
        return gltf.create_for_engine(asset, name, self.engine)


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
