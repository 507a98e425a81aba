"""The format URDF, as the registry has it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.asset import Asset, Feature, What
from meshforge.errors import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.urdf.create import create_urdf
from meshforge.formats.urdf.document import UrdfDocument
from meshforge.formats.urdf.features import COULD, HOLDS, INSTEAD, MESHES, features_of
from meshforge.formats.urdf.read import read_urdf
from meshforge.formats.urdf.write import write_urdf


class UrdfFormat(Format):
    """The Unified Robot Description Format."""

    name: ClassVar[str] = "urdf"
    suffixes: ClassVar[tuple[str, ...]] = (".urdf",)
    is_description: ClassVar[bool] = True
    title: ClassVar[str] = "URDF"
    up: ClassVar[Literal["y", "z"] | None] = "z"
    holds: ClassVar[frozenset[What]] = HOLDS
    could: ClassVar[frozenset[What]] = COULD
    instead: ClassVar[Mapping[What, str]] = INSTEAD
    shown_files: ClassVar[tuple[str, ...]] = MESHES

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return read_urdf(path, options)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, UrdfDocument):
            raise AssetError("this asset was not read from a URDF", where=str(asset.path))
        return write_urdf(asset, asset.document, name)

    def create(self, asset: Asset, name: str) -> Output:
        return create_urdf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, UrdfDocument) else ()
