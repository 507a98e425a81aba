"""The format USD as the registry has it, and what a stage can hold. Reading, writing and making files are imported
when they are asked for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar

from meshforge.common import AssetError
from meshforge.formats import usd
from meshforge.formats.base import BODY_FEATURES, SCENE_FEATURES, Format, Mass, Output, ReadOptions
from meshforge.symbolic import Asset, Feature, FeatureKind


class UsdFormat(Format):
    """Universal Scene Description, as text (.usda), crate (.usdc), either (.usd) or a package (.usdz)."""

    name = "usd"
    title = "USD"
    suffixes = (".usda", ".usd", ".usdc", ".usdz")
    up = "z"
    holds = BODY_FEATURES | {
        *(FeatureKind.CAPSULES, FeatureKind.OPAQUE, FeatureKind.PLANES),
        *(FeatureKind.JOINTS, FeatureKind.BALL_JOINTS, FeatureKind.FIXED_JOINTS),
    }
    could = SCENE_FEATURES | {
        *(FeatureKind.VERTEX_COLORS, FeatureKind.TEXTURE_COORDINATES, FeatureKind.PAIRS, FeatureKind.ACTUATORS),
        *(FeatureKind.DYNAMICS, FeatureKind.ANIMATIONS, FeatureKind.SKINS, FeatureKind.COMMENTS),
    }
    instead: ClassVar[Mapping[FeatureKind, str]] = {FeatureKind.ELLIPSOIDS: "written as triangles"}

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return usd.read_usd(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, usd.UsdDocument):
            raise AssetError("this asset was not read from a USD file", where=str(asset.path))
        return usd.write_usd(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> Output:
        return usd.create_usd(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return usd.features_of(asset) if isinstance(asset.document, usd.UsdDocument) else ()
