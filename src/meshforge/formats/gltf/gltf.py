"""The format glTF, as the registry has it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.asset import Asset, Feature, What
from meshforge.errors import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.gltf.features import features_of
from meshforge.formats.gltf.making.create import create_gltf
from meshforge.formats.gltf.making.held import COULD, COULD_NAMED, HOLDS
from meshforge.formats.gltf.making.named import create_named
from meshforge.formats.gltf.reading.read import read_gltf
from meshforge.formats.gltf.writing.write import write_gltf
from meshforge.formats.naming.base import EngineNames, instead_of
from meshforge.formats.naming.godot import GodotNames
from meshforge.formats.naming.unity import UnityNames
from meshforge.formats.naming.unreal import UnrealNames


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


class NamedGltf(GltfFormat):
    """glTF whose collision an engine knows by name."""

    engine: ClassVar[EngineNames]
    could: ClassVar[frozenset[What]] = COULD_NAMED

    def can_write_back(self, asset: Asset) -> bool:
        return isinstance(asset.document, GltfDocument) and asset.document.convention == self.engine.engine

    def create(self, asset: Asset, name: str) -> Output:
        return create_named(asset, name, self.engine)


class GltfForUnreal(NamedGltf):
    """With prefixes: `UCX_table_00`."""

    engine = UnrealNames()
    title = "glTF for Unreal"
    holds = engine.holds
    instead = instead_of(engine)


class GltfForGodot(NamedGltf):
    """With suffixes: `leg-convcolonly`."""

    engine = GodotNames()
    title = "glTF for Godot"
    holds = engine.holds
    instead = instead_of(engine)


class GltfForUnity(NamedGltf):
    """With a node for what collides: `table_colliders`."""

    engine = UnityNames()
    title = "glTF for Unity"
    holds = engine.holds
    instead = instead_of(engine)
