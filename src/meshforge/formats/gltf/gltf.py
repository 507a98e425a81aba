"""The format glTF, as the registry has it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.asset import Asset, Feature, What
from meshforge.errors import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.gltf.create import COULD, HOLDS, create_gltf
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.gltf.features import features_of
from meshforge.formats.gltf.reading.read import read_gltf
from meshforge.formats.gltf.writing.write import write_gltf


class GltfFormat(Format):
    """glTF 2.0, as text with its buffers beside it, or as one GLB."""

    name: ClassVar[str] = "gltf"
    title: ClassVar[str] = "glTF"
    suffixes: ClassVar[tuple[str, ...]] = (".glb", ".gltf")

    up: ClassVar[Literal["y", "z"] | None] = "y"
    holds: ClassVar[frozenset[What]] = HOLDS
    could: ClassVar[frozenset[What]] = COULD
    instead: ClassVar[Mapping[What, str]] = {What.ELLIPSOIDS: "written as triangles"}

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
