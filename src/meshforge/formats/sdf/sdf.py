"""The format SDF, as the registry has it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.asset import Asset, Feature, What
from meshforge.errors import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.sdf.document import SdfDocument
from meshforge.formats.sdf.features import COULD, HOLDS, MESHES, features_of
from meshforge.formats.sdf.files.config import is_main
from meshforge.formats.sdf.making.create import create_sdf
from meshforge.formats.sdf.reading.read import read_sdf
from meshforge.formats.sdf.writing.write import write_sdf


class SdfFormat(Format):
    """The Simulation Description Format, of Gazebo."""

    name: ClassVar[str] = "sdf"
    suffixes: ClassVar[tuple[str, ...]] = (".sdf",)
    is_description: ClassVar[bool] = True
    title: ClassVar[str] = "SDF"
    up: ClassVar[Literal["y", "z"] | None] = "z"
    holds: ClassVar[frozenset[What]] = HOLDS
    could: ClassVar[frozenset[What]] = COULD
    shown_files: ClassVar[tuple[str, ...]] = MESHES

    def is_main(self, path: Path) -> bool:
        return is_main(path)

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return read_sdf(path, options)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, SdfDocument):
            raise AssetError("this asset was not read from an SDF", where=str(asset.path))
        return write_sdf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> Output:
        return create_sdf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, SdfDocument) else ()
