"""The format USD, as the registry has it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.asset import Asset, Feature, What
from meshforge.errors import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.usd.document import UsdDocument
from meshforge.formats.usd.features import COULD, HOLDS, features_of
from meshforge.formats.usd.making.create import create_usd
from meshforge.formats.usd.reading.read import read_usd
from meshforge.formats.usd.writing.write import write_usd


class UsdFormat(Format):
    """Universal Scene Description, as text (.usda), crate (.usdc), either (.usd) or a package (.usdz)."""

    name: ClassVar[str] = "usd"
    title: ClassVar[str] = "USD"
    suffixes: ClassVar[tuple[str, ...]] = (".usda", ".usd", ".usdc", ".usdz")
    up: ClassVar[Literal["y", "z"] | None] = "z"
    holds: ClassVar[frozenset[What]] = HOLDS
    could: ClassVar[frozenset[What]] = COULD
    instead: ClassVar[Mapping[What, str]] = {What.ELLIPSOIDS: "written as triangles"}

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return read_usd(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, UsdDocument):
            raise AssetError("this asset was not read from a USD file", where=str(asset.path))
        return write_usd(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> Output:
        return create_usd(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset) if isinstance(asset.document, UsdDocument) else ()
